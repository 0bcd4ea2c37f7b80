#pragma once

#include <functional>
#include <string>
#include <vector>

#include "accuracy/sweep_planner.hpp"
#include "accuracy/sweep_store.hpp"

namespace speculum {

// Times of a frame, milliseconds.
struct FrameCost {
  double gpuMs = 0.0;  // 0 where the device has no timestamps
  double cpuMs = 0.0;
  double frameMs = 0.0;
};

// Thrown by a subject to cancel the sweep: what is complete so far is kept.
struct SweepCancelled {};

// The renderer that a sweep measures.
class SweepSubject {
 public:
  virtual ~SweepSubject() = default;
  // Returns display pictures of the sweep's scene at its time: one or, with reflection.update_interval n, the n
  // pictures that differ in the age of their mirror images. Of a movement it returns each frame, in order.
  virtual std::vector<Image8> pictures(const Settings& settings) = 0;
  // Returns a text that describes the work for the last picture, or for all of a movement. Settings that do not change
  // the work give the same text.
  virtual std::string work() const { return {}; }
  // Draws a frame that does not count, then measures one; with an update interval, the mean over one interval. Of a
  // movement it measures the mean over the frames.
  virtual FrameCost cost(const Settings& settings) = 0;
};

struct SweepScene {
  const Scene& scene;
  std::function<SceneState(int)> stateOf;  // of frame 0 .. frames - 1
  int frames = 1;                          // of a movement; 1: a still picture
  TruthRequest truth;                      // for the reference of each frame; runSweep() sets its settings
  std::string identity;  // fingerprint of all that results depend on but settings: program, device, scene, time
};

// Frames of a movement whose pictures are kept: the first ones, since those that follow each other show flicker.
inline constexpr int mostFramesKept = 24;

struct SweepStatus {
  std::string stage;      // name to show, such as "reference"
  double fraction = 0.0;  // finished part of the stage, 0 .. 1
};
using SweepProgress = std::function<bool(const SweepStatus&)>;  // false cancels

// Traces the reference of each frame, draws every configuration and compares it with the reference, leaves out
// configurations that draw the pictures of an earlier one with the same work, then takes the times: in rounds through
// all configurations, so that other load on the machine affects all alike. Measurements in `store` are used again; new
// measurements are saved at once. Fills the truth, the points with their front and the series in `results`. Blocks;
// calls `subject` on the caller's thread. Returns false if cancelled.
bool runSweep(const SweepPlan& plan, const Settings& base, const SweepScene& scene, SweepSubject& subject,
              SweepStore& store, SweepResults& results, const SweepProgress& progress);

}  // namespace speculum
