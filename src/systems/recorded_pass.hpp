#pragma once

#include <string>

#include "frame/frame_plan.hpp"

namespace speculum {

// One pass as it was recorded. Its GPU figures follow under the same index in the FrameTimings of its frame.
struct RecordedPass : PassId {
  std::string name;  // for the user; two mirrors may share one
  int depth = -1;    // recursion depth of a mirror; -1 for other passes
  uint32_t draws = 0;
  double areaPx = 0.0;
};

}  // namespace speculum
