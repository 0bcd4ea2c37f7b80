#pragma once

#include <memory>

#include "core/renderer.hpp"
#include "ui/panel_windows.hpp"

namespace speculum {

// The panels over the picture: Dear ImGui with its GLFW and Vulkan backends. One instance a process.
class SimpleUI {
 public:
  SimpleUI(Renderer& renderer, Window& window);
  ~SimpleUI();
  SimpleUI(const SimpleUI&) = delete;
  SimpleUI& operator=(const SimpleUI&) = delete;

  void push(const InputEvent& event);  // call with each of the window's
  // Lays out this frame's panels. Call it once a frame, even if nothing is drawn.
  UiOutput build(const UiInput& input);
  void record(const PassScope& scope);
  // Reads what only the window system knows, for the next build(). It may wait for an answer.
  void readWindow();
  void setThumbnails(std::vector<Image8> pictures);  // of ShownScenes::scenes, from the next frame on
  PanelWindows& windows() { return windows_; }
  const PanelWindows& windows() const { return windows_; }

  // Says whether the pointer there belongs to the panels: it is over one of their windows, or they hold a widget.
  // Screen coordinates of the window.
  bool takesPointer(double x, double y) const;
  float scale() const;         // of texts and handles: the monitor's by the user's
  bool holdsEscape() const;    // ImGui handles Esc itself: it closes or releases something
  bool holdsWidget() const;    // one is being dragged, pressed or typed into
  bool wantsKeyboard() const;  // a text field is being edited
  bool navigating() const;     // a widget is chosen by keyboard or gamepad
  bool wantsFrames() const;    // something changes by itself: a text cursor, a button that is held

 private:
  void initVulkan();
  void saveLayout();
  void prepareTheme();

  struct Context {
    Context();
    ~Context();
  };
  struct Backend;

  Renderer& renderer_;
  Window& window_;
  PanelWindows windows_;
  Context context_;
  Theme theme_ = Theme::dark;
  float scale_ = 0.0f;  // of fonts and sizes: the monitor's by the user's; 0: nothing is made yet
  DescriptorPoolHandle pool_;
  std::unique_ptr<Backend> backend_;
  IdleGuard idle_;
};

}  // namespace speculum
