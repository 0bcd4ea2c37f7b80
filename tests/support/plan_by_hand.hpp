#pragma once

#include "plan/frame_plan.hpp"

namespace speculum::testing_support {

// Adds a pass of a mirror before the main view of a plan that a test makes by hand.
inline Pass& addMirror(FramePlan& plan, const MirrorPath& path, PassSource source = PassSource::drawn) {
  Pass pass{.id = {.path = path}, .source = source};
  pass.view.path = path;
  return *plan.passes.insert(plan.passes.end() - 1, std::move(pass));
}

}  // namespace speculum::testing_support
