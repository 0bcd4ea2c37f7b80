#pragma once

#include "app/camera_controller.hpp"
#include "app/scene_editor.hpp"
#include "platform/window.hpp"

namespace speculum {

// Turns the pointer's events over the picture into drags of handles or the camera, and clicks that select.
class PointerController {
 public:
  // The scene as it is shown now, if the window has pixels.
  using CurrentView = std::function<std::optional<SceneView>()>;

  // `overPanels`: the event belongs to the panels. True if a click may have selected something.
  bool button(const MouseButtonEvent& event, bool overPanels, SceneEditor& editor, const CurrentView& view);
  // Screen coordinates of the window and the picture's pixels for one of them; `height` of the window. `snap`: in
  // steps.
  void move(const glm::dvec2& position, const glm::dvec2& pixelsPerUnit, double height, bool snap, SceneEditor& editor,
            CameraController& camera);
  void cancel();  // the scene is another

  const glm::dvec2& position() const { return position_; }  // screen coordinates
  const glm::dvec2& pixel() const { return pixel_; }        // of the picture
  bool dragging() const { return dragging_; }

 private:
  MouseButton button_ = MouseButton::left;  // that went down over the picture
  bool shift_ = false;                      // held when it did
  std::optional<glm::dvec2> pressed_;       // where
  bool holdsHandle_ = false;                // what is pressed is a handle, not the picture
  bool dragging_ = false;
  glm::dvec2 position_{0.0};
  glm::dvec2 pixel_{0.0};
};

}  // namespace speculum
