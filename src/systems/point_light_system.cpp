#include "systems/point_light_system.hpp"

namespace speculum {

PointLightSystem::PointLightSystem(PipelineFactory& factory, VkDescriptorSetLayout frameLayout)
    : factory_(factory), frameLayout_(frameLayout) {}

uint32_t PointLightSystem::record(const PassScope& scope, const FrameInfo& info, size_t pass,
                                  const PassFormat& format) {
  const PassData& data = info.data.passes()[pass];
  if (data.glyphCount == 0) {
    return 0;
  }
  Entry& entry = pipelines_[format.samples];
  entry.idleFrames = 0;
  std::unique_ptr<Pipeline>& pipeline = entry.pipeline;
  if (!pipeline) {
    GraphicsPipelineDesc desc{.name = "point_light", .vert = "point_light.vert", .frag = "point_light.frag"};
    desc.setLayouts = {frameLayout_};
    desc.pushConstantBytes = sizeof(gpu::DrawConstants);
    desc.samples = format.samples;
    desc.sampleShading = format.samples != VK_SAMPLE_COUNT_1_BIT;
    desc.cullMode = VK_CULL_MODE_FRONT_BIT;
    pipeline = std::make_unique<Pipeline>(factory_, std::move(desc));
  }
  pipeline->bind(scope.commands());
  pipeline->bindSet(scope.commands(), 0, info.data.set());
  pipeline->push(scope.commands(), gpu::DrawConstants{.viewIndex = data.view});
  vkCmdDraw(scope.commands(), 36, data.glyphCount, 0, 0);
  info.ledger.draw(EffectKind::glyphs);
  return 1;
}

void PointLightSystem::endFrame(bool stays) {
  for (auto& [samples, entry] : pipelines_) {
    entry.idleFrames += !stays;
  }
  std::erase_if(pipelines_, [](const auto& item) { return item.second.idleFrames > idleFramesKept; });
}

}  // namespace speculum
