#include "systems/mirror_system.hpp"

namespace speculum {

namespace {

const MirrorImage* imageOf(const MirrorRange& mirror, const FrameInfo& info) {
  return mirror.pass >= 0 ? &info.images[mirror.pass] : mirror.held >= 0 ? &info.held[mirror.held] : nullptr;
}

}  // namespace

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
    desc.fragConstants = {variant.shading == Shading::base, variant.reprojected};
    if (variant.shading == Shading::average) {
      desc.frag = "mirror_average.frag";
    } else if (variant.shading == Shading::ownSample || variant.shading == Shading::ownSampleAdded) {
      desc.frag = "mirror_sample.frag";
      desc.sampleShading = true;
    }
    if (variant.shading == Shading::ownSampleAdded) {
      desc.depthCompare = VK_COMPARE_OP_EQUAL;
      desc.depthWrite = false;
      desc.blend = Blend::add;
    }
    pipeline = std::make_unique<Pipeline>(factory_, std::move(desc));
  }
  return *pipeline;
}

std::vector<MirrorSystem::Shading> MirrorSystem::shadings(const MirrorRange& mirror, const MirrorImage* image,
                                                          const PassFormat& format) const {
  if (!image || image->samples == VK_SAMPLE_COUNT_1_BIT) {
    return {Shading::single};
  }
  if (image->samples != format.samples || mirror.lookup != Lookup::fetch || !device_.caps().sampleRateShading) {
    return {Shading::average};
  }
  if (mirror.base) {
    return {Shading::base, Shading::ownSampleAdded};
  }
  return {Shading::ownSample};
}

uint32_t MirrorSystem::record(const PassScope& scope, const FrameInfo& info, size_t pass, const PassFormat& format) {
  const PassData& data = info.data.passes()[pass];
  const bool oblique = format.mirrorView && info.settings.reflection.clip == ClipMethod::oblique;
  const VkDescriptorImageInfo noImage = noImage_.descriptor(sampler_.get());
  uint32_t draws = 0;
  for (const MirrorRange& mirror : data.mirrors) {
    const MirrorImage* image = imageOf(mirror, info);
    for (const Shading shading : shadings(mirror, image, format)) {
      const Pipeline& drawn = pipeline(
          {.shading = shading, .samples = format.samples, .clampDepth = !oblique, .reprojected = mirror.reprojected});
      const bool reads = image && shading != Shading::base;
      const VkDescriptorSet set = info.frame.descriptors->allocate(imageLayout_.get());
      DescriptorWriter().image(0, reads ? image->descriptor : noImage).update(device_, set);
      drawn.bind(scope.commands());
      drawn.bindSet(scope.commands(), 0, info.data.set());
      drawn.bindSet(scope.commands(), 1, set);
      drawn.push(scope.commands(), DrawConstants{data.view, mirror.mirror});
      vkCmdDraw(scope.commands(), mirror.vertexCount, 1, mirror.firstVertex, 0);
      ++draws;
    }
  }
  return draws;
}

}  // namespace speculum
