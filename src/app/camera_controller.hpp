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
// Holds the selected thing; with nothing selected objects and mirrors as they are, of radius 0 if there are none.
Sphere boundsOf(const Scene& scene, const SceneState& state, const Selection& selection = {});

// Moves the camera by hand. Until it is first touched, the camera is the scene's, animation included.
class CameraController {
 public:
  void reset(const CameraSpec& spec);
  // Stands there as if it had been moved there by hand.
  void stand(const CameraSpec& spec);
  void setMode(CameraMode mode) { mode_ = mode; }

  // Drag of the pointer in pixels; fly: turns the view, orbit: turns about the target.
  void drag(double dx, double dy);
  // Drag of the pointer in pixels of a picture of that height: what is as far as the target follows the pointer.
  void pan(double dx, double dy, double pictureHeight);
  // Degrees, to the right and downwards: as drag does.
  void turn(double yaw, double pitch);
  // Notches of the wheel; orbit: nearer to the target, fly: along the view.
  void zoom(double notches);
  // Along right, up and backwards of the view, each in -1 .. 1, for `seconds`.
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

  // Stands behind the mirror or at its surface, before its middle, and looks where its front looks. From behind it is
  // as far off as shows all of its back. `aspect` as above.
  void lookFrom(const MirrorState& mirror, MirrorSide side, double aspect);

  // The camera as it stands by hand; nothing while it is the scene's.
  std::optional<CameraSpec> place() const;

  CameraPose pose(const CameraPose& animated);

 private:
  void take(const CameraPose& pose);
  double narrowerHalfAngle(double aspect) const;

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
