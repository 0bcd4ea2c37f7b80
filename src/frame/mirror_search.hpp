#pragma once

#include "frame/image_reuse.hpp"

namespace speculum {

// A pass before its index in the order of recording is known.
struct PassNode {
  PlannedPass pass;
  size_t draw = 0;                    // index of its mirror among the parent's draws
  std::vector<int> children;          // nodes
  std::optional<ImageChoice> choice;  // set for mirrors seen directly whose images are cached
};

// Finds the mirrors that deserve a pass, by the budget of passes; the first node is the main view of `size` texels.
// Adds to plan.skipped why every other mirror has none. Reads the projection and the picture's size of `plan`.
std::vector<PassNode> findPasses(const Scene& scene, const SceneState& state, const Settings& settings,
                                 const FrameCache& cache, const glm::ivec2& size, FramePlan& plan);

// Widens the view by what look-ups read of its image beyond the visible region. Cached images are read farthest; all
// views get that margin, so that the same is drawn in the same order with every update interval.
View readableView(const View& view, const Projection& projection, const Settings& settings);

// Notes why a mirror in a view has no pass.
void skipMirror(FramePlan& plan, const View& view, int mirror, SkipReason reason, std::string detail = {});

}  // namespace speculum
