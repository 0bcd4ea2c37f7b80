#pragma once

#include <string>
#include <vector>

#include "scene/scene_state.hpp"
#include "session/options.hpp"

namespace speculum {

// The movement that `speculum accuracy --motion` measures, or a single frame.
struct MotionPath {
  double start = 0.0;  // seconds of animation of the first frame
  double fps = 30.0;   // frames per second of animation
  int frames = 1;
  std::vector<CameraPose> cameras{};  // by frame; none: the session's camera

  double timeOf(int frame) const { return start + frame / fps; }  // seconds of animation
};

// Returns the movement of --motion, --time, --frames and --fps: the scene's animation, seen by its own camera or by one
// that goes straight from view to view of a file. Throws InputError with FILE:LINE for a wrong file, UsageError for a
// scene that stands still or for more pixels than a sweep holds.
MotionPath motionPath(const Options& options, const Scene& scene);

// Returns the scene at a frame.
SceneState stateOf(const Scene& scene, const MotionPath& path, int frame);

}  // namespace speculum
