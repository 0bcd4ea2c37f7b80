// What the window of targets shows.
#include <algorithm>

#include "app/demo.hpp"
#include "frame/pass_mask.hpp"

namespace speculum {

namespace {

// The one that is pointed at, if the image is still as large as when the panel said so.
std::optional<glm::ivec2> targetTexel(const UiTargets& targets) {
  const glm::ivec2 texel = *targets.pointed;
  return texel.x < targets.size.x && texel.y < targets.size.y ? targets.pointed : std::nullopt;
}

}  // namespace

void Demo::showTexel(const FramePlan& plan) {
  UiTargets& targets = model_.targets;
  targets.value.reset();
  if (const std::optional<TexelValue>& probed = sceneRenderer_->probed()) {
    targets.value = {.texel = probed->texel,
                     .depth = probed->depth,
                     .metres = plan.projection.near / static_cast<double>(probed->storedDepth),
                     .value = probed->value};
  }
}

std::optional<DebugView> Demo::debugView(const FramePlan& plan, const Settings& drawn) {
  const auto pass = std::find_if(plan.passes.begin(), plan.passes.end(),
                                 [&](const PlannedPass& p) { return watched_ && p.view.path == *watched_; });
  const bool ofMain = watched_ && watched_->empty();
  if (!ofMain && pass == plan.passes.end()) {
    watched_.reset();
    return std::nullopt;
  }
  describeTarget(plan, ofMain ? plan.main : *pass, drawn);
  if (!model_.debugArea || shot_ == Shot::picture) {
    return std::nullopt;
  }
  const UiTargets& targets = model_.targets;
  return DebugView{.pass = static_cast<int>(pass - plan.passes.begin()),
                   .area = *model_.debugArea,
                   .kind = targets.kind == 1 ? TargetKind::depth : TargetKind::color,
                   .zoom = targets.shownZoom,
                   .origin = targets.origin,
                   .halfDistance = targets.halfDistance,
                   .probe = targets.pointed && targets.kind < 2 ? targetTexel(targets) : std::nullopt};
}

void Demo::describeTarget(const FramePlan& plan, const PlannedPass& pass, const Settings& drawn) {
  const View& view = pass.view;
  const auto texel = [&](const glm::dvec2& device) {
    return glm::vec2((0.5 * device + 0.5) * view.pictureSize - glm::dvec2(view.rect.x, view.rect.y));
  };
  UiTargets& targets = model_.targets;
  targets.size = {view.rect.width, view.rect.height};
  targets.mask.clear();
  targets.mirrors.clear();
  if (!view.path.empty() && drawn.debug.maskPasses) {
    const double reach = lookupReach(drawn, device_.limits().standardSampleLocations);
    for (const glm::dvec2& p : passMask(view, plan.projection, reach)) {
      targets.mask.push_back(texel(p));
    }
  }
  if (targets.mask.empty()) {
    const glm::vec2 size(targets.size);
    targets.mask = {{0.0f, 0.0f}, {size.x, 0.0f}, size, {0.0f, size.y}};
  }
  for (const MirrorDraw& mirror : pass.mirrors) {
    std::vector<glm::vec2> outline;
    for (const glm::dvec4& clip : toClip(view, plan.projection, visiblePart(view, mirror.polygon))) {
      if (clip.w > 1e-12) {
        outline.push_back(texel(glm::dvec2(clip) / clip.w));
      }
    }
    targets.mirrors.push_back(std::move(outline));
  }
}

}  // namespace speculum
