#pragma once

#include "plan/frame_plan.hpp"

namespace speculum {

// Returns the mirror in a view, for a list of skipped ones.
SkippedMirror skippedMirror(const View& view, int mirror, SkipReason reason, RecycledString detail = {});
// Returns it as one whose back is seen by the view's eye, `height` metres before its front.
SkippedMirror skippedBack(const View& view, int mirror, double height);

// Length at which the lists that users see end: about 25 MB as JSON.
constexpr size_t mostListed = 100'000;

// Returns the mirrors in views that have no pass, ascending by depth, then by path: those of FramePlan::skipped and,
// with their reasons, those that the views do not see. Returns the first `most` of them. Does not list mirrors in
// cached images. `scene` and `state` are those that were planned.
RecycledVector<SkippedMirror> skippedMirrors(const Scene& scene, const SceneState& state, const FramePlan& plan,
                                             size_t most);
// Returns the length that the list has without a limit.
size_t skippedCount(const FramePlan& plan);

}  // namespace speculum
