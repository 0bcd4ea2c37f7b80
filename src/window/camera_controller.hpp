#pragma once

#include <limits>
#include <optional>

#include "edit/selection.hpp"
#include "platform/gamepad.hpp"
#include "scene/scene_state.hpp"
#include "ui/shown.hpp"

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
  void sceneChanged(const Scene& scene);  // call when another scene is shown
  void reset(const CameraSpec& spec);
  void setMode(CameraMode mode) { shown_.mode = mode; }
  void toggleMode() { setMode(shown_.mode == CameraMode::fly ? CameraMode::orbit : CameraMode::fly); }

  // Turns the view by a drag of the pointer, in pixels; in orbit mode about the target.
  void drag(double dx, double dy);
  // Moves the camera sideways by a drag of the pointer, in pixels of a picture of that height. Points as far away as
  // the target follow the pointer.
  void pan(double dx, double dy, double pictureHeight);
  // Turns as drag() does, by degrees to the right and downwards.
  void turn(double yaw, double pitch);
  // Moves by notches of the wheel: nearer to the target in orbit mode, along the view in fly mode.
  void zoom(double notches);
  // Flies along right, up and backwards of the view, each in -1 .. 1, for `seconds`, and by the gamepad's sticks.
  void move(const glm::dvec3& direction, const GamepadState& pad, double seconds);

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
  // Looks so from the selected mirror, else from the one that fills most of the picture, else from the last one looked
  // from. Returns its index; -1 if the scene has none.
  int lookFromMirror(MirrorSide side, const SceneState& state, const Selection& selected,
                     std::span<const PassRow> passes, double aspect);

  void goToBookmark(size_t index, const Scene& scene);
  void goToNextBookmark(const Scene& scene);
  // Returns the view of `pose` as a bookmark. It has an up and a field of view of its own if they differ from the
  // scene's.
  Bookmark bookmark(const CameraPose& pose, const CameraSpec& usual) const;
  void setBookmark(int index) { shown_.bookmark = index; }
  void bookmarksChanged(const Scene& scene);

  bool moved() const { return touched_; }  // by the user
  CameraPose pose(const CameraPose& animated);
  const ShownCamera& shown() const { return shown_; }

 private:
  void takeOver();
  void fly(const glm::dvec3& direction, double seconds);

  CameraSpec spec_;
  ShownCamera shown_;
  CameraPose last_;
  bool touched_ = false;
  glm::dvec3 eye_{0.0};              // world
  glm::dvec3 target_{0.0};           // world; in fly mode a point ahead
  std::optional<glm::dvec3> pivot_;  // of orbits, where it is not the target
  double floor_ = -std::numeric_limits<double>::infinity();
  int lastMirror_ = -1;  // last mirror looked from; -1: none yet
};

}  // namespace speculum
