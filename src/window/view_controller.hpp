#pragma once

#include <algorithm>

#include "scene/value_range.hpp"
#include "window/accuracy_controller.hpp"
#include "window/camera_controller.hpp"

namespace speculum {

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
