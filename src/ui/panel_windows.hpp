#pragma once

#include <utility>

#include "ui/panels.hpp"

namespace speculum {

// All windows of the user interface in the current Dear ImGui context. They show a UiInput and return the user's
// actions as commands; Vulkan and GLFW are not needed.
class PanelWindows {
 public:
  PanelWindows();

  // Call it once, before the first frame of the ImGui context, which must end before this object.
  void rememberLayout() { dock_.remember(); }
  // Lays out everything between ImGui::NewFrame and ImGui::Render.
  UiOutput build(const UiInput& input);
  Thumbnails& thumbnails() { return thumbnails_; }

  const PanelState& state() const { return state_; }
  bool visible() const { return visible_; }
  bool toggleVisible() { return visible_ = !visible_; }
  void toggleHelp();
  void toggleInspector();
  void openInspector();
  void closeSidePanels();                              // those at the right
  bool inspectorCovers(const glm::vec2& place) const;  // the inspector is closed and would open there
  // Returns the part of the display that panels leave free, in screen coordinates.
  WindowRect freeRect() const;
  // Call when the window gets or loses the keyboard's focus. A loss releases all keys, and Alt+Tab is no tap of Alt.
  void setFocused(bool focused);
  // Closes the list of keys. Returns false if it was not open.
  bool closeHelp() { return visible_ && std::exchange(state_.help, false); }

 private:
  void ignoreRestingPointer();
  void goToMenusByAlt();
  void forgetLostWidget();
  void mainPanel(PanelContext& ui);
  void windowChoices(PanelContext& ui);
  void menuBar(PanelContext& ui);
  void windowMenu(PanelContext& ui);
  void presentModes(PanelContext& ui);
  void sideWindows(PanelContext& ui);

  PanelDock dock_;
  PanelState state_;
  PanelChoices savedChoices_;
  int pendingPercent_;  // PanelChoices::percent while its slider is held
  Thumbnails thumbnails_;
  float statusWidth_ = 0.0f;  // pixels
  float statusHeight_ = 0.0f;
  bool visible_ = true;
  bool foldedMain_ = false;  // the inspector folded the main panel when it opened
  bool altDown_ = false;     // in the last frame
  bool popupOpen_ = false;   // in the last frame
  bool alt_ = false;         // the same, without text, button or other modifier since Alt was pressed
  bool focused_ = true;      // the window has the keyboard's focus
  unsigned lost_ = 0;        // identifier of the focused widget if the last frame did not draw it
};

}  // namespace speculum
