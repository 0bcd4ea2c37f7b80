#pragma once

#include <cstdint>
#include <string>

#include "frame/frame_plan.hpp"

namespace speculum {

// Device memory of a plan's render targets: the main view, and the mirror images alive at one time with their depth.
uint64_t targetBytes(const FramePlan& plan, const Settings& settings);

struct FittedPlan {
  FramePlan plan;
  Settings settings;    // as asked for, or lowered
  std::string message;  // what was lowered and why; empty if nothing was
};

// planFrame, with samples of mirror images, then of the main view, then the resolution of mirror images halved step by
// step until the targets take at most `budgetBytes`. What cannot be lowered any more is planned as it is.
FittedPlan planWithin(uint64_t budgetBytes, const Scene& scene, const SceneState& state, const Settings& settings,
                      int width, int height);

}  // namespace speculum
