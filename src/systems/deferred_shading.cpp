#include "systems/deferred_shading.hpp"

#include <array>
#include <utility>

namespace speculum {

namespace {

constexpr uint32_t groupSide = 8;  // in shade.glsl

uint32_t groups(uint32_t size) {
  return (size + groupSide - 1) / groupSide;
}

gpu::ShadeConstants areaOf(const PassDesc& pass) {
  const VkRect2D& area = pass.renderArea;
  return {.corner = {area.offset.x, area.offset.y}, .size = {area.extent.width, area.extent.height}};
}

uint64_t bytesOf(const PassDesc& pass) {
  const VkExtent2D size = pass.renderArea.extent;
  return uint64_t{8} * size.width * size.height * pass.targets.samples();
}

}  // namespace

DeferredShading::DeferredShading(Device& device, PipelineFactory& factory, VkDescriptorSetLayout frameLayout)
    : device_(device), frameLayout_(frameLayout), shading_(factory), drawing_(factory) {}

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
  if (!layout_) {
    constexpr VkShaderStageFlags compute = VK_SHADER_STAGE_COMPUTE_BIT;
    const std::array bindings = {
        DescriptorBinding{0, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, compute},
        DescriptorBinding{1, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, compute | VK_SHADER_STAGE_FRAGMENT_BIT},
        DescriptorBinding{2, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, compute}};
    layout_ = createDescriptorSetLayout(device_, bindings, "deferred shading");
    sampler_ = createSampler(device_, {.maxLod = 0.0f}, "deferred shading");
  }
  if (shaded_.bytes() < bytesOf(pass)) {
    info.frame.retired->retire(std::exchange(shaded_, {}));
    shaded_ =
        Buffer(device_, bytesOf(pass), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, BufferMemory::device, "shaded samples");
  }
  set_ = info.frame.descriptors->allocate(layout_.get());
  DescriptorWriter()
      .image(0, pass.targets.color->descriptor(sampler_.get()))
      .buffer(1, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, shaded_.descriptor())
      .buffer(2, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, info.data.mirrorBuffer(info.frame))
      .update(device_, set_);
}

void DeferredShading::shade(const PassScope& scope, const FrameInfo& info, size_t pass) {
  idleFrames_ = 0;
  prepare(info, scope.desc());
  const VkSampleCountFlagBits samples = scope.desc().targets.samples();
  const TraceVariant& trace = info.trace.variant();
  const bool trilinear = info.settings.view.textureFilter == TextureFilter::trilinear;
  const Pipeline& pipeline = shading_.get({samples, trilinear, trace}, [&] {
    std::string shader = samples == VK_SAMPLE_COUNT_1_BIT ? "shade" : "shade_samples";
    shader += trace.hardware ? "_ray_query.comp" : ".comp";
    return ComputePipelineDesc{.name = "deferred shading",
                               .comp = shader,
                               .constants = {samples, trilinear, trace.shadows, trace.castsLight, trace.perSample},
                               .setLayouts = {frameLayout_, layout_.get(), info.trace.layout()},
                               .pushConstantBytes = sizeof(gpu::ShadeConstants)};
  });
  const VkCommandBuffer commands = scope.commands();
  pipeline.bind(commands);
  info.data.bind(pipeline, commands, info.data.passes()[pass]);
  pipeline.bindSet(commands, 1, set_);
  pipeline.bindSet(commands, 2, info.trace.set());
  const gpu::ShadeConstants area = areaOf(scope.desc());
  pipeline.push(commands, area);
  scope.beginLabel("deferred shading");
  vkCmdDispatch(commands, groups(area.size.x), groups(area.size.y), 1);
  scope.endLabel();
  device_.barriers().record(commands, BarrierKind::shadedToDraw, shaded_.descriptor());
}

uint32_t DeferredShading::record(const PassScope& scope) {
  const VkSampleCountFlagBits samples = scope.desc().targets.samples();
  const Pipeline& pipeline = drawing_.get(samples, [&] {
    return GraphicsPipelineDesc{.name = "shaded surfaces",
                                .vert = "shaded.vert",
                                .frag = "shaded.frag",
                                .fragConstants = {static_cast<uint32_t>(samples)},
                                .setLayouts = {layout_.get()},
                                .pushConstantBytes = sizeof(gpu::ShadeConstants),
                                .samples = samples,
                                .depthTest = false,
                                .depthWrite = false};
  });
  pipeline.bind(scope.commands());
  pipeline.bindSet(scope.commands(), 0, set_);
  pipeline.push(scope.commands(), areaOf(scope.desc()));
  vkCmdDraw(scope.commands(), 3, samples, 0, 0);
  return 1;
}

void DeferredShading::countPipelines(EffectLedger& ledger) const {
  shading_.forEach([&](const Variant& variant) {
    ledger.pipeline(EffectKind::shadows, variant.trace.shadows);
    ledger.pipeline(EffectKind::castsLight, variant.trace.castsLight);
  });
}

void DeferredShading::endFrame(const TraceVariant& trace, bool imagesShown, RetireQueue& retired) {
  const auto idle = [&](const TraceVariant& of) { return !(imagesShown && of == trace); };
  shading_.endFrame([&](const Variant& variant) { return idle(variant.trace); });
  drawing_.endFrame([&](VkSampleCountFlagBits) { return !imagesShown; });
  if (shaded_ && ++idleFrames_ > idleFramesKept) {
    retired.retire(std::exchange(shaded_, {}));
  }
}

}  // namespace speculum
