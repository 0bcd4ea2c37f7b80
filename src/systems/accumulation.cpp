#include "systems/accumulation.hpp"

#include <stdexcept>

#include "plan/target_memory.hpp"
#include "shaders/gpu_data.h"

namespace speculum {

namespace {

constexpr VkFormat sumFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
static_assert(2 * bytesOfTexel(sumFormat) == sumBytes);

}  // namespace

void Accumulation::begin(VkExtent2D extent, RetireQueue& retired) {
  Device& device = renderer_.device();
  if (!layout_) {
    constexpr VkDescriptorType image = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    layout_ = createDescriptorSetLayout(device, {image, image}, VK_SHADER_STAGE_FRAGMENT_BIT, "accumulate");
    sampler_ = createSampler(device, nearestSampler, "sum");
  }
  for (Image& image : images_) {
    if (!sameExtent(image.extent(), extent)) {
      retired.take(image);
    }
    if (!image) {
      image = Image(device, {.extent = extent,
                             .format = sumFormat,
                             .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
                                      VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                             .name = "sum of pictures"});
    }
  }
}

RecordedPass Accumulation::add(Frame& frame, const VkDescriptorImageInfo& radiance, VkExtent2D extent, int picture) {
  if (picture == 0) {
    begin(extent, *frame.retired);
  } else if (picture != pictures_ || !sameExtent(sum().extent(), extent)) {
    throw std::logic_error("picture " + std::to_string(picture) + " of a mean does not follow " +
                           std::to_string(pictures_) + " others of its size");
  }
  const VkDescriptorSet set = frame.descriptors->allocate(layout_.get());
  DescriptorWriter()
      .image(0, radiance)
      .image(1, picture == 0 ? radiance : descriptor())
      .update(renderer_.device(), set);
  current_ = 1 - current_;
  pictures_ = picture + 1;
  const Pipeline& pipeline = pipelines_.get(true, [&] {
    return GraphicsPipelineDesc{.name = "accumulate",
                                .vert = "full_screen.vert",
                                .frag = "accumulate.frag",
                                .setLayouts = {layout_.get()},
                                .pushConstantBytes = sizeof(gpu::AccumulateConstants),
                                .color = sumFormat,
                                .depth = VK_FORMAT_UNDEFINED};
  });
  const PassDesc desc = fullPass("accumulate", {.color = &sum()});
  const PassScope scope = renderer_.beginPass(frame, desc);
  pipeline.bind(scope.commands(), set, gpu::AccumulateConstants{picture == 0});
  vkCmdDraw(scope.commands(), 3, 1, 0, 0);
  return {{.kind = PassKind::accumulation}, desc.name, -1, 1};
}

void Accumulation::release(RetireQueue& retired) {
  pictures_ = 0;
  pipelines_.clear();
  for (Image& image : images_) {
    retired.take(image);
  }
  retired.take(sampler_);
  retired.take(layout_);
}

}  // namespace speculum
