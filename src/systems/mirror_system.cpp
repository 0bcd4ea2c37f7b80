#include "systems/mirror_system.hpp"

#include "systems/shadow_system.hpp"

namespace speculum {

namespace {

const MirrorImage* imageOf(const MirrorRange& mirror, const FrameInfo& info) {
  return mirror.pass >= 0 ? &info.images[mirror.pass] : mirror.cached >= 0 ? &info.cached[mirror.cached] : nullptr;
}

}  // namespace

MirrorSystem::MirrorSystem(Device& device, Uploader& uploader, PipelineFactory& factory,
                           VkDescriptorSetLayout frameLayout)
    : device_(device), frameLayout_(frameLayout), pipelines_(factory) {
  const DescriptorBinding binding{.type = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                                  .stages = VK_SHADER_STAGE_FRAGMENT_BIT};
  imageLayout_ = createDescriptorSetLayout(device, {&binding, 1}, "mirror image");
  sampler_ = createSampler(device, {}, "no mirror image");
  const uint64_t black = 0;
  noImage_ = uploader.image(std::as_bytes(std::span(&black, 1)), {1, 1}, colorFormat, false, "no mirror image");
}

bool MirrorSystem::tracesRays(Shading shading, const TraceVariant& trace) {
  switch (shading) {
    case Shading::byRays:
      return true;
    case Shading::ownSample:
    case Shading::ownSampleAdded:
      return false;
    case Shading::single:
    case Shading::average:
    case Shading::base:
      break;
  }
  return trace.traced;
}

GraphicsPipelineDesc MirrorSystem::describe(const Variant& variant, const FrameInfo& info) const {
  const Shading shading = variant.shading;
  GraphicsPipelineDesc desc{.name = "mirror",
                            .vert = "mirror.vert",
                            .frag = "mirror.frag",
                            .fragConstants = {shading == Shading::base, variant.reprojected},
                            .setLayouts = {frameLayout_, imageLayout_.get()},
                            .samples = variant.samples,
                            .depthClamp = variant.clampDepth};
  if (shading == Shading::average) {
    desc.frag = "mirror_average.frag";
  } else if (shading == Shading::ownSample || shading == Shading::ownSampleAdded) {
    desc.frag = "mirror_sample.frag";
    desc.sampleShading = true;
  }
  if (shading == Shading::ownSampleAdded) {
    desc.depthCompare = VK_COMPARE_OP_EQUAL;
    desc.depthWrite = false;
    desc.adds = true;
  }
  if (tracesRays(shading, variant.trace)) {
    const bool byRays = shading == Shading::byRays;
    desc.frag = tracingShader(byRays                        ? "mirror_rays"
                              : shading == Shading::average ? "mirror_average_traced"
                                                            : "mirror_traced",
                              variant.trace);
    desc.sampleShading = variant.samples != VK_SAMPLE_COUNT_1_BIT && (byRays || variant.trace.perSample);
    if (byRays) {
      desc.fragConstants[1] = desc.sampleShading && device_.caps().sampleRateShading ? variant.samples : 1;
    }
    desc.setLayouts.push_back(info.trace.layout());
    addConstants(variant.trace, desc.fragConstants);
  }
  if (variant.shadowed) {
    desc.frag = shading == Shading::average ? "mirror_average_shadowed.frag" : "mirror_shadowed.frag";
    desc.setLayouts.push_back(info.shadows.layout());
  }
  desc.fragConstants.resize(5, 0);
  desc.fragConstants.insert(
      desc.fragConstants.end(),
      {variant.lightCount, variant.blurs, static_cast<uint32_t>(variant.shows), static_cast<uint32_t>(variant.lookup),
       variant.painted, variant.shadowedLights, variant.ripples});
  return desc;
}

void MirrorSystem::countPipelines(EffectLedger& ledger) const {
  pipelines_.forEach([&](const Variant& variant) {
    ledger.pipeline(EffectKind::shadows, variant.trace.shadows || variant.shadowed);
    ledger.pipeline(EffectKind::castsLight, variant.trace.castsLight);
    ledger.pipeline(EffectKind::ripple, variant.ripples);
    ledger.pipeline(EffectKind::roughness, variant.blurs);
  });
}

void MirrorSystem::endFrame(const TraceVariant& trace, bool shadowMaps, bool imagesShown) {
  pipelines_.endFrame([&](const Variant& variant) {
    const bool stays = imagesShown && variant.trace == trace;
    return (!stays && tracesRays(variant.shading, variant.trace)) || (!shadowMaps && variant.shadowed);
  });
}

std::vector<MirrorSystem::Shading> MirrorSystem::shadings(const MirrorRange& mirror, const MirrorImage* image,
                                                          const PassFormat& format) const {
  if (mirror.byRays) {
    return {Shading::byRays};
  }
  if (!image || image->samples == VK_SAMPLE_COUNT_1_BIT) {
    return {Shading::single};
  }
  if (mirror.blurs || mirror.ripples || image->samples != format.samples || mirror.lookup != Lookup::fetch ||
      !device_.caps().sampleRateShading) {
    return {Shading::average};
  }
  if (mirror.base) {
    return {Shading::base, Shading::ownSampleAdded};
  }
  return {Shading::ownSample};
}

// Sets only what this shading's shader reads, so that mirrors that differ in other ways share a pipeline.
MirrorSystem::Variant MirrorSystem::variantOf(const MirrorRange& mirror, Shading shading) {
  Variant variant{.shading = shading};
  switch (shading) {
    case Shading::single:
    case Shading::average:
      variant.shows = mirror.shows;
      variant.painted = mirror.painted;
      if (mirror.shows == MirrorShows::image) {
        variant.blurs = mirror.blurs;
        variant.ripples = mirror.ripples;
        variant.lookup = mirror.lookup;
        variant.reprojected = mirror.reprojected;
      }
      break;
    case Shading::base:
      variant.painted = true;
      break;
    case Shading::ownSample:
    case Shading::ownSampleAdded:
      variant.reprojected = mirror.reprojected;
      break;
    case Shading::byRays:
      variant.blurs = mirror.rough;
      variant.ripples = mirror.rippled;
      break;
  }
  return variant;
}

uint32_t MirrorSystem::record(const PassScope& scope, const FrameInfo& info, size_t pass, const PassFormat& format) {
  const PassData& data = info.data.passes()[pass];
  const bool oblique = format.mirrorView && info.settings.reflection.clip == ClipMethod::oblique;
  const VkDescriptorImageInfo noImage = noImage_.descriptor(sampler_.get());
  uint32_t draws = 0;
  for (const MirrorRange& mirror : data.mirrors) {
    const MirrorImage* image = imageOf(mirror, info);
    for (const Shading shading : shadings(mirror, image, format)) {
      Variant variant = variantOf(mirror, shading);
      variant.samples = format.samples;
      variant.clampDepth = !oblique;
      const bool traces = tracesRays(shading, info.trace.variant());
      variant.trace = traces ? info.trace.variant() : TraceVariant{};
      variant.shadowed = variant.painted && !traces && info.shadows.set() != VK_NULL_HANDLE;
      variant.shadowedLights = variant.shadowed ? data.shadowedLights : 0;
      variant.lightCount = variant.painted && !traces ? fixedLightCount(info.scene) : gpu::manyLights;
      const Pipeline& drawn = pipelines_.get(variant, [&] { return describe(variant, info); });
      const bool reads = image && shading != Shading::base;
      const VkDescriptorSet set = info.frame.descriptors->allocate(imageLayout_.get());
      DescriptorWriter().image(0, reads ? image->descriptor : noImage).update(device_, set);
      drawn.bind(scope.commands());
      info.data.bind(drawn, scope.commands(), data, mirror.mirror);
      drawn.bindSet(scope.commands(), 1, set);
      if (traces) {
        drawn.bindSet(scope.commands(), 2, info.trace.set());
      } else if (variant.shadowed) {
        drawn.bindSet(scope.commands(), 2, info.shadows.set());
      }
      scope.beginLabel(mirror.byRays ? "traced mirror" : "mirror");
      vkCmdDraw(scope.commands(), mirror.vertexCount, 1, mirror.firstVertex, 0);
      scope.endLabel();
      ++draws;
      info.ledger.draw(EffectKind::ripple, mirror.rippled);
      info.ledger.draw(EffectKind::roughness, mirror.rough);
      info.ledger.draw(EffectKind::fresnel, mirror.fresnel);
      info.ledger.draw(EffectKind::shadows, variant.trace.shadows || variant.shadowed);
      info.ledger.draw(EffectKind::castsLight, variant.trace.castsLight);
    }
  }
  return draws;
}

}  // namespace speculum
