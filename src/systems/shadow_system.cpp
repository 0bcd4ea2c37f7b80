#include "systems/shadow_system.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "plan/shadow_map.hpp"
#include "plan/target_memory.hpp"
#include "systems/render_system.hpp"
#include "systems/scene_targets.hpp"

namespace speculum {

namespace {

constexpr VkFormat planeFormat = VK_FORMAT_R32G32_UINT;
static_assert(bytesOfTexel(planeFormat) == shadowPlaneBytes);
constexpr float edgeWidth = 1.0f;  // texels
constexpr std::array shadowBufferNames = {"shadow maps"};

std::array<gpu::ShadowMapData, gpu::mostShadowMaps> mapData(const FramePlan& plan) {
  static_assert(gpu::mostShadowMaps == mostShadowMaps);
  std::array<gpu::ShadowMapData, gpu::mostShadowMaps> data{};
  for (const Pass& face : plan.passes) {
    if (face.id.kind == PassKind::shadow && !face.isLayer && face.source != PassSource::unread) {
      const double texels = static_cast<double>(face.view.rect.width - 2 * shadowBorder);
      const glm::dvec2 scale = texels / (face.window.high - face.window.low);
      const glm::dvec2 corner = glm::dvec2(face.corner + shadowBorder) - face.window.low * scale;
      data[face.cube].faces[face.id.face] = glm::vec4(glm::dvec4(scale, corner));
    }
  }
  return data;
}

}  // namespace

ShadowSystem::ShadowSystem(Device& device, PipelineFactory& factory, VkDescriptorSetLayout frameLayout)
    : device_(device),
      frameLayout_(frameLayout),
      buffers_(device, shadowBufferNames, "fewer lights"),
      pipelines_(factory) {}

void ShadowSystem::create() {
  if (layout_) {
    return;
  }
  constexpr VkShaderStageFlags stages = VK_SHADER_STAGE_FRAGMENT_BIT | VK_SHADER_STAGE_COMPUTE_BIT;
  const std::array bindings{
      DescriptorBinding{.binding = 0, .type = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, .stages = stages},
      DescriptorBinding{.binding = 1, .stages = stages}};
  layout_ = descriptorSetLayout(device_, bindings, "shadow maps");
  // Does not filter: shaders gather texels, compare each, and interpolate the results.
  sampler_ = createSampler(device_,
                           {.filter = VK_FILTER_NEAREST, .mipmapMode = VK_SAMPLER_MIPMAP_MODE_NEAREST, .maxLod = 0.0f},
                           "shadow maps");
}

void ShadowSystem::prepare(Frame& frame, const FramePlan& plan) {
  set_ = VK_NULL_HANDLE;
  if (cubesOf(plan.cubes, PassKind::shadow).empty()) {
    return;
  }
  create();
  onlyFace_ = static_cast<uint32_t>(onlyShadowFace(plan).value_or(gpu::anyShadowFace));
  const glm::ivec2 size = shadowExtent(plan);
  const VkExtent2D extent{static_cast<uint32_t>(size.x), static_cast<uint32_t>(size.y)};
  if (!target_) {
    target_ = std::make_unique<OffScreen>(
        device_, OffScreenDesc{.name = "shadow maps", .extent = extent, .format = planeFormat}, *frame.retired);
  }
  target_->resize(extent, *frame.retired);
  if (target_->color().layout() == VK_IMAGE_LAYOUT_UNDEFINED && !rendersShadows(plan)) {
    device_.barriers().record(frame.commands, BarrierKind::offscreenToSample, target_->color());
  }
  const auto data = mapData(plan);
  buffers_.write(frame, 0, std::as_bytes(std::span(data)));
  set_ = frame.descriptors->allocate(layout_);
  VkDescriptorBufferInfo buffer = buffers_.buffer(frame, 0).descriptor();
  buffer.range = sizeof data;
  DescriptorWriter()
      .image(0, target_->color().descriptor(sampler_.get()))
      .buffer(1, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, buffer)
      .update(device_, set_);
  prepareLayers(frame, plan);
}

void ShadowSystem::prepareLayers(Frame& frame, const FramePlan& plan) {
  if (!hasShadowLayers(plan)) {
    frame.retired->take(layers_);
    return;
  }
  if (!layers_) {
    const OffScreenDesc desc{
        .name = "shadow layers", .extent = target_->extent(), .format = planeFormat, .depth = false};
    layers_ = std::make_unique<OffScreen>(device_, desc, *frame.retired);
  }
  layerSet_ = frame.descriptors->allocate(layout_);
  DescriptorWriter().image(0, layers_->color().descriptor(sampler_.get())).update(device_, layerSet_);
}

PassTargets ShadowSystem::layerTargets() {
  PassTargets targets = layers_->targets();
  targets.depth = target_->targets().depth;
  return targets;
}

const Pipeline& ShadowSystem::pipelineFor(const Variant& variant, const FrameInfo& info) {
  const Drawn drawn = variant.drawn;
  return pipelines_.get(variant, [&] {
    const bool ofMirror = drawn == Drawn::mirrors || drawn == Drawn::mirrorEdges;
    GraphicsPipelineDesc desc{.name = "shadow map",
                              .vert = ofMirror ? "mirror.vert" : "scene.vert",
                              .setLayouts = {frameLayout_},
                              .color = planeFormat,
                              .lines = drawn == Drawn::edges || drawn == Drawn::mirrorEdges};
    switch (drawn) {
      case Drawn::objects:
        desc.frag = "shadow_map.frag";
        break;
      case Drawn::mirrors:
        desc.frag = "shadow_map_mirror.frag";
        break;
      case Drawn::covered:
        addCoverage(desc, variant.vertexAlpha ? "shadow_map_covered_colored.frag" : "shadow_map_covered.frag",
                    info.resources.textureLayout());
        desc.constants = {{gpu::constantClamps, variant.clamps}, {gpu::constantVertexAlpha, variant.vertexAlpha}};
        break;
      case Drawn::edges:
      case Drawn::coveredEdges:
      case Drawn::mirrorEdges:
        desc.frag = "shadow_edge.frag";
        break;
      case Drawn::layer:
        desc.vert = "full_screen.vert";
        desc.frag = "shadow_layer.frag";
        desc.setLayouts.push_back(layout_);
        return desc;
    }
    if (!ofMirror) {
      addVertexInput(desc);
    }
    if (variant.vertexAlpha) {
      addVertexColors(desc, true);
    }
    return desc;
  });
}

uint32_t ShadowSystem::draw(const PassScope& scope, const FrameInfo& info, size_t pass, bool overLayer) {
  const VkCommandBuffer commands = scope.commands();
  const DrawList& data = info.data.passes()[pass];
  uint32_t draws = 0;
  if (overLayer) {
    const Pipeline& pipeline = pipelineFor({Drawn::layer}, info);
    info.data.bind(pipeline, commands, data, {layerSet_});
    vkCmdDraw(commands, 3, 1, 0, 0);
    ++draws;
  }
  bool bound = false;  // the pipeline of opaque objects
  const Batch* before = nullptr;
  for (const Batch& batch : data.batches) {
    bindBatch(scope, info, batch, std::exchange(before, &batch));
    if (!batch.curved && isTransparent(info.scene.meshes[batch.mesh], info.settings.effects)) {
      draws += drawParts(scope, info, data, batch);
      bound = false;
      continue;
    }
    if (!std::exchange(bound, true)) {
      info.data.bind(pipelineFor({Drawn::objects}, info), commands, data);
    }
    const RecycledVector<IndexRange> all{allOf(info.scene.meshes[batch.mesh])};
    for (const IndexRange& range : batch.ranges.empty() ? all : batch.ranges) {
      drawBatch(commands, info, batch, range);
      ++draws;
    }
  }
  scope.cull(VK_CULL_MODE_NONE);
  for (const MirrorRange& mirror : data.mirrors) {
    info.data.bind(pipelineFor({Drawn::mirrors}, info), commands, data, {}, mirror.mirror);
    vkCmdDraw(commands, mirror.vertexCount, 1, mirror.firstVertex, 0);
    ++draws;
  }
  return draws + (info.plan.effects.hybridShadows ? drawEdges(scope, info, data) : 0);
}

uint32_t ShadowSystem::drawEdges(const PassScope& scope, const FrameInfo& info, const DrawList& data) {
  const VkCommandBuffer commands = scope.commands();
  uint32_t draws = 0;
  scope.drawLines(true, edgeWidth);
  for (const Batch& batch : data.batches) {
    bindBatch(scope, info, batch, nullptr);
    // Draws a solid's backs alone: their edges lie behind the fronts, except along outlines. The batch's ranges leave
    // out clusters of backs.
    const VkCullModeFlags fronts = batch.handedness > 0.0f ? VK_CULL_MODE_FRONT_BIT : VK_CULL_MODE_BACK_BIT;
    scope.cull(batch.cullsBacks ? fronts : VkCullModeFlags{VK_CULL_MODE_NONE});
    info.data.bind(pipelineFor({Drawn::edges}, info), commands, data);
    drawBatch(commands, info, batch, allOf(info.scene.meshes[batch.mesh]));
    ++draws;
  }
  scope.cull(VK_CULL_MODE_NONE);
  for (const MirrorRange& mirror : data.mirrors) {
    info.data.bind(pipelineFor({Drawn::mirrorEdges}, info), commands, data, {}, mirror.mirror);
    vkCmdDraw(commands, mirror.vertexCount, 1, mirror.firstVertex, 0);
    ++draws;
  }
  return draws;
}

// Draws a batch part by part, those with coverage with their opacity or, for lookups that ask, as a mark of an edge.
uint32_t ShadowSystem::drawParts(const PassScope& scope, const FrameInfo& info, const DrawList& data,
                                 const Batch& batch) {
  const VkCommandBuffer commands = scope.commands();
  uint32_t draws = 0;
  const Mesh& mesh = info.scene.meshes[batch.mesh];
  const bool vertexAlpha = mesh.hasVertexAlpha();
  if (vertexAlpha) {
    bindColors(commands, info, batch);
  }
  for (const MeshPart& part : mesh.parts) {
    const bool covered = isTransparent(part.material, info.settings.effects);
    const bool asks = covered && info.plan.effects.hybridShadows;
    covered_ = covered_ || (covered && !asks);
    const Variant variant = covered && !asks ? Variant{Drawn::covered, part.material.clamps, vertexAlpha}
                                             : Variant{covered ? Drawn::coveredEdges : Drawn::objects};
    const Pipeline& pipeline = pipelineFor(variant, info);
    info.data.bind(pipeline, commands, data);
    if (covered && !asks) {
      bindOpacity(pipeline, commands, info, part.material);
    }
    for (const IndexRange& range : drawnRanges(part, batch)) {
      if (covered && !asks) {
        pipeline.push(commands, coverageConstants({.firstTriangle = range.first / 3}, part.material));
      }
      drawBatch(commands, info, batch, range);
      info.ledger.draw(EffectKind::transparency, covered);
      ++draws;
    }
  }
  return draws;
}

RecordedPass ShadowSystem::record(Renderer& renderer, const FrameInfo& info, size_t index) {
  const Pass& face = info.plan.passes[index];
  const VkExtent2D size = extentOf(face.view.rect.width, face.view.rect.height);
  const VkRect2D area{{face.corner.x, face.corner.y}, size};
  RecordedPass pass{face.id, passName(info.scene, info.plan, face)};
  pass.areaPx = face.areaPx;
  const auto add = [&](const PassTargets& targets, int drawn, bool overLayer) {
    PassScope scope = renderer.beginPass(
        info.frame, {.name = pass.name,
                     .targets = targets,
                     .renderArea = area,
                     .viewport = {static_cast<float>(face.corner.x), static_cast<float>(face.corner.y),
                                  static_cast<float>(size.width), static_cast<float>(size.height)},
                     .scissor = area,
                     .collectStatistics = true});
    scope.countSamples();
    pass.draws += draw(scope, info, static_cast<size_t>(drawn), overLayer);
  };
  if (face.layer >= 0 && info.plan.passes[face.layer].drawn()) {
    add(layerTargets(), face.layer, false);
  }
  add(target_->targets(), static_cast<int>(index), face.layer >= 0);
  return pass;
}

void ShadowSystem::release(RetireQueue& retired) {
  retired.take(layers_);
  retired.take(target_);
  buffers_.retire(retired);
  pipelines_.clear();
}

void ShadowSystem::endFrame(const FramePlan& plan, RetireQueue& retired) {
  pipelines_.endFrame([&](const Variant& variant) {
    const Drawn drawn = variant.drawn;
    const bool edges = drawn == Drawn::edges || drawn == Drawn::coveredEdges || drawn == Drawn::mirrorEdges;
    return edges ? !plan.effects.hybridShadows : drawn == Drawn::covered && !covered_;
  });
  covered_ = false;
  idleFrames_ = cubesOf(plan.cubes, PassKind::shadow).empty() ? std::min(idleFrames_, ImagePool::framesKept) + 1 : 0;
  if (target_ && idleFrames_ > ImagePool::framesKept) {
    release(retired);
  }
}

uint64_t ShadowSystem::bytes() const {
  return target_ ? target_->bytes() + (layers_ ? layers_->bytes() : 0) + buffers_.bytes() : 0;
}

}  // namespace speculum
