#pragma once

#include <algorithm>
#include <limits>
#include <optional>

#include "edit/selection.hpp"
#include "platform/keys.hpp"
#include "scene/scene_state.hpp"
#include "scene/value_range.hpp"
#include "ui/shown.hpp"
#include "window/accuracy_controller.hpp"

namespace speculum {

struct Sphere {
  glm::dvec3 center{0.0};  // world
  double radius = 0.0;     // metres
};
// Returns a sphere around the selected node or, with nothing selected, around all objects and mirrors. Its radius is 0
// if there are none.
Sphere boundsOf(const Scene& scene, const SceneState& state, const Selection& selection = {});

// The camera of the window. Until the user moves it, it is the scene's camera, animation included.
class CameraController {
 public:
  void sceneChanged(const Scene& scene);  // call when another scene is shown
  void reset(const CameraSpec& spec);     // back to the scene's camera
  void setMode(CameraMode mode) { shown_.mode = mode; }
  void toggleMode() { setMode(shown_.mode == CameraMode::fly ? CameraMode::orbit : CameraMode::fly); }

  // Turns the view by a drag of the pointer, in screen coordinates; in orbit mode about the target.
  void drag(double dx, double dy);
  // Moves the camera sideways by a drag of the pointer, in screen coordinates, like the picture's height. Points as far
  // away as the target follow the pointer.
  void pan(double dx, double dy, double pictureHeight);
  // Turns as drag() does, by degrees to the right and downwards.
  void turn(double yaw, double pitch);
  // Moves by notches of the wheel: nearer to the target in orbit mode, along the view in fly mode.
  void zoom(double notches);
  // Flies for `seconds` along `direction` (right, up and backwards of the view, each in -1 .. 1), and flies and turns
  // by the gamepad's sticks and triggers.
  void move(const glm::dvec3& direction, const GamepadState& pad, double seconds);

  // Part of the picture, from (-1, -1) at its lower left to (1, 1).
  struct Part {
    glm::dvec2 center{0.0};
    glm::dvec2 half{1.0};
  };
  // Moves the camera, without turning it, until a part of the picture shows all of the sphere. Orbits then turn about
  // the sphere's center. `aspect`: width / height of the picture.
  void frame(const Sphere& sphere, double aspect, const Part& part);
  // Sets the height along the camera's up, in metres, that orbits do not take the eye below, unless it is there
  // already.
  void setFloor(double height) { floor_ = height; }

  // Looks along the mirror's normal: for MirrorSide::front from its surface, for MirrorSide::back from so far behind
  // its middle that all of its back is seen. `aspect`: width / height of the picture.
  void lookFrom(const MirrorState& mirror, MirrorSide side, double aspect);
  // Calls lookFrom() for the selected mirror, else for the one that fills most of the picture, else for the last one
  // looked from, else for the first one. Returns its index; -1 if the scene has no mirror.
  int lookFromMirror(MirrorSide side, const SceneState& state, const Selection& selected,
                     std::span<const PassRow> passes, double aspect);

  void goTo(const Bookmark& view, const Scene& scene);
  void goToBookmark(size_t index, const Scene& scene);
  void goToNextBookmark(const Scene& scene);
  // Returns `pose` as a bookmark. The bookmark has an up and a field of view only if they differ from those of `usual`,
  // the scene's camera.
  Bookmark bookmark(const CameraPose& pose, const CameraSpec& usual) const;
  void setBookmark(int index) { shown_.bookmark = index; }  // the one used last
  void bookmarksChanged(const Scene& scene);                // call when bookmarks may have been removed

  bool moved() const { return touched_; }  // by the user
  // Returns the camera to draw with: `animated`, the scene's, until the user moves it. The user's first move begins
  // there.
  CameraPose pose(const CameraPose& animated);
  const ShownCamera& shown() const { return shown_; }

 private:
  void takeOver();
  void fly(const glm::dvec3& direction, double seconds);

  CameraSpec spec_;
  ShownCamera shown_;
  CameraPose last_;                                          // that pose() returned last
  bool touched_ = false;                                     // the user has moved the camera
  glm::dvec3 eye_{0.0};                                      // world
  glm::dvec3 target_{0.0};                                   // world; in fly mode a point ahead
  std::optional<glm::dvec3> pivot_;                          // world; point that orbits turn about; none: the target
  double floor_ = -std::numeric_limits<double>::infinity();  // metres along up, see setFloor()
  int lastMirror_ = -1;                                      // last mirror looked from; -1: none yet
};

// The time of the animation.
class Playback {
 public:
  void seek(double seconds) {
    shown_.time = std::clamp(seconds, 0.0, timeRange.high);
    ++seeks_;
  }
  void step(int steps) {
    shown_.paused = true;
    seek(shown_.time + steps * timeStep);
  }
  void setPaused(bool paused) {
    shown_.paused = paused;
    nextPlays_ = false;
  }
  void hold() {  // pauses this scene only
    nextPlays_ = nextPlays_ || !shown_.paused;
    shown_.paused = true;
  }
  void playNext() { nextPlays_ = true; }  // although this scene is paused
  void sceneChanged() {
    seek(0.0);
    if (std::exchange(nextPlays_, false)) {
      shown_.paused = false;
    }
  }
  void setCost(const std::string& cost) { shown_.cost = cost; }
  void setSpeed(double speed) { shown_.speed = std::clamp(speed, slowestTime, fastestTime); }
  double after(double seconds) const { return shown_.time + (shown_.paused ? 0.0 : seconds * shown_.speed); }
  void advance(double seconds) { shown_.time = after(seconds); }
  const ShownPlayback& shown() const { return shown_; }
  int seeks() const { return seeks_; }  // how often the time was set

 private:
  ShownPlayback shown_;
  int seeks_ = 0;
  bool nextPlays_ = false;  // the program paused the animation, not the user
};

// How the window looks at a scene: with its own camera, at a time of the animation.
struct ViewController {
  CameraController camera;
  Playback playback;

  double time() const { return playback.shown().time; }
  // Says whether the picture depends on the time.
  bool animated(const Scene& scene) const { return camera.moved() ? contentMoves(scene) : moves(scene); }
  SceneState state(const Scene& scene, double time);
  WatchedState watchedState(const Scene& scene, const SceneState& shown) const;
  // Returns a bookmark of what is seen now.
  Bookmark bookmark(const Scene& scene) { return camera.bookmark(state(scene, time()).camera, scene.camera); }
  // Frames a node or, with none, the whole scene within `free`, the part of a picture of `size` pixels that no panel
  // covers.
  void frame(const Scene& scene, const Selection& node, const glm::ivec2& size, const PixelRect& free);
  // Looks out of the mirror that CameraController::lookFromMirror() finds. Returns what is seen then, as a sentence.
  std::string lookFromMirror(const Scene& scene, MirrorSide side, const Selection& selected,
                             std::span<const PassRow> passes, const glm::ivec2& size);
};

}  // namespace speculum
