#include "systems/mirror_system.hpp"

#include <algorithm>
#include <utility>

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
  imageLayout_ = descriptorSetLayout(
      device, {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER},
      VK_SHADER_STAGE_FRAGMENT_BIT, "mirror image");
  sampler_ = createSampler(device, {}, "no mirror image");
  const uint64_t black = 0;
  noImage_ = uploader.image(std::as_bytes(std::span(&black, 1)), {1, 1}, colorFormat, false, "no mirror image");
}

bool MirrorSystem::defers(const FrameInfo& info, const MirrorRange& mirror) {
  return mirror.byRays || (mirror.colored && info.trace.variant().traced);
}

bool MirrorSystem::defers(const FrameInfo& info, const DrawList& pass) {
  return std::ranges::any_of(pass.mirrors, [&](const MirrorRange& mirror) { return defers(info, mirror); });
}

GraphicsPipelineDesc MirrorSystem::describe(const Variant& variant, const FrameInfo& info) const {
  const Shading shading = variant.shading;
  GraphicsPipelineDesc desc{.name = "mirror",
                            .vert = "mirror.vert",
                            .frag = "mirror.frag",
                            .constants = {{gpu::constantReprojects, variant.reprojected},
                                          {gpu::constantAdded, variant.added},
                                          {gpu::constantBlurs, variant.blurs},
                                          {gpu::constantRipples, variant.ripples},
                                          {gpu::constantShows, variant.shows},
                                          {gpu::constantLookup, variant.lookup},
                                          {gpu::constantColored, variant.colored},
                                          {gpu::constantMapped, variant.mapped},
                                          {gpu::constantOnlyShadowFace, variant.onlyShadowFace},
                                          {gpu::constantLightCount, variant.lightCount},
                                          {gpu::constantBranches, info.data.branches()},
                                          {gpu::constantShadowedLights, variant.shadowedLights}},
                            .setLayouts = {frameLayout_, imageLayout_},
                            .depthClamp = variant.clampDepth};
  if (shading == Shading::average) {
    desc.frag = "mirror_average.frag";
  } else if (shading == Shading::ownSample) {
    desc.frag = "mirror_sample.frag";
  } else if (shading == Shading::identifier) {
    desc.frag = "mirror_identifier.frag";
  }
  const bool baseOnly = shading == Shading::identifier ? !variant.byRays : shading == Shading::base;
  desc.constants.push_back({gpu::constantBaseOnly, baseOnly});
  desc.sampleShading = shading == Shading::ownSample || variant.perSample;
  if (variant.added) {
    desc.depthCompare = VK_COMPARE_OP_EQUAL;
    desc.depthWrite = false;
    desc.adds = true;
  }
  if (variant.shadowed) {
    desc.frag = shading == Shading::average ? "mirror_average_shadowed.frag" : "mirror_shadowed.frag";
    desc.setLayouts.push_back(info.shadows.layout());
  }
  return variant.format.describe(desc);
}

void MirrorSystem::countPipelines(EffectLedger& ledger) const {
  pipelines_.forEach([&](const Variant& variant) {
    ledger.pipeline(EffectKind::shadows, variant.trace.shadows || variant.shadowed);
    ledger.pipeline(EffectKind::castsLight, variant.trace.castsLight);
    ledger.pipeline(EffectKind::ripple, variant.ripples);
    ledger.pipeline(EffectKind::roughness, variant.blurs);
    ledger.pipeline(EffectKind::textures, variant.mapped);
    ledger.pipeline(EffectKind::toneMap, variant.format.encoding == gpu::encodingAces);
  });
}

void MirrorSystem::endFrame(const TraceVariant& trace, bool shadowMaps, bool imagesShown, bool textured) {
  pipelines_.endFrame([&](const Variant& variant) {
    const bool stays = imagesShown && variant.trace == trace;
    return (!stays && variant.shading == Shading::identifier) || (!shadowMaps && variant.shadowed) ||
           (!textured && variant.mapped);
  });
}

MirrorSystem::Shading MirrorSystem::shadingOf(const PassScope& scope, const MirrorRange& mirror,
                                              const MirrorImage* image) const {
  if (!image || image->samples == VK_SAMPLE_COUNT_1_BIT) {
    return Shading::single;
  }
  const bool averages = mirror.blurs || mirror.ripples || image->samples != scope.samples() ||
                        mirror.lookup != gpu::lookupFetch || !device_.caps().sampleRateShading;
  return averages ? Shading::average : Shading::ownSample;
}

// Sets only what this shading's shader reads, so that mirrors that differ in other ways share a pipeline.
MirrorSystem::Variant MirrorSystem::variantOf(const MirrorRange& mirror, Shading shading, bool added) {
  Variant variant{.shading = shading, .added = added};
  variant.mapped = mirror.map >= 0 && shading != Shading::identifier;
  switch (shading) {
    case Shading::single:
    case Shading::average:
      variant.shows = mirror.shows;
      variant.colored = mirror.colored && !added;
      if (mirror.shows == gpu::showsImage) {
        variant.blurs = mirror.blurs;
        variant.ripples = mirror.ripples;
        variant.reprojected = mirror.reprojected;
        variant.lookup = mirror.lookup;
      }
      break;
    case Shading::base:
      variant.colored = true;
      break;
    case Shading::ownSample:
      variant.reprojected = mirror.reprojected;
      break;
    case Shading::identifier:
      variant.byRays = mirror.byRays;
      variant.blurs = mirror.byRays && mirror.rough;
      variant.ripples = mirror.byRays && mirror.rippled;
      break;
  }
  return variant;
}

