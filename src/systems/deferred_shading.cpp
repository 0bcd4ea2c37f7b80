#include "systems/deferred_shading.hpp"

#include <algorithm>
#include <array>

#include "plan/target_memory.hpp"
#include "systems/gpu_conversion.hpp"
#include "systems/shadow_system.hpp"

namespace speculum {

namespace {

constexpr uint32_t groupSide = 8;  // as in collect_surfaces.glsl
// Beginning of an empty buffer of requests: the arguments of the indirect dispatch, and the number of requests.
constexpr std::array<uint32_t, 4> noRequests{0, 1, 1, 0};

}  // namespace

std::vector<PixelRect> DeferredShading::bands(std::span<const PixelRect> parts, VkSampleCountFlagBits samples) {
  // A request has 32 bits for a pixel's number and a bit for each sample.
  const uint64_t mostPixels = std::min<uint64_t>(mostShadedSamples / samples, uint64_t{1} << (32 - samples));
  std::vector<PixelRect> bands;
  for (const PixelRect& part : parts) {
    const int rows = std::clamp(static_cast<int>(mostPixels / static_cast<uint64_t>(part.width)), 1, part.height);
    for (int end = part.height; end > 0; end -= rows) {
      const int first = std::max(end - rows, 0);
      bands.push_back({part.x, part.y + first, part.width, end - first});
    }
  }
  return bands;
}

gpu::ShadeConstants DeferredShading::areaOf(const PassDesc& pass) {
  const VkRect2D& area = pass.renderArea;
  return {.corner = {area.offset.x, area.offset.y}, .size = {area.extent.width, area.extent.height}};
}

PassDesc DeferredShading::identifying(PassDesc pass) {
  pass.targets.resolve = nullptr;
  pass.storeDepth = true;
  pass.pauses = true;
  return pass;
}

PassDesc DeferredShading::shaded(PassDesc pass) {
  pass.loadColor = true;
  pass.loadDepth = true;
  return pass;
}

void DeferredShading::prepare(const FrameInfo& info, const PassDesc& pass) {
  constexpr VkDescriptorType storage = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
  if (!layout_) {
    constexpr VkShaderStageFlags compute = VK_SHADER_STAGE_COMPUTE_BIT;
    const std::array bindings = {DescriptorBinding{0, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, compute},
                                 DescriptorBinding{1, storage, 1, compute | VK_SHADER_STAGE_FRAGMENT_BIT},
                                 DescriptorBinding{2, storage, 1, compute}, DescriptorBinding{3, storage, 1, compute}};
    layout_ = descriptorSetLayout(device_, bindings, "deferred shading");
    sampler_ = createSampler(device_, {.maxLod = 0.0f}, "deferred shading");
  }
  const uint64_t samples = speculum::areaOf(pass.renderArea.extent) * pass.targets.samples();
  if (shaded_.bytes() < samples * bytesPerShadedSample) {
    info.frame.retired->take(shaded_);
    info.frame.retired->take(requests_);
    shaded_ = Buffer(device_, samples * bytesPerShadedSample, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, BufferMemory::device,
                     "shaded samples");
    requests_ = Buffer(
        device_, sizeof noRequests + samples * bytesPerRequest,
        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
        BufferMemory::device, "surfaces to shade");
  }
  set_ = info.frame.descriptors->allocate(layout_);
  DescriptorWriter()
      .image(0, pass.targets.color->descriptor(sampler_.get()))
      .buffer(1, storage, shaded_.descriptor())
      .buffer(2, storage, requests_.descriptor())
      .buffer(3, storage, info.data.mirrorBuffer(info.frame))
      .update(device_, set_);
}

void DeferredShading::collect(const PassScope& scope, const TraceVariant& trace) {
  const VkCommandBuffer commands = scope.commands();
  const VkSampleCountFlagBits samples = scope.samples();
  const Pipeline& pipeline = collecting_.get({samples, trace}, [&] {
    return ComputePipelineDesc{
        .name = "collect surfaces",
        .comp = samples == VK_SAMPLE_COUNT_1_BIT ? "collect_surfaces.comp" : "collect_surfaces_samples.comp",
        .constants = {{gpu::constantSamples, samples}, {gpu::constantPerSample, trace.perSample}},
        .setLayouts = {layout_},
        .pushConstantBytes = sizeof(gpu::ShadeConstants)};
  });
  Barriers::requestsToUse(commands);
  vkCmdUpdateBuffer(commands, requests_.get(), 0, sizeof noRequests, noRequests.data());
  Barriers::requestsToUse(commands);
  const gpu::ShadeConstants area = areaOf(scope.desc());
  pipeline.bind(commands, set_, area);
  vkCmdDispatch(commands, groupCount(area.size.x, groupSide), groupCount(area.size.y, groupSide), 1);
  Barriers::requestsToUse(commands);
}

void DeferredShading::shade(const PassScope& scope, const FrameInfo& info, const DrawList& pass) {
  idleFrames_ = 0;
  prepare(info, scope.desc());
  scope.beginLabel("deferred shading");
  const TraceVariant& trace = info.trace.variant();
  collect(scope, trace);
  const VkSampleCountFlagBits samples = scope.samples();
  const uint32_t filter = textureLookup(info.settings.view.textureFilter);
  const bool asksGroups = fixedLightCount(info.scene) == gpu::manyLights;
  const Pipeline& pipeline = shading_.get({samples, trace, filter, asksGroups}, [&] {
    std::vector<VkDescriptorSetLayout> layouts{frameLayout_, layout_, info.trace.layout()};
    if (trace.asks) {
      layouts.push_back(info.shadows.layout());
    }
    return ComputePipelineDesc{
        .name = "deferred shading",
        .comp = std::string("shade") + (trace.asks ? "_asking" : "") + (trace.hardware ? "_ray_query.comp" : ".comp"),
        .constants = {{gpu::constantSamples, samples},
                      {gpu::constantTextureFilter, filter},
                      {gpu::constantBranches, info.data.branches()},
                      {gpu::constantLightGroups, asksGroups},
                      {gpu::constantShadows, trace.shadows},
                      {gpu::constantCastsLight, trace.castsLight},
                      {gpu::constantRough, trace.rough},
                      {gpu::constantRepeating, trace.repeating},
                      {gpu::constantTransparency, trace.transparency},
                      {gpu::constantVertexColors, trace.vertexColors},
                      {gpu::constantVertexAlpha, trace.vertexAlpha}},
        .setLayouts = layouts,
        .pushConstantBytes = sizeof(gpu::ShadeConstants)};
  });
  const VkCommandBuffer commands = scope.commands();
  info.data.bind(pipeline, commands, pass, {set_, info.trace.set(), trace.asks ? info.shadows.set() : VK_NULL_HANDLE});
  pipeline.push(commands, areaOf(scope.desc()));
  vkCmdDispatchIndirect(commands, requests_.get(), 0);
  scope.endLabel();
  device_.barriers().record(commands, BarrierKind::shadedToDraw, shaded_.descriptor());
}

uint32_t DeferredShading::record(const PassScope& scope) {
  const VkSampleCountFlagBits samples = scope.samples();
  const Pipeline& pipeline = drawing_.get(samples, [&] {
    return GraphicsPipelineDesc{.name = "shaded surfaces",
                                .vert = "shaded.vert",
                                .frag = "shaded.frag",
                                .constants = {{gpu::constantSamples, static_cast<uint32_t>(samples)}},
                                .setLayouts = {layout_},
                                .pushConstantBytes = sizeof(gpu::ShadeConstants),
                                .samples = samples,
                                .depthTest = false,
                                .depthWrite = false};
  });
  pipeline.bind(scope.commands(), set_, areaOf(scope.desc()));
  vkCmdDraw(scope.commands(), 3, samples, 0, 0);
  return 1;
}

void DeferredShading::countPipelines(EffectLedger& ledger) const {
  shading_.forEach([&](const Variant& variant) {
    ledger.pipeline(EffectKind::shadows, variant.trace.shadows);
    ledger.pipeline(EffectKind::castsLight, variant.trace.castsLight);
    ledger.pipeline(EffectKind::transparency, variant.trace.transparency);
    ledger.pipeline(EffectKind::textures, ledger[EffectKind::textures].draws > 0);
  });
}

void DeferredShading::endFrame(const TraceVariant& trace, bool imagesShown, RetireQueue& retired) {
  const auto idle = [&](const auto& variant) { return !imagesShown || variant.trace != trace; };
  collecting_.endFrame(idle);
  shading_.endFrame(idle);
  drawing_.endFrame([&](VkSampleCountFlagBits) { return !imagesShown; });
  if (shaded_ && ++idleFrames_ > idleFramesKept) {
    retired.take(shaded_);
    retired.take(requests_);
  }
}

}  // namespace speculum
