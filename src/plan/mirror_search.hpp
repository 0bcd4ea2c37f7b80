#pragma once

#include "geometry/recycled_memory.hpp"
#include "plan/image_reuse.hpp"

namespace speculum {

// A view and the mirrors seen in it that get passes, before the order of recording is known.
struct MirrorNode {
  Pass pass;
  size_t draw = 0;                    // index of its mirror among the parent's draws
  RecycledVector<int> children;       // indices of nodes
  std::optional<ImageChoice> choice;  // set for mirrors seen directly whose images are cached
};

// Finds the mirrors that get a pass within the budget of passes. The first node is the main view of `size` texels. Adds
// every other mirror that a view sees to plan.skipped, with the reason. Reads the projection and the picture's size
// from `plan`.
RecycledVector<MirrorNode> findPasses(const Scene& scene, const SceneState& state, const Settings& settings,
                                      const FrameCache& cache, const glm::ivec2& size, FramePlan& plan);

// Returns the pass's view, widened by the distance to which lookups read the pass's image beyond the mirror's visible
// region. All views get the margin that cached images need, the widest of all, so that every update interval draws the
// same things in the same order.
View readableView(const Pass& pass, const Projection& projection);

}  // namespace speculum
