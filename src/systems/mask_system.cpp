#include "systems/mask_system.hpp"

namespace speculum {

MaskSystem::MaskSystem(PipelineFactory& factory, VkDescriptorSetLayout frameLayout)
    : factory_(factory), frameLayout_(frameLayout) {}

uint32_t MaskSystem::record(const PassScope& scope, const FrameInfo& info, size_t pass, const PassFormat& format) {
  const PassData& data = info.data.passes()[pass];
  if (data.maskVertexCount == 0) {
    return 0;
  }
  std::unique_ptr<Pipeline>& pipeline = pipelines_[format.samples];
  if (!pipeline) {
    GraphicsPipelineDesc desc{.name = "mask", .vert = "mirror.vert"};
    desc.setLayouts = {frameLayout_};
    desc.samples = format.samples;
    desc.depthCompare = VK_COMPARE_OP_ALWAYS;
    pipeline = std::make_unique<Pipeline>(factory_, std::move(desc));
  }
  pipeline->bind(scope.commands());
  pipeline->bindSet(scope.commands(), 0, info.data.set());
  vkCmdDraw(scope.commands(), data.maskVertexCount, 1, data.maskFirstVertex, 0);
  return 1;
}

}  // namespace speculum
