#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "frame/frame_plan.hpp"

namespace speculum {

// Device memory of a plan's render targets: the main view, environment maps, the mirror images of earlier frames that
// it shows, and those alive at one time with their depth.
uint64_t targetBytes(const FramePlan& plan, const Settings& settings);

struct TargetLimits {
  uint64_t budgetBytes = 0;  // for all render targets together
  int largestSide = 0;       // pixels of a picture, at any resolution
  bool tracesRays = true;    // shaders can tell on which triangle a ray starts, and the scene fits their buffers
};

struct FittedPlan {
  FramePlan plan;
  Settings settings;    // as asked for, or lowered
  std::string message;  // what was lowered and why; empty if nothing was
};

// planFrame, with the resolution of mirror images within the largest side, and samples of mirror images, then of the
// main view, then the resolution of mirror images and of environment maps halved step by step until the targets fit the
// budget. What cannot be lowered any more is planned as it is. Before that, images that reflection.skip_unchanged would
// show again are rendered with the others, if that needs less. Effects that trace rays are left out where the device
// cannot.
FittedPlan planWithin(const TargetLimits& limits, const Scene& scene, const SceneState& state, const Settings& settings,
                      int width, int height, EarlierImages earlier = {});

// Of the maps' targets, with the depth that they share.
uint64_t environmentBytes(const FramePlan& plan);

}  // namespace speculum
