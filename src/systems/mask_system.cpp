#include "systems/mask_system.hpp"

namespace speculum {

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

}  // namespace speculum
