#pragma once

#include <limits>
#include <optional>

#include "edit/selection.hpp"
#include "scene/scene_state.hpp"
#include "ui/commands.hpp"

namespace speculum {

struct Sphere {
  glm::dvec3 center{0.0};  // world
  double radius = 0.0;     // metres
};
// Returns a sphere around the selected node or, with nothing selected, around all objects and mirrors; of radius 0 if
// there are none.
Sphere boundsOf(const Scene& scene, const SceneState& state, const Selection& selection = {});

// Camera that the user moves. Until the user does, it is the scene's, animation included.
class CameraController {
 public:
  void reset(const CameraSpec& spec);
  // Moves the camera there, as if the user had.
  void moveTo(const CameraSpec& spec);
  void setMode(CameraMode mode) { mode_ = mode; }

  // Turns the view by a drag of the pointer, in pixels; in orbit mode about the target.
  void drag(double dx, double dy);
  // Moves the camera sideways by a drag of the pointer, in pixels of a picture of that height, so that points as far
  // away as the target follow the pointer.
  void pan(double dx, double dy, double pictureHeight);
  // Turns as drag() does, by degrees to the right and downwards.
  void turn(double yaw, double pitch);
  // Moves by notches of the wheel: nearer to the target in orbit mode, along the view in fly mode.
  void zoom(double notches);
  // Flies along right, up and backwards of the view, each in -1 .. 1, for `seconds`.
  void move(const glm::dvec3& direction, double seconds);

  // Part of the picture, from (-1, -1) at its lower left to (1, 1).
  struct Part {
    glm::dvec2 center{0.0};
    glm::dvec2 half{1.0};
  };
  // Shows all of the sphere in a part of the picture, in the direction of now, and orbits about its center. `aspect`:
  // width / height of the picture.
  void frame(const Sphere& sphere, double aspect, const Part& part);
  // Height along up that orbits do not go below, unless the eye is there already.
  void setFloor(double height) { floor_ = height; }

  // Looks from the mirror's middle in the direction of its front: from its surface, or from so far behind that all of
  // its back is seen. `aspect` as above.
  void lookFrom(const MirrorState& mirror, MirrorSide side, double aspect);

  // Returns the camera if the user has moved it; nothing while it is the scene's.
  std::optional<CameraSpec> place() const;

  CameraPose pose(const CameraPose& animated);

 private:
  void startFrom(const CameraPose& pose);

  CameraSpec spec_;
  CameraMode mode_ = CameraMode::orbit;
  CameraPose last_;
  bool touched_ = false;
  glm::dvec3 eye_{0.0};              // world
  glm::dvec3 target_{0.0};           // world; in fly mode a point ahead
  std::optional<glm::dvec3> pivot_;  // of orbits, where it is not the target
  double floor_ = -std::numeric_limits<double>::infinity();
};

}  // namespace speculum
