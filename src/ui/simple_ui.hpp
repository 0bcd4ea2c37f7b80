#pragma once

#include <memory>

#include "core/renderer.hpp"
#include "ui/panel_windows.hpp"

namespace speculum {

class ForeignGlyphs;

// The panels over the picture: Dear ImGui with its GLFW and Vulkan backends. One instance a process.
class SimpleUI {
 public:
  SimpleUI(Renderer& renderer, Window& window);
  ~SimpleUI();
  SimpleUI(const SimpleUI&) = delete;
  SimpleUI& operator=(const SimpleUI&) = delete;

  void push(const InputEvent& event);  // call with each event of the window
  // Lays out this frame's panels. Call it once a frame, even if nothing is drawn.
  UiOutput build(const UiInput& input);
  enum class Part { all, divider, status };  // divider: with the labels of A | B
  // Draws the panels of the last build() over the display image, or a part of them. Call it once a frame.
  void record(Frame& frame, Part part = Part::all);
  // Reads what only the window system knows, for the next build(). It may wait for an answer.
  void readWindow();
  void setThumbnails(std::vector<Image8> pictures);  // of ShownScenes::scenes, from the next frame on
  void setPoster(const Image8& picture);             // thumbnail that ShownScenes::poster shows, from the next frame on
  PanelWindows& windows() { return windows_; }
  const PanelWindows& windows() const { return windows_; }

  // Says whether a pointer at this point, in screen coordinates of the window, belongs to the panels: it is over one of
  // their windows, or they hold a widget.
  bool takesPointer(double x, double y) const;
  float scale() const;         // of texts and handles, in pixels: the monitor's, Text size and ui.scale, multiplied
  bool holdsEscape() const;    // ImGui handles Esc itself: it closes or releases something
  bool holdsWidget() const;    // a widget is being dragged, pressed or typed into
  bool wantsKeyboard() const;  // a text field is being edited
  bool navigating() const;     // a widget is chosen by keyboard or gamepad
  bool menuOpen() const;       // a menu or list is open, which takes all keys
  bool hasEvents() const;      // events wait for the next build()
  bool wantsFrames() const;    // something changes by itself: a text cursor, a button that is held

 private:
  void initVulkan();
  bool inRenderPass() const;
  void saveLayout();
  void noteGlyphs(const UiInput& input);
  void prepareTheme();
  float density() const;

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
  std::unique_ptr<ForeignGlyphs> glyphs_;
  float settingScale_ = 1.0f;  // ui.scale
  float scale_ = 0.0f;         // of sizes, in screen coordinates; 0: nothing is made yet
  float letters_ = 0.0f;       // size of the font, pixels
  DescriptorPoolHandle pool_;
  std::unique_ptr<Backend> backend_;
  IdleGuard idle_;
};

}  // namespace speculum
