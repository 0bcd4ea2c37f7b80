#include "systems/render_system.hpp"

namespace speculum {

RenderSystem::RenderSystem(PipelineFactory& factory, VkDescriptorSetLayout frameLayout,
                           VkDescriptorSetLayout textureLayout)
    : factory_(factory), frameLayout_(frameLayout), textureLayout_(textureLayout) {}

const Pipeline& RenderSystem::objects(const Variant& variant) {
  std::unique_ptr<Pipeline>& pipeline = objects_[variant];
  if (!pipeline) {
    GraphicsPipelineDesc desc{.name = "scene", .vert = "scene.vert", .frag = "scene.frag"};
    desc.vertConstants = {variant.clipDistance};
    desc.fragConstants = {variant.trilinear};
    desc.setLayouts = {frameLayout_, textureLayout_};
    desc.pushConstantBytes = sizeof(DrawConstants);
    desc.samples = variant.samples;
    desc.depthClamp = variant.clampDepth;
    desc.lines = variant.wireframe;
    desc.vertexBindings = {{0, sizeof(GpuVertex), VK_VERTEX_INPUT_RATE_VERTEX}};
    desc.vertexAttributes = {{0, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(GpuVertex, position)},
                             {1, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(GpuVertex, normal)},
                             {2, 0, VK_FORMAT_R32G32_SFLOAT, offsetof(GpuVertex, uv)}};
    pipeline = std::make_unique<Pipeline>(factory_, std::move(desc));
  }
  return *pipeline;
}

const Pipeline& RenderSystem::sky(VkSampleCountFlagBits samples) {
  std::unique_ptr<Pipeline>& pipeline = skies_[samples];
  if (!pipeline) {
    GraphicsPipelineDesc desc{.name = "sky", .vert = "full_screen.vert", .frag = "sky.frag"};
    desc.setLayouts = {frameLayout_};
    desc.pushConstantBytes = sizeof(DrawConstants);
    desc.samples = samples;
    desc.depthWrite = false;
    desc.depthCompare = VK_COMPARE_OP_GREATER_OR_EQUAL;
    pipeline = std::make_unique<Pipeline>(factory_, std::move(desc));
  }
  return *pipeline;
}

uint32_t RenderSystem::recordObjects(const PassScope& scope, const FrameInfo& info, const PassData& data,
                                     const Pipeline& pipeline) {
  const VkCommandBuffer commands = scope.commands();
  pipeline.bind(commands);
  pipeline.bindSet(commands, 0, info.data.set());
  uint32_t draws = 0;
  for (const Batch& batch : data.batches) {
    const SceneResources::GpuMesh& mesh = info.resources.meshes()[batch.mesh];
    const VkBuffer vertices = mesh.vertices.get();
    const VkDeviceSize offset = 0;
    vkCmdBindVertexBuffers(commands, 0, 1, &vertices, &offset);
    vkCmdBindIndexBuffer(commands, mesh.indices.get(), 0, VK_INDEX_TYPE_UINT32);
    for (const SceneResources::Part& part : mesh.parts) {
      pipeline.bindSet(commands, 1, part.texture);
      pipeline.push(commands, DrawConstants{data.view, part.material});
      vkCmdDrawIndexed(commands, part.indexCount, batch.count, part.firstIndex, 0, batch.firstInstance);
      ++draws;
    }
  }
  return draws;
}

uint32_t RenderSystem::record(const PassScope& scope, const FrameInfo& info, size_t pass, const PassFormat& format) {
  const PassData& data = info.data.passes()[pass];
  const ClipMethod clip = info.settings.reflection.clip;
  uint32_t draws = 0;
  if (!data.batches.empty()) {
    draws += recordObjects(scope, info, data,
                           objects({.samples = format.samples,
                                    .clipDistance = format.mirrorView && clip == ClipMethod::clipDistance,
                                    .clampDepth = !(format.mirrorView && clip == ClipMethod::oblique),
                                    .trilinear = info.settings.view.textureFilter == TextureFilter::trilinear,
                                    .wireframe = info.settings.view.wireframe}));
  }
  if (info.environment.sky) {
    const Pipeline& pipeline = sky(format.samples);
    pipeline.bind(scope.commands());
    pipeline.bindSet(scope.commands(), 0, info.data.set());
    pipeline.push(scope.commands(), DrawConstants{data.view, 0});
    vkCmdDraw(scope.commands(), 3, 1, 0, 0);
    ++draws;
  }
  return draws;
}

}  // namespace speculum
