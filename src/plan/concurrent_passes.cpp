#include "plan/concurrent_passes.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace speculum {

namespace {

double area(const Pass& pass) {
  return static_cast<double>(pass.view.rect.area());
}

bool showsImageOf(const Pass& pass, size_t first) {
  return std::ranges::any_of(pass.mirrors,
                             [&](const MirrorDraw& draw) { return draw.pass >= static_cast<int>(first); });
}

}  // namespace

RecycledVector<ConcurrentPasses> independentPasses(const FramePlan& plan) {
  RecycledVector<ConcurrentPasses> ranges;
  double covered = 0.0;  // pixels that the last range covers
  for (size_t i = 0; i < plan.passes.size(); ++i) {
    const Pass& pass = plan.passes[i];
    if (pass.id.kind != PassKind::mirror || !pass.drawn()) {
      continue;
    }
    const double picture = pass.view.pictureSize.x * pass.view.pictureSize.y;
    if (ranges.empty() || showsImageOf(pass, ranges.back().first) || covered + area(pass) > picture) {
      ranges.push_back({i, i});
      covered = 0.0;
    }
    ranges.back().end = i + 1;
    covered += area(pass);
  }
  return ranges;
}

RecycledVector<size_t> largestFirst(const FramePlan& plan, const ConcurrentPasses& range) {
  RecycledVector<size_t> passes(range.end - range.first);
  std::iota(passes.begin(), passes.end(), range.first);
  std::ranges::sort(passes, {}, [&](size_t i) { return std::pair(-area(plan.passes[i]), i); });
  return passes;
}

}  // namespace speculum
