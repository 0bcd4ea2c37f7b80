#pragma once

#include <cstdint>
#include <string>

#include "plan/frame_plan.hpp"

namespace speculum {

struct TargetLimits {
  uint64_t budgetBytes = 0;   // for all render targets together
  int largestSide = 0;        // largest width or height of a target, pixels
  bool keepsPicture = false;  // the last picture stays in memory while a still one is drawn, as in the window
  std::string whyNoRays;      // why the device cannot trace rays through the scene; empty: it can
  bool cpu = false;           // the device is a CPU
  bool hybridShadows = true;  // the device draws edges of triangles, and interpolates inputs at any place
};

struct FittedPlan {
  FramePlan plan;
  Settings settings;    // as requested, or lowered
  std::string message;  // what was lowered and why; empty if nothing was
  bool traces = true;   // the device can trace rays through the scene
};

// Plans with settings lowered until the targets fit the limits. First unchanged images are rendered instead of reused,
// if that needs less memory. Then the following are halved step by step: samples of mirror images, samples of the main
// view, resolution of mirror images and maps. A plan that still does not fit is returned as it is. Where the device
// cannot trace, traced effects are looked up in images and maps, or left out if there are none; and reflection.method
// and effects.shadow_lookup = auto become the faster method. Before all this, the request's settings become
// pictureSettings().
FittedPlan planWithin(const TargetLimits& limits, const FrameRequest& request);

// Plans pictures within the limits of a device.
class PicturePlanner {
 public:
  virtual ~PicturePlanner() = default;
  virtual FittedPlan plan(const FrameRequest& request) = 0;
};

}  // namespace speculum
