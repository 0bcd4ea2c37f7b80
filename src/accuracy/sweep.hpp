#pragma once

#include <functional>
#include <string>
#include <vector>

#include "accuracy/sweep_plan.hpp"
#include "accuracy/sweep_store.hpp"

namespace speculum {

// Milliseconds.
struct FrameCost {
  double gpuMs = 0.0;  // 0 where the device has no timestamps
  double cpuMs = 0.0;
  double frameMs = 0.0;
};

// The renderer that a sweep measures.
class SweepSubject {
 public:
  virtual ~SweepSubject() = default;
  // Display pictures of the sweep's scene at its time: one, or with reflection.update_interval n the n that differ in
  // the age of their mirror images.
  virtual std::vector<Image8> pictures(const Settings& settings) = 0;
  // Draws a frame that does not count, then one that does; with an update interval the mean over one.
  virtual FrameCost cost(const Settings& settings) = 0;
};

struct SweepScene {
  const Scene& scene;
  SceneState state;
  int width = 0;  // pixels
  int height = 0;
  std::string identity;  // of all that pictures and times depend on beside the settings: program, device, scene, time
  bool noiseFloor = true;
  int truthSamples = 64;  // a square
};

struct SweepStatus {
  std::string stage;      // for people, such as "ground truth"
  double fraction = 0.0;  // of the stage, 0 .. 1
};
using SweepProgress = std::function<bool(const SweepStatus&)>;  // false cancels

// Traces the ground truth, draws every configuration and compares it, then takes the times: in rounds through all
// configurations, so that what disturbs the machine for a while disturbs all alike. What `store` has is not measured
// again; what is new is saved as it comes. Fills what is measured in `results`: truth, points with their front, series
// with their fits. False if cancelled.
bool runSweep(const SweepPlan& plan, const Settings& base, const SweepScene& scene, SweepSubject& subject,
              SweepStore& store, SweepResults& results, const SweepProgress& progress);

}  // namespace speculum
