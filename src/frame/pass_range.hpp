#pragma once

#include <cstddef>
#include <vector>

#include "frame/frame_plan.hpp"

namespace speculum {

// Passes first .. end - 1 of FramePlan::passes.
struct PassRange {
  size_t first = 0;
  size_t end = 0;
};

// The plan's passes in the order of recording, cut into ranges within which none shows another's image, so that they
// can be drawn side by side. Passes of a range have depth of their own: together they are no larger than a picture of
// their resolution, unless one alone is.
std::vector<PassRange> independentPasses(const FramePlan& plan);

// Of a range's passes, the largest first: the place in it is that of the depth image it draws with, so that each of
// these images is no larger than it must be.
std::vector<size_t> largestFirst(const FramePlan& plan, const PassRange& range);

}  // namespace speculum