uint32_t MirrorSystem::record(const PassScope& scope, const FrameInfo& info, const DrawList& pass) {
  uint32_t draws = 0;
  for (const MirrorRange& mirror : pass.mirrors) {
    const Shading shading = shadingOf(scope, mirror, imageOf(mirror, info));
    if (defers(info, mirror)) {
      draw(scope, info, pass, mirror, variantOf(mirror, Shading::identifier, false));
    } else if (shading == Shading::ownSample && mirror.base) {
      draw(scope, info, pass, mirror, variantOf(mirror, Shading::base, false));
      draw(scope, info, pass, mirror, variantOf(mirror, shading, true));
      ++draws;
    } else {
      draw(scope, info, pass, mirror, variantOf(mirror, shading, false));
    }
    ++draws;
  }
  return draws;
}

uint32_t MirrorSystem::recordReflections(const PassScope& scope, const FrameInfo& info, const DrawList& pass) {
  uint32_t draws = 0;
  for (const MirrorRange& mirror : pass.mirrors) {
    if (defers(info, mirror) && !mirror.byRays && mirror.shows != gpu::showsBack) {
      draw(scope, info, pass, mirror, variantOf(mirror, shadingOf(scope, mirror, imageOf(mirror, info)), true));
      ++draws;
    }
  }
  return draws;
}

void MirrorSystem::draw(const PassScope& scope, const FrameInfo& info, const DrawList& pass, const MirrorRange& mirror,
                        Variant variant) {
  const bool identifies = variant.shading == Shading::identifier;
  const MirrorImage* image = imageOf(mirror, info);
  const bool reads = image && !identifies && variant.shading != Shading::base;
  if (reads && image->samples != scope.samples() && variant.lookup == gpu::lookupFetch) {
    variant.lookup = gpu::lookupInside;
  }
  variant.format = formatOf(scope.desc(), info.settings);
  variant.perSample = !identifies && info.trace.variant().perSample && (variant.blurs || variant.ripples);
  variant.clampDepth = !(pass.mirrorView && info.settings.reflection.clip == ClipMethod::oblique);
  variant.trace = identifies ? info.trace.variant() : TraceVariant{};
  variant.shadowed = variant.colored && info.shadows.set() != VK_NULL_HANDLE;
  variant.shadowedLights =
      variant.shadowed ? static_cast<uint32_t>(cubesOf(info.plan.cubes, PassKind::shadow).size()) : 0;
  variant.onlyShadowFace = variant.shadowed ? info.shadows.onlyFace() : gpu::anyShadowFace;
  variant.lightCount = variant.colored ? fixedLightCount(info.scene) : gpu::manyLights;
  const Pipeline& pipeline = pipelines_.get(variant, [&] { return describe(variant, info); });
  const VkDescriptorImageInfo shown = reads ? image->descriptor : noImage_.descriptor(sampler_.get());
  if (std::exchange(setsFrame_, info.frame.number) != info.frame.number) {
    sets_.clear();
  }
  VkDescriptorSet& set = sets_[{shown.imageView, mirror.map}];
  if (!set) {
    set = info.frame.descriptors->allocate(imageLayout_);
    DescriptorWriter().image(0, shown).image(1, info.resources.image(mirror.map)).update(device_, set);
  }
  info.data.bind(pipeline, scope.commands(), pass, {set, variant.shadowed ? info.shadows.set() : VK_NULL_HANDLE},
                 mirror.mirror);
  scope.beginLabel(variant.byRays ? "traced mirror" : "mirror");
  vkCmdDraw(scope.commands(), mirror.vertexCount, 1, mirror.firstVertex, 0);
  scope.endLabel();
  info.ledger.draw(EffectKind::ripple, mirror.rippled);
  info.ledger.draw(EffectKind::roughness, mirror.rough);
  info.ledger.draw(EffectKind::fresnel, mirror.fresnel);
  info.ledger.draw(EffectKind::textures, mirror.map >= 0);
  info.ledger.draw(EffectKind::shadows, variant.trace.shadows || variant.shadowed);
  info.ledger.draw(EffectKind::castsLight, variant.trace.castsLight);
}

uint32_t MaskSystem::record(const PassScope& scope, const FrameInfo& info, const DrawList& pass) {
  if (pass.maskVertexCount == 0) {
    return 0;
  }
  const Pipeline& pipeline = pipelines_.get(scope.samples(), [&] {
    return GraphicsPipelineDesc{.name = "mask",
                                .vert = "mirror.vert",
                                .setLayouts = {frameLayout_},
                                .samples = scope.samples(),
                                .depthCompare = VK_COMPARE_OP_ALWAYS};
  });
  info.data.bind(pipeline, scope.commands(), pass);
  vkCmdDraw(scope.commands(), pass.maskVertexCount, 1, pass.maskFirstVertex, 0);
  return 1;
}

uint32_t MaskSystem::markOutside(const PassScope& scope, const FrameInfo& info, const DrawList& pass) {
  if (pass.outsideVertexCount == 0) {
    return 0;
  }
  const PassFormat format = formatOf(scope.desc(), info.settings);
  // Depth is written, so that a texel in two parts is marked once: two marks would leave the range of half floats.
  const Pipeline& pipeline = marking_.get(format, [&] {
    return format.describe(
        {.name = "outside", .vert = "mirror.vert", .frag = "outside.frag", .setLayouts = {frameLayout_}, .adds = true});
  });
  info.data.bind(pipeline, scope.commands(), pass);
  vkCmdDraw(scope.commands(), pass.outsideVertexCount, 1, pass.outsideFirstVertex, 0);
  return 1;
}

}  // namespace speculum
