#include "systems/watched_depth.hpp"

#include <utility>

#include "shaders/gpu_data.h"

namespace speculum {

WatchedDepth::WatchedDepth(Renderer& renderer, VkDescriptorSetLayout displayLayout)
    : renderer_(renderer), displayLayout_(displayLayout), pipelines_(renderer.pipelines()) {}

void WatchedDepth::drop(Image& image, RetireQueue& retired) {
  if (image) {
    retired.retire(std::exchange(image, Image()));
  }
}

void WatchedDepth::prepare(PassDesc& pass, bool divided, RetireQueue& retired) {
  if (!divided) {
    drop(next_, retired);
  }
  Image& image = divided ? next_ : image_;
  Device& device = renderer_.device();
  // The depth image is as large as the color image, because a framebuffer has one size.
  const VkExtent2D wanted = pass.targets.color->extent();
  const VkExtent2D has = image.extent();
  const VkSampleCountFlagBits samples = pass.targets.samples();
  if (!image || image.samples() != samples || has.width < wanted.width || has.height < wanted.height) {
    drop(image, retired);
    image = Image(device, {.extent = wanted,
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
  pass.targets.depth = &image;
  pass.storeDepth = true;
}

void WatchedDepth::finish(VkCommandBuffer commands, RetireQueue& retired) {
  if (next_) {
    drop(image_, retired);
    image_ = std::exchange(next_, Image());
  }
  if (image_) {
    renderer_.device().barriers().record(commands, BarrierKind::depthToSample, image_);
  }
}

void WatchedDepth::release(RetireQueue& retired) {
  if (sampler_) {
    drop(image_, retired);
    drop(next_, retired);
    retired.retire(std::exchange(sampler_, SamplerHandle()));
    pipelines_.clear();
  }
}

const Pipeline& WatchedDepth::pipeline() {
  const bool several = image_.samples() != VK_SAMPLE_COUNT_1_BIT;
  return pipelines_.get(several, [&] {
    return GraphicsPipelineDesc{.name = "display depth",
                                .vert = "full_screen.vert",
                                .frag = several ? "display_depth_samples.frag" : "display_depth.frag",
                                .setLayouts = {displayLayout_},
                                .pushConstantBytes = sizeof(gpu::DepthViewConstants),
                                .color = renderer_.displayFormat(),
                                .depth = VK_FORMAT_UNDEFINED};
  });
}

}  // namespace speculum
