#pragma once

#include <string>
#include <vector>

#include "frame/frame_plan.hpp"

namespace speculum {

// What was recorded for one pass; its GPU figures follow under the same index in FrameTimings::passes.
struct RecordedPass {
  std::string name;  // for people
  PassKind kind = PassKind::mirror;
  std::vector<int> path;  // mirrors from the eye, indices into Scene::mirrors; empty for other passes
  int depth = -1;         // of a mirror: 0 seen directly; -1 for other passes
  uint32_t draws = 0;
  double areaPx = 0.0;
};

}  // namespace speculum
