#pragma once

#include "scene/scene_state.hpp"
#include "ui/ui_model.hpp"

namespace speculum {

// Moves the camera by hand. Until it is first touched, the camera is the scene's, animation included.
class CameraController {
 public:
  void reset(const CameraSpec& spec);
  void setMode(CameraMode mode) { mode_ = mode; }

  // Drag of the pointer in pixels; fly: turns the view, orbit: turns about the target.
  void drag(double dx, double dy);
  // Notches of the wheel; orbit: nearer to the target, fly: along the view.
  void zoom(double notches);
  // Along right, up and backwards of the view, each in -1 .. 1, for `seconds`.
  void move(const glm::dvec3& direction, double seconds);

  CameraPose pose(const CameraPose& animated);

 private:
  void take(const CameraPose& pose);

  CameraSpec spec_;
  CameraMode mode_ = CameraMode::orbit;
  CameraPose last_;
  bool touched_ = false;
  glm::dvec3 eye_{0.0};     // world
  glm::dvec3 target_{0.0};  // world; in fly mode a point ahead
};

}  // namespace speculum
