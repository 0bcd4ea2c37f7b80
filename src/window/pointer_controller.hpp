#pragma once

#include "platform/window.hpp"
#include "window/camera_controller.hpp"
#include "window/scene_editor.hpp"

namespace speculum {

// Turns the pointer's events over the picture into drags of handles or the camera, and clicks that select.
class PointerController {
 public:
  // Handles a press or release. `overPanels` says that the event belongs to the panels. `view` is the scene as it is
  // shown now, if the window has pixels. Returns true if a click may have selected something.
  bool button(const MouseButtonEvent& event, bool overPanels, SceneEditor& editor,
              const std::optional<PointedScene>& view);
  // Handles a move to `position` (screen coordinates of the window). One screen coordinate is `pixelsPerUnit` pixels of
  // the picture; `height` is the window's, in screen coordinates. With `snap`, drags go in steps.
  void move(const glm::dvec2& position, const glm::dvec2& pixelsPerUnit, double height, bool snap, SceneEditor& editor,
            CameraController& camera);
  void cancel();  // call when another scene is shown

  const glm::dvec2& position() const { return position_; }  // screen coordinates
  const glm::dvec2& pixel() const { return pixel_; }        // of the picture
  bool dragging() const { return dragging_; }

 private:
  MouseButton button_ = MouseButton::left;  // button that went down over the picture
  bool shift_ = false;                      // Shift was held at the press
  std::optional<glm::dvec2> pressed_;       // position of the press; none: no button is down
  bool holdsHandle_ = false;                // the press gripped a handle, not the picture
  bool dragging_ = false;
  glm::dvec2 position_{0.0};
  glm::dvec2 pixel_{0.0};
};

}  // namespace speculum
