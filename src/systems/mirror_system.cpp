#include "systems/mirror_system.hpp"

namespace speculum {

MirrorSystem::MirrorSystem(Device& device, Uploader& uploader, PipelineFactory& factory,
                           VkDescriptorSetLayout frameLayout)
    : device_(device), factory_(factory), frameLayout_(frameLayout) {
  const DescriptorBinding binding{.type = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                                  .stages = VK_SHADER_STAGE_FRAGMENT_BIT};
  imageLayout_ = createDescriptorSetLayout(device, {&binding, 1}, "mirror image");
  sampler_ = createSampler(device, {}, "no mirror image");
  const uint64_t black = 0;
  noImage_ = uploader.image(std::as_bytes(std::span(&black, 1)), {1, 1}, colorFormat, false, "no mirror image");
}

const Pipeline& MirrorSystem::pipeline(const Variant& variant) {
  std::unique_ptr<Pipeline>& pipeline = pipelines_[variant];
  if (!pipeline) {
    GraphicsPipelineDesc desc{.name = "mirror", .vert = "mirror.vert", .frag = "mirror.frag"};
    desc.setLayouts = {frameLayout_, imageLayout_.get()};
    desc.pushConstantBytes = sizeof(DrawConstants);
    desc.samples = variant.samples;
    desc.depthClamp = variant.clampDepth;
    pipeline = std::make_unique<Pipeline>(factory_, std::move(desc));
  }
  return *pipeline;
}

uint32_t MirrorSystem::record(const PassScope& scope, const FrameInfo& info, size_t pass, const PassFormat& format) {
  const PassData& data = info.data.passes()[pass];
  if (data.mirrors.empty()) {
    return 0;
  }
  const bool oblique = format.mirrorView && info.settings.reflection.clip == ClipMethod::oblique;
  const Pipeline& drawn = pipeline({.samples = format.samples, .clampDepth = !oblique});
  drawn.bind(scope.commands());
  drawn.bindSet(scope.commands(), 0, info.data.set());
  for (const MirrorRange& mirror : data.mirrors) {
    const VkDescriptorSet set = info.frame.descriptors->allocate(imageLayout_.get());
    const VkDescriptorImageInfo image =
        mirror.pass >= 0 ? info.images[mirror.pass].descriptor : noImage_.descriptor(sampler_.get());
    DescriptorWriter().image(0, image).update(device_, set);
    drawn.bindSet(scope.commands(), 1, set);
    drawn.push(scope.commands(), DrawConstants{data.view, mirror.mirror});
    vkCmdDraw(scope.commands(), mirror.vertexCount, 1, mirror.firstVertex, 0);
  }
  return static_cast<uint32_t>(data.mirrors.size());
}

}  // namespace speculum
