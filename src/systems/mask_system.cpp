#include "systems/mask_system.hpp"

namespace speculum {

MaskSystem::MaskSystem(PipelineFactory& factory, VkDescriptorSetLayout frameLayout)
    : frameLayout_(frameLayout), pipelines_(factory) {}

uint32_t MaskSystem::record(const PassScope& scope, const FrameInfo& info, size_t pass, const PassFormat& format) {
  const PassData& data = info.data.passes()[pass];
  if (data.maskVertexCount == 0) {
    return 0;
  }
  const Pipeline& pipeline = pipelines_.get(format.samples, [&] {
    return GraphicsPipelineDesc{.name = "mask",
                                .vert = "mirror.vert",
                                .setLayouts = {frameLayout_},
                                .samples = format.samples,
                                .depthCompare = VK_COMPARE_OP_ALWAYS};
  });
  pipeline.bind(scope.commands());
  info.data.bind(pipeline, scope.commands(), data);
  vkCmdDraw(scope.commands(), data.maskVertexCount, 1, data.maskFirstVertex, 0);
  return 1;
}

}  // namespace speculum
