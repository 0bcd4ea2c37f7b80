#include "systems/render_system.hpp"

#include <algorithm>
#include <array>

#include "geometry/mesh_levels.hpp"

namespace speculum {

RenderSystem::RenderSystem(PipelineFactory& factory, VkDescriptorSetLayout frameLayout,
                           VkDescriptorSetLayout textureLayout)
    : factory_(factory), frameLayout_(frameLayout), textureLayout_(textureLayout) {}

bool RenderSystem::tracesRays(const Variant& variant) {
  return variant.trace.traced || (variant.curved && !variant.environment);
}

namespace {

// Locations of scene.vert.
void addVertexInput(GraphicsPipelineDesc& desc) {
  desc.vertexBindings = {{0, sizeof(GpuVertex), VK_VERTEX_INPUT_RATE_VERTEX},
                         {1, sizeof(gpu::InstanceData), VK_VERTEX_INPUT_RATE_INSTANCE}};
  desc.vertexAttributes = {{0, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(GpuVertex, position)},
                           {1, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(GpuVertex, normal)},
                           {2, 0, VK_FORMAT_R32G32_SFLOAT, offsetof(GpuVertex, uv)}};
  const auto add = [&](uint32_t location, VkFormat format, size_t offset, uint32_t count) {
    for (uint32_t i = 0; i < count; ++i) {
      desc.vertexAttributes.push_back({location + i, 1, format, static_cast<uint32_t>(offset + i * sizeof(glm::vec4))});
    }
  };
  add(3, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(gpu::InstanceData, clipFromMesh), 4);
  add(7, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(gpu::InstanceData, relativeFromMesh), 3);
  add(10, VK_FORMAT_R32G32B32_SFLOAT, offsetof(gpu::InstanceData, normalFromMesh), 3);
  add(13, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(gpu::InstanceData, clipPlane), 1);
}

}  // namespace

const Pipeline& RenderSystem::objects(const Variant& variant, VkDescriptorSetLayout traceLayout) {
  Entry& entry = objects_[variant];
  entry.idleFrames = 0;
  if (!entry.pipeline) {
    GraphicsPipelineDesc desc{.name = "scene", .vert = "scene.vert", .frag = "scene.frag"};
    desc.vertConstants = {variant.clipDistance};
    desc.fragConstants = {variant.trilinear};
    desc.setLayouts = {frameLayout_, textureLayout_};
    if (variant.environment) {
      desc.frag = variant.trace.traced ? "scene_environment_traced.frag" : "scene_environment.frag";
    }
    if (tracesRays(variant)) {
      if (!variant.environment) {
        desc.frag = variant.curved ? "scene_curved.frag" : "scene_traced.frag";
      }
      desc.setLayouts.push_back(traceLayout);
      addConstants(variant.trace, desc.fragConstants);
      desc.sampleShading = variant.trace.perSample && variant.samples != VK_SAMPLE_COUNT_1_BIT;
    }
    desc.pushConstantBytes = sizeof(gpu::DrawConstants);
    desc.samples = variant.samples;
    desc.depthClamp = variant.clampDepth;
    desc.lines = variant.wireframe;
    addVertexInput(desc);
    entry.pipeline = std::make_unique<Pipeline>(factory_, std::move(desc));
  }
  return *entry.pipeline;
}

const Pipeline& RenderSystem::sky(VkSampleCountFlagBits samples) {
  std::unique_ptr<Pipeline>& pipeline = skies_[samples];
  if (!pipeline) {
    GraphicsPipelineDesc desc{.name = "sky", .vert = "full_screen.vert", .frag = "sky.frag"};
    desc.setLayouts = {frameLayout_};
    desc.pushConstantBytes = sizeof(gpu::DrawConstants);
    desc.samples = samples;
    desc.depthWrite = false;
    desc.depthCompare = VK_COMPARE_OP_GREATER_OR_EQUAL;
    pipeline = std::make_unique<Pipeline>(factory_, std::move(desc));
  }
  return *pipeline;
}

namespace {

// All indices of a mesh's part, or of what is drawn in its place.
IndexRange partRange(const Scene& scene, const SceneResources::GpuMesh& mesh, size_t part, const Batch& batch) {
  return batch.level < 0 ? IndexRange{mesh.parts[part].firstIndex, mesh.parts[part].indexCount}
                         : levelsOf(scene.meshes[batch.mesh]).levels[batch.level].parts[part];
}

// Those of them that a batch draws.
std::vector<IndexRange> drawnRanges(const IndexRange& part, const Batch& batch) {
  if (batch.ranges.empty()) {
    return {part};
  }
  std::vector<IndexRange> drawn;
  for (const IndexRange& range : batch.ranges) {
    const uint32_t first = std::max(range.first, part.first);
    const uint32_t end = std::min(range.first + range.count, part.first + part.count);
    if (first < end) {
      drawn.push_back({first, end - first});
    }
  }
  return drawn;
}

}  // namespace

void RenderSystem::countDraw(EffectLedger& ledger, const Variant& variant) {
  ledger.draw(EffectKind::shadows, variant.trace.shadows);
  ledger.draw(EffectKind::castsLight, variant.trace.castsLight);
  ledger.draw(EffectKind::curved, variant.curved);
  ledger.draw(EffectKind::wireframe, variant.wireframe);
}

uint32_t RenderSystem::recordObjects(const PassScope& scope, const FrameInfo& info, const PassData& data,
                                     Variant variant) {
  const VkCommandBuffer commands = scope.commands();
  uint32_t draws = 0;
  for (const Batch& batch : data.batches) {
    variant.curved = batch.curved;
    variant.environment = batch.environment;
    variant.trace = info.trace.variant();
    const bool traces = tracesRays(variant);
    variant.trace = traces ? variant.trace : TraceVariant{};
    const Pipeline& pipeline = objects(variant, info.trace.layout());
    pipeline.bind(commands);
    pipeline.bindSet(commands, 0, info.data.set());
    if (traces) {
      pipeline.bindSet(commands, 2, info.trace.set());
    }
    const SceneResources::GpuMesh& mesh = info.resources.meshes()[batch.mesh];
    const bool whole = batch.level < 0;
    const std::array buffers{(whole ? mesh.vertices : mesh.levelVertices).get(), info.data.instanceBuffer()};
    constexpr std::array<VkDeviceSize, 2> offsets{};
    vkCmdBindVertexBuffers(commands, 0, buffers.size(), buffers.data(), offsets.data());
    vkCmdBindIndexBuffer(commands, (whole ? mesh.indices : mesh.levelIndices).get(), 0, VK_INDEX_TYPE_UINT32);
    scope.beginLabel(variant.curved ? "curved mirrors" : "objects");
    for (size_t p = 0; p < mesh.parts.size(); ++p) {
      const SceneResources::Part& part = mesh.parts[p];
      pipeline.bindSet(commands, 1, batch.map >= 0 ? info.maps[batch.map] : info.resources.texture(part));
      for (const IndexRange& range : drawnRanges(partRange(info.scene, mesh, p, batch), batch)) {
        pipeline.push(commands,
                      gpu::DrawConstants{
                          .viewIndex = data.view, .materialIndex = part.material, .firstTriangle = range.first / 3});
        vkCmdDrawIndexed(commands, range.count, batch.count, range.first, 0, batch.firstInstance);
        ++draws;
        countDraw(info.ledger, variant);
        info.ledger.draw(EffectKind::textures, part.texture >= 0 && info.settings.effects.textures);
      }
    }
    scope.endLabel();
  }
  return draws;
}

void RenderSystem::countPipelines(EffectLedger& ledger) const {
  for (const auto& [variant, entry] : objects_) {
    ledger.pipeline(EffectKind::shadows, variant.trace.shadows);
    ledger.pipeline(EffectKind::castsLight, variant.trace.castsLight);
    ledger.pipeline(EffectKind::curved, variant.curved);
    ledger.pipeline(EffectKind::wireframe, variant.wireframe);
  }
}

void RenderSystem::endFrame(const TraceVariant& trace, bool imagesShown, bool curved) {
  for (auto& [variant, entry] : objects_) {
    const bool stays = imagesShown && variant.trace == trace && (curved || !variant.curved);
    entry.idleFrames += !stays && (variant.curved || variant.trace.traced);
  }
  std::erase_if(objects_, [](const auto& item) { return item.second.idleFrames > idleFramesKept; });
}

uint32_t RenderSystem::record(const PassScope& scope, const FrameInfo& info, size_t pass, const PassFormat& format) {
  const PassData& data = info.data.passes()[pass];
  const ClipMethod clip = info.settings.reflection.clip;
  uint32_t draws = 0;
  if (!data.batches.empty()) {
    draws += recordObjects(scope, info, data,
                           {.samples = format.samples,
                            .clipDistance = format.mirrorView && clip == ClipMethod::clipDistance,
                            .clampDepth = !(format.mirrorView && clip == ClipMethod::oblique),
                            .trilinear = info.settings.view.textureFilter == TextureFilter::trilinear,
                            .wireframe = info.settings.view.wireframe});
  }
  if (info.environment.sky) {
    const Pipeline& pipeline = sky(format.samples);
    pipeline.bind(scope.commands());
    pipeline.bindSet(scope.commands(), 0, info.data.set());
    pipeline.push(scope.commands(), gpu::DrawConstants{.viewIndex = data.view});
    vkCmdDraw(scope.commands(), 3, 1, 0, 0);
    ++draws;
  }
  return draws;
}

}  // namespace speculum
