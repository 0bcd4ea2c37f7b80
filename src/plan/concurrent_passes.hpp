#pragma once

#include <cstddef>

#include "geometry/recycled_memory.hpp"
#include "plan/frame_plan.hpp"

namespace speculum {

// Passes first .. end - 1 of FramePlan::passes.
struct ConcurrentPasses {
  size_t first = 0;
  size_t end = 0;
};

// Cuts the mirror passes that are drawn, in the order of recording, into ranges in which no pass shows the image of
// another, so that a device may overlap them. Each pass of a range has its own depth image; to bound the memory of
// depth images, a range covers no more pixels than a picture at the passes' resolution, unless a single pass does.
RecycledVector<ConcurrentPasses> independentPasses(const FramePlan& plan);

// Returns the passes of a range as indices into FramePlan::passes, largest first. The i-th pass draws with the i-th
// depth image, so that each depth image is as small as it can be.
RecycledVector<size_t> largestFirst(const FramePlan& plan, const ConcurrentPasses& range);

}  // namespace speculum
