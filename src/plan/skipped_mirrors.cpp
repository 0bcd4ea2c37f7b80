#include "plan/skipped_mirrors.hpp"

#include <algorithm>

#include "plan/mirror_sight.hpp"

namespace speculum {

namespace {

bool isBefore(const MirrorPath& a, const MirrorPath& b) {
  return a.size() != b.size() ? a.size() < b.size() : a < b;
}

// Returns the passes whose skipped mirrors are listed, in the order of the list.
RecycledVector<const Pass*> listedPasses(const FramePlan& plan) {
  RecycledVector<const Pass*> listed;
  for (const Pass& pass : plan.passes) {
    const auto isShown = [&](const CachedImage& image) {
      return image.cacheIndex >= 0 && image.mirror == pass.view.path.front();
    };
    if (!pass.isFace() && (pass.view.path.empty() || std::ranges::none_of(plan.cached, isShown))) {
      listed.push_back(&pass);
    }
  }
  std::ranges::sort(listed, isBefore, [](const Pass* pass) -> const MirrorPath& { return pass->view.path; });
  return listed;
}

SkippedMirror unseenMirror(const Scene& scene, const SceneState& state, const View& view, int mirror) {
  const MirrorState& placed = state.mirrors[mirror];
  const double height = heightAbove(placed, view.eye);
  if (isBehindEye(view, placed.polygon)) {
    return skippedMirror(view, mirror, SkipReason::behind);
  }
  return showsBack(scene.mirror(mirror), height) ? skippedBack(view, mirror, height)
                                                 : skippedMirror(view, mirror, SkipReason::outside);
}

}  // namespace

SkippedMirror skippedMirror(const View& view, int mirror, SkipReason reason, RecycledString detail) {
  SkippedMirror skipped{mirror, view.path, static_cast<int>(view.path.size()), reason, std::move(detail)};
  skipped.path.push_back(mirror);
  return skipped;
}

SkippedMirror skippedBack(const View& view, int mirror, double height) {
  return skippedMirror(view, mirror, SkipReason::backface, height == 0.0 ? "the eye is in its plane" : "");
}

RecycledVector<SkippedMirror> skippedMirrors(const Scene& scene, const SceneState& state, const FramePlan& plan,
                                             size_t most) {
  RecycledVector<SkippedMirror> all = plan.skipped;
  std::ranges::sort(all, isBefore, &SkippedMirror::path);
  const auto seen = static_cast<std::ptrdiff_t>(all.size());
  for (const Pass* pass : listedPasses(plan)) {
    const View& view = pass->view;
    for (int i = 0;
         pass->unseen > 0 && all.size() - static_cast<size_t>(seen) < most && i < static_cast<int>(scene.mirrorCount());
         ++i) {
      const bool own = !view.path.empty() && view.path.back() == i;
      if (own || std::ranges::binary_search(pass->mirrors, i, {}, &MirrorDraw::mirror)) {
        continue;
      }
      SkippedMirror unseen = unseenMirror(scene, state, view, i);
      if (!std::binary_search(all.begin(), all.begin() + seen, unseen,
                              [](const auto& a, const auto& b) { return isBefore(a.path, b.path); })) {
        all.push_back(std::move(unseen));
      }
    }
  }
  // Both parts are in order: passes are, and so are the mirrors of each.
  std::ranges::inplace_merge(all, all.begin() + seen, isBefore, &SkippedMirror::path);
  all.resize(std::min(all.size(), most));
  return all;
}

size_t skippedCount(const FramePlan& plan) {
  size_t count = plan.skipped.size();
  for (const Pass* pass : listedPasses(plan)) {
    count += pass->unseen;
  }
  return count;
}

}  // namespace speculum
