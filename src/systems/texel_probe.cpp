#include "systems/texel_probe.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

namespace speculum {

void TexelProbe::probe(Frame& frame, Image& image, const VkDescriptorImageInfo& descriptor, const glm::ivec2& texel) {
  collect();
  if (!layout_) {
    layout_ = createDescriptorSetLayout(device_,
                                        {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
                                        VK_SHADER_STAGE_COMPUTE_BIT, "probe texel");
  }
  Slot& slot = slots_[frame.index];
  if (!slot.result) {
    slot.result = Buffer(device_, sizeof(gpu::ProbedTexel), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, BufferMemory::host,
                         "probe texel " + std::to_string(frame.index));
  }
  slot.pending = {.texel = texel, .depth = image.format() == depthFormat};
  slot.frame = frame.number;
  const VkDescriptorSet set = frame.descriptors->allocate(layout_.get());
  DescriptorWriter()
      .image(0, descriptor)
      .buffer(1, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, slot.result.descriptor())
      .update(device_, set);
  const bool multisampled = image.samples() != VK_SAMPLE_COUNT_1_BIT;
  const Pipeline& pipeline = pipelines_.get(multisampled, [&] {
    return ComputePipelineDesc{.name = "probe texel",
                               .comp = multisampled ? "probe_texel_samples.comp" : "probe_texel.comp",
                               .setLayouts = {layout_.get()},
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
  layout_.reset();
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
