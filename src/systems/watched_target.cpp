#include "systems/watched_target.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "plan/pass_mask.hpp"

namespace speculum {

namespace {

WatchedTarget::Target targetOf(const FramePlan& plan, const TargetDisplay& debug) {
  const View& view = plan.passes[static_cast<size_t>(debug.pass)].view;
  return {debug.pass, view.path, debug.kind, {view.rect.width, view.rect.height}, plan.projection.near};
}

}  // namespace

void WatchedTarget::begin(const FramePlan& plan, const std::optional<TargetDisplay>& debug, RetireQueue& retired) {
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

const WatchedTarget::Target* WatchedTarget::shown(const FramePlan& plan, const TargetDisplay& debug) const {
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

void TexelProbe::probe(Frame& frame, Image& image, const VkDescriptorImageInfo& descriptor, const glm::ivec2& texel) {
  collect();
  if (!layout_) {
    layout_ =
        descriptorSetLayout(device_, {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
                            VK_SHADER_STAGE_COMPUTE_BIT, "probe texel");
  }
  Slot& slot = slots_[frame.index];
  if (!slot.result) {
    slot.result = Buffer(device_, sizeof(gpu::ProbedTexel), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, BufferMemory::host,
                         "probe texel " + std::to_string(frame.index));
  }
  slot.pending = {.texel = texel, .depth = image.aspect() == VK_IMAGE_ASPECT_DEPTH_BIT};
  slot.frame = frame.number;
  const VkDescriptorSet set = frame.descriptors->allocate(layout_);
  DescriptorWriter()
      .image(0, descriptor)
      .buffer(1, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, slot.result.descriptor())
      .update(device_, set);
  const bool multisampled = image.samples() != VK_SAMPLE_COUNT_1_BIT;
  const Pipeline& pipeline = pipelines_.get(multisampled, [&] {
    return ComputePipelineDesc{.name = "probe texel",
                               .comp = multisampled ? "probe_texel_samples.comp" : "probe_texel.comp",
                               .setLayouts = {layout_},
                               .pushConstantBytes = sizeof(gpu::ProbeConstants)};
  });
  device_.beginLabel(frame.commands, "probe texel");
  device_.barriers().record(frame.commands, BarrierKind::targetToCheck, image);
  pipeline.bind(frame.commands, set, gpu::ProbeConstants{texel});
  vkCmdDispatch(frame.commands, 1, 1, 1);
  device_.barriers().record(frame.commands, BarrierKind::checkToWrite, image);
  Barriers::computeToHost(frame.commands);
  device_.endLabel(frame.commands);
}

void TexelProbe::release() {
  collect();
  value_.reset();
  if (std::ranges::any_of(slots_, [](const Slot& slot) { return slot.frame != 0; })) {
    return;
  }
  pipelines_.clear();
  slots_ = {};
}

const std::optional<TexelValue>& TexelProbe::value() {
  collect();
  return value_;
}

void TexelProbe::collect() {
  for (Slot& slot : slots_) {
    if (slot.frame == 0 || slot.frame > renderer_.timings().frame) {
      continue;
    }
    const uint64_t frame = std::exchange(slot.frame, 0);
    if (value_ && frame < valueFrame_) {
      continue;
    }
    gpu::ProbedTexel probed{};
    std::memcpy(&probed, slot.result.mapped(), sizeof probed);
    valueFrame_ = frame;
    value_ = slot.pending;
    probed.mean.a /= gpu::disparityLength;
    value_->value = value_->depth ? glm::vec4(0.0f) : probed.mean;
    value_->storedDepth = value_->depth ? probed.first.r : 0.0f;
  }
}

}  // namespace speculum
