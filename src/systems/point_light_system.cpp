#include "systems/point_light_system.hpp"

namespace speculum {

PointLightSystem::PointLightSystem(PipelineFactory& factory, VkDescriptorSetLayout frameLayout)
    : frameLayout_(frameLayout), pipelines_(factory) {}

uint32_t PointLightSystem::record(const PassScope& scope, const FrameInfo& info, size_t pass,
                                  const PassFormat& format) {
  const PassData& data = info.data.passes()[pass];
  if (data.glyphCount == 0) {
    return 0;
  }
  const Pipeline& pipeline = pipelines_.get(format.samples, [&] {
    return GraphicsPipelineDesc{.name = "point_light",
                                .vert = "point_light.vert",
                                .frag = "point_light.frag",
                                .setLayouts = {frameLayout_},
                                .samples = format.samples,
                                .sampleShading = format.samples != VK_SAMPLE_COUNT_1_BIT,
                                .cullMode = VK_CULL_MODE_FRONT_BIT};
  });
  pipeline.bind(scope.commands());
  info.data.bind(pipeline, scope.commands(), data);
  vkCmdDraw(scope.commands(), 36, data.glyphCount, 0, 0);
  info.ledger.draw(EffectKind::glyphs);
  return 1;
}

void PointLightSystem::endFrame(bool stays) {
  pipelines_.endFrame([&](VkSampleCountFlagBits) { return !stays; });
}

}  // namespace speculum
