#include "systems/kept_depth.hpp"

#include <algorithm>
#include <utility>

#include "shaders/gpu_data.h"

namespace speculum {

KeptDepth::KeptDepth(Renderer& renderer, VkDescriptorSetLayout displayLayout)
    : renderer_(renderer), displayLayout_(displayLayout) {}

void KeptDepth::prepare(PassDesc& pass, RetireQueue& retired) {
  Device& device = renderer_.device();
  // As large as the colour: a framebuffer has one size.
  const VkExtent2D wanted = pass.targets.color->extent();
  const VkExtent2D has = image_.extent();
  const VkSampleCountFlagBits samples = pass.targets.samples();
  if (!image_ || image_.samples() != samples || has.width < wanted.width || has.height < wanted.height) {
    const bool other = image_ && image_.samples() != samples;
    if (image_) {
      retired.retire(std::exchange(image_, Image()));
    }
    if (other) {
      pipeline_.reset();
    }
    image_ = Image(device, {.extent = wanted,
                            .format = depthFormat,
                            .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
                            .samples = samples,
                            .name = "watched depth"});
  }
  if (!sampler_) {
    const SamplerDesc nearest{
        .filter = VK_FILTER_NEAREST, .mipmapMode = VK_SAMPLER_MIPMAP_MODE_NEAREST, .maxLod = 0.0f};
    sampler_ = createSampler(device, nearest, "watched depth");
  }
  pass.targets.depth = &image_;
  pass.storeDepth = true;
}

void KeptDepth::finish(VkCommandBuffer commands) {
  renderer_.device().barriers().depthToSample(commands, image_);
}

void KeptDepth::release(RetireQueue& retired) {
  if (image_) {
    retired.retire(std::exchange(image_, Image()));
    retired.retire(std::exchange(sampler_, SamplerHandle()));
    pipeline_.reset();
  }
}

const Pipeline& KeptDepth::pipeline() {
  if (!pipeline_) {
    const bool several = image_.samples() != VK_SAMPLE_COUNT_1_BIT;
    GraphicsPipelineDesc desc{.name = "display depth",
                              .vert = "full_screen.vert",
                              .frag = several ? "display_depth_samples.frag" : "display_depth.frag"};
    desc.setLayouts = {displayLayout_};
    desc.pushConstantBytes = sizeof(gpu::DepthViewConstants);
    desc.color = renderer_.displayFormat();
    desc.depth = VK_FORMAT_UNDEFINED;
    desc.depthTest = false;
    desc.depthWrite = false;
    pipeline_ = std::make_unique<Pipeline>(renderer_.pipelines(), std::move(desc));
  }
  return *pipeline_;
}

}  // namespace speculum
