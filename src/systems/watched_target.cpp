#include "systems/watched_target.hpp"

#include <utility>

#include "frame/picture_tiles.hpp"

namespace speculum {

namespace {

WatchedTarget::Target targetOf(const FramePlan& plan, const DebugView& debug) {
  const View& view = plan.passes[static_cast<size_t>(debug.pass)].view;
  return {debug.pass, view.path, debug.kind, {view.rect.width, view.rect.height}, plan.projection.near};
}

}  // namespace

void WatchedTarget::begin(const FramePlan& plan, const std::optional<DebugView>& debug, RetireQueue& retired) {
  if (beginsPicture(plan)) {
    const std::optional<Target> asked = debug ? std::optional(targetOf(plan, *debug)) : std::nullopt;
    watched_ = !plan.mainReused() || !asked || isAlwaysThere(asked->path, asked->kind) ? asked : watched_;
  }
  if (!debug || debug->kind != TargetKind::depth) {
    if (watched_ && watched_->kind == TargetKind::depth) {
      watched_.reset();
    }
    if (shown_ && shown_->kind == TargetKind::depth) {
      shown_.reset();
    }
    releaseDepth(retired);
  }
}

std::optional<int> WatchedTarget::mirrorPass() const {
  return watched_ && !watched_->path.empty() ? std::optional(watched_->pass) : std::nullopt;
}

void WatchedTarget::prepare(const FramePlan& plan, size_t index, PassDesc& pass, RetireQueue& retired) {
  if (!watched_ || watched_->kind != TargetKind::depth || watched_->pass != static_cast<int>(index)) {
    return;
  }
  const bool divided = plan.tiles.has_value();
  if (!divided) {
    retired.take(nextDepth_);
  }
  Image& image = divided ? nextDepth_ : depth_;
  // The depth image is as large as the color image, because a framebuffer has one size.
  const VkExtent2D wanted = pass.targets.color->extent();
  const VkExtent2D has = image.extent();
  const VkSampleCountFlagBits samples = pass.targets.samples();
  if (!image || image.samples() != samples || has.width < wanted.width || has.height < wanted.height) {
    retired.take(image);
    image = Image(device_, {.extent = wanted,
                            .format = depthFormat,
                            .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
                            .samples = samples,
                            .name = "watched depth"});
  }
  if (!sampler_) {
    sampler_ = createSampler(device_, nearestSampler, "watched depth");
  }
  pass.targets.depth = &image;
  pass.storeDepth = true;
}

void WatchedTarget::finish(const FramePlan& plan, VkCommandBuffer commands, RetireQueue& retired) {
  if (watched_ && watched_->kind == TargetKind::depth && !plan.mainReused()) {
    if (nextDepth_) {
      retired.take(depth_);
      depth_ = std::exchange(nextDepth_, Image());
    }
    if (depth_) {
      device_.barriers().record(commands, BarrierKind::depthToSample, depth_);
    }
  }
  shown_ = watched_;
}

const WatchedTarget::Target* WatchedTarget::shown(const FramePlan& plan, const DebugView& debug) const {
  const Target wanted = targetOf(plan, debug);
  return keeps(wanted.path, wanted.kind) ? &*shown_ : nullptr;
}

bool WatchedTarget::keeps(const MirrorPath& path, TargetKind kind) const {
  return shown_ && shown_->path == path && shown_->kind == kind;
}

void WatchedTarget::releaseDepth(RetireQueue& retired) {
  retired.take(depth_);
  retired.take(nextDepth_);
  retired.take(sampler_);
}

}  // namespace speculum
