#include "systems/render_system.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include "plan/view.hpp"
#include "systems/deferred_shading.hpp"
#include "systems/gpu_conversion.hpp"
#include "systems/shadow_system.hpp"

namespace speculum {

// Lines have no mean of covered samples at which their shadows could be shaded: rays are traced for all of them.
bool RenderSystem::asks(const FrameInfo& info, const Batch& batch) {
  return info.plan.effects.hybridShadows && !info.settings.view.wireframe && !batch.curved && !batch.environment;
}

// A curved mirror that looks up an environment map takes rays only for the light on its base, if the base is not black.
bool RenderSystem::defers(const FrameInfo& info, const Batch& batch) {
  if (batch.environment) {
    return info.trace.variant().traced && batch.colored;
  }
  return info.trace.variant().traced || batch.curved;
}

bool RenderSystem::defers(const FrameInfo& info, const DrawList& pass) {
  return std::ranges::any_of(pass.batches, [&](const Batch& batch) { return defers(info, batch); });
}

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
  add(10, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(gpu::InstanceData, normalFromMesh), 3);
  add(13, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(gpu::InstanceData, clipPlane), 1);
}

void addVertexColors(GraphicsPipelineDesc& desc, bool withAlpha) {
  desc.vert = "scene_colored.vert";
  constexpr uint32_t bytes = sizeof(glm::vec4);
  constexpr uint32_t opaqueBytes = sizeof(glm::vec3);
  desc.vertexBindings.push_back({2, withAlpha ? bytes : opaqueBytes, VK_VERTEX_INPUT_RATE_VERTEX});
  desc.vertexAttributes.push_back({14, 2, withAlpha ? VK_FORMAT_R32G32B32A32_SFLOAT : VK_FORMAT_R32G32B32_SFLOAT, 0});
}

void bindColors(VkCommandBuffer commands, const FrameInfo& info, const Batch& batch) {
  const SceneResources::GpuMesh& mesh = info.resources.meshes()[batch.mesh];
  vkCmdBindVertexBuffers(commands, 2, 1, &mesh.buffer, &mesh.colors);
}

void bindBatch(const PassScope& scope, const FrameInfo& info, const Batch& batch, const Batch* before) {
  const VkBuffer buffer = info.resources.meshes()[batch.mesh].buffer;
  if (!before || info.resources.meshes()[before->mesh].buffer != buffer) {
    const std::array buffers{buffer, info.data.instanceBuffer()};
    constexpr std::array<VkDeviceSize, 2> offsets{};
    vkCmdBindVertexBuffers(scope.commands(), 0, buffers.size(), buffers.data(), offsets.data());
    vkCmdBindIndexBuffer(scope.commands(), buffer, 0, VK_INDEX_TYPE_UINT32);
  }
  const auto culled = [](const Batch& of) -> VkCullModeFlags {
    return !of.cullsBacks ? VK_CULL_MODE_NONE : of.handedness > 0.0f ? VK_CULL_MODE_BACK_BIT : VK_CULL_MODE_FRONT_BIT;
  };
  if (!before || culled(*before) != culled(batch)) {
    scope.cull(culled(batch));
  }
}

GraphicsPipelineDesc RenderSystem::objects(const Variant& variant, const FrameInfo& info,
                                           const DeferredShading* shading) const {
  GraphicsPipelineDesc desc{.name = "scene",
                            .vert = variant.handed ? "scene_handed.vert" : "scene.vert",
                            .frag = "scene.frag",
                            .constants = {{gpu::constantClipAtMirror, variant.clipDistance},
                                          {gpu::constantDiffuseLookup, variant.diffuseLookup},
                                          {gpu::constantGlossy, variant.glossy},
                                          {gpu::constantBaseOnly, variant.environment},
                                          {gpu::constantSamples, variant.format.samples},
                                          {gpu::constantOnlyShadowFace, variant.onlyShadowFace},
                                          {gpu::constantLightCount, variant.lightCount},
                                          {gpu::constantBranches, info.data.branches()},
                                          {gpu::constantShadowedLights, variant.shadowedLights},
                                          {gpu::constantClamps, variant.clamps},
                                          {gpu::constantWholePixel, variant.format.samples > 1},
                                          {gpu::constantVertexAlpha, variant.vertexAlpha},
                                          {gpu::constantRepeating, variant.repeating}},
                            .setLayouts = {frameLayout_, textureLayout_},
                            .pushConstantBytes = sizeof(gpu::DrawConstants),
                            .depthClamp = variant.clampDepth,
                            .lines = variant.wireframe,
                            .mayDrawLines = true};
  const std::string lookup = variant.asks ? "_asking" : variant.shadowed ? "_shadowed" : "";
  if (variant.deferred) {
    desc.frag = "scene_identifier.frag";
  } else {
    desc.frag = std::string("scene") + (variant.handed ? "_handed" : "") + (variant.environment ? "_environment" : "") +
                (variant.vertexColors ? "_colored" : "") + (variant.repeating ? "_repeating" : "") + lookup + ".frag";
  }
  if (variant.added) {
    desc.frag = "scene_environment_reflection.frag";
    desc.setLayouts.push_back(shading->layout());
    desc.pushConstantBytes = sizeof(gpu::ReflectionConstants);
    desc.depthCompare = VK_COMPARE_OP_EQUAL;
    desc.depthWrite = false;
    desc.adds = true;
  }
  if (variant.shadowed) {
    desc.setLayouts.push_back(info.shadows.layout());
  }
  if (variant.covered) {
    addCoverage(desc,
                std::string(variant.deferred ? "scene_identifier_covered" : "scene_covered") +
                    (variant.vertexColors ? "_colored" : "") + lookup + ".frag",
                textureLayout_);
  }
  addVertexInput(desc);
  if (variant.vertexColors) {
    addVertexColors(desc, variant.vertexAlpha);
  }
  return variant.format.describe(desc);
}

void drawBatch(VkCommandBuffer commands, const FrameInfo& info, const Batch& batch, const IndexRange& range) {
  const SceneResources::GpuMesh& mesh = info.resources.meshes()[batch.mesh];
  vkCmdDrawIndexed(commands, range.count, batch.count, mesh.firstIndex + range.first, mesh.firstVertex,
                   batch.firstInstance);
}

RecycledVector<IndexRange> drawnRanges(const MeshPart& part, const Batch& batch) {
  if (batch.ranges.empty()) {
    return {{part.firstIndex, part.indexCount}};
  }
  RecycledVector<IndexRange> drawn;
  for (const IndexRange& range : batch.ranges) {
    const uint32_t first = std::max(range.first, part.firstIndex);
    const uint32_t end = std::min(range.first + range.count, part.firstIndex + part.indexCount);
    if (first < end) {
      drawn.push_back({first, end - first});
    }
  }
  return drawn;
}

void addCoverage(GraphicsPipelineDesc& desc, const std::string& frag, VkDescriptorSetLayout textureLayout) {
  desc.frag = frag;
  desc.setLayouts.resize(4, textureLayout);
  desc.pushConstantBytes = sizeof(gpu::CoverageConstants);
}

void bindOpacity(const Pipeline& pipeline, VkCommandBuffer commands, const FrameInfo& info, const Material& material) {
  const int texture = info.settings.effects.textures ? material.opacityTexture : -1;
  pipeline.bindSet(commands, 3, info.resources.texture(texture));
}

gpu::CoverageConstants coverageConstants(const gpu::DrawConstants& draw, const Material& material) {
  return {draw, static_cast<float>(material.opacity), static_cast<float>(material.leastOpacity())};
}

void RenderSystem::countDraw(EffectLedger& ledger, const Variant& variant) {
  ledger.draw(EffectKind::shadows, variant.trace.shadows || variant.shadowed);
  ledger.draw(EffectKind::castsLight, variant.trace.castsLight);
  ledger.draw(EffectKind::curved, variant.curved);
  ledger.draw(EffectKind::transparency, variant.covered || variant.trace.transparency);
}

uint32_t RenderSystem::recordBatch(const PassScope& scope, const FrameInfo& info, const DrawList& pass,
                                   const Batch& batch, Variant variant, Bound& bound, const DeferredShading* shading) {
  const VkCommandBuffer commands = scope.commands();
  variant.curved = batch.curved;
  variant.environment = batch.environment;
  variant.asks = !variant.deferred && asks(info, batch);
  const bool mayHandOn = variant.handed && !variant.deferred && !variant.environment && !variant.asks;
  variant.trace = variant.deferred || variant.asks ? info.trace.variant() : TraceVariant{};
  variant.shadowed = !variant.deferred && !variant.added && info.shadows.set() != VK_NULL_HANDLE;
  variant.shadowedLights =
      variant.shadowed ? static_cast<uint32_t>(cubesOf(info.plan.cubes, PassKind::shadow).size()) : 0;
  variant.onlyShadowFace = variant.shadowed ? info.shadows.onlyFace() : gpu::anyShadowFace;
  variant.lightCount = variant.deferred || variant.added ? gpu::manyLights : fixedLightCount(info.scene);
  const Mesh& mesh = info.scene.meshes[batch.mesh];
  bindBatch(scope, info, batch, std::exchange(bound.batch, &batch));
  const bool hasAlpha = mesh.hasVertexAlpha();
  const bool mayBeColored = !batch.environment && !mesh.colors.empty();
  if (mayBeColored && (!variant.deferred || hasAlpha)) {
    bindColors(commands, info, batch);
  }
  uint32_t draws = 0;
  if (scope.hasLabels()) {
    scope.beginLabel(nameOf<RecycledString>("object", info.scene.objects[batch.object].name, batch.object));
  }
  for (size_t p = 0; p < mesh.parts.size(); ++p) {
    const Material& material = mesh.parts[p].material;
    const bool textured = material.diffuseTexture >= 0 && info.settings.effects.textures;
    gpu::DrawConstants constants = drawConstants(material, info.scene.objects[batch.object], batch.handedness);
    constants.emission *= info.settings.view.radianceScale();
    if (!variant.deferred) {
      variant.diffuseLookup = textured && !batch.environment
                                  ? info.resources.textureLookup(info.settings.view.textureFilter)
                                  : gpu::textureNone;
      variant.glossy = constants.specular != glm::vec3(0.0f);
    }
    variant.covered = !batch.curved && isTransparent(material, info.settings.effects);
    variant.vertexColors = mayBeColored && (!variant.deferred || (variant.covered && hasAlpha));
    variant.vertexAlpha = variant.vertexColors && hasAlpha;
    variant.repeating = (variant.covered || variant.diffuseLookup != gpu::textureNone) &&
                        !info.data.repeats().empty() &&
                        mesh.parts[p].firstIndex + 3 * mesh.repeats >= mesh.indices.size();
    variant.clamps = material.clamps && (variant.covered || variant.diffuseLookup != gpu::textureNone);
    variant.handed = mayHandOn && !variant.covered && !variant.vertexColors && !variant.repeating;
    const VkDescriptorSet texture = batch.map >= 0 ? info.maps[batch.map] : info.resources.texture(material);
    if (!bound.pipeline || bound.variant != variant) {
      // Pipelines of equal layouts leave each other's sets, constants and lines bound.
      const bool sameLayout =
          bound.pipeline && bound.variant.covered == variant.covered && bound.variant.shadowed == variant.shadowed;
      bound.pipeline = &objects_.get(variant, [&] { return objects(variant, info, shading); });
      bound.variant = variant;
      if (sameLayout) {
        bound.pipeline->bind(commands);
      } else {
        const VkDescriptorSet looksUp = variant.shadowed ? info.shadows.set() : VK_NULL_HANDLE;
        info.data.bind(*bound.pipeline, commands, pass, {texture, variant.added ? shading->set() : looksUp});
        scope.drawLines(info.settings.view.wireframe, pass.lineWidth);
        bound.texture = texture;
        bound.constants.reset();
      }
    }
    const Pipeline& pipeline = *bound.pipeline;
    if (std::exchange(bound.texture, texture) != texture) {
      pipeline.bindSet(commands, 1, texture);
    }
    if (variant.covered) {
      bindOpacity(pipeline, commands, info, material);
    }
    // Other shaders do not ask which triangle they shade.
    const bool asksTriangle = variant.deferred || variant.asks || variant.added || variant.covered || variant.repeating;
    for (const IndexRange& range : drawnRanges(mesh.parts[p], batch)) {
      constants.firstTriangle = asksTriangle ? range.first / 3 : 0;
      if (variant.added) {
        pipeline.push(commands, gpu::ReflectionConstants{constants, DeferredShading::areaOf(scope.desc())});
      } else if (variant.covered) {
        pipeline.push(commands, coverageConstants(constants, material));
      } else if (const auto bytes = std::bit_cast<Bound::Constants>(constants); bound.constants != bytes) {
        pipeline.push(commands, constants);
        bound.constants = bytes;
      }
      drawBatch(commands, info, batch, range);
      ++draws;
      countDraw(info.ledger, variant);
      info.ledger.draw(EffectKind::textures, textured);
      info.ledger.draw(EffectKind::wireframe, info.settings.view.wireframe);
    }
  }
  scope.endLabel();
  return draws;
}

void RenderSystem::countPipelines(EffectLedger& ledger) const {
  objects_.forEach([&](const Variant& variant) {
    ledger.pipeline(EffectKind::shadows, variant.trace.shadows || variant.shadowed);
    ledger.pipeline(EffectKind::castsLight, variant.trace.castsLight);
    ledger.pipeline(EffectKind::curved, variant.curved);
    ledger.pipeline(EffectKind::wireframe, variant.wireframe);
    ledger.pipeline(EffectKind::transparency, variant.covered || variant.trace.transparency);
    ledger.pipeline(EffectKind::textures, variant.diffuseLookup != gpu::textureNone);
    ledger.pipeline(EffectKind::toneMap, variant.format.encoding == gpu::encodingAces);
  });
}

void RenderSystem::endFrame(const TraceVariant& trace, bool shadowMaps, bool imagesShown, bool curved, bool textured,
                            bool transparent) {
  objects_.endFrame([&](const Variant& variant) {
    const bool stays = imagesShown && variant.trace == trace && (curved || !variant.curved);
    return (!stays && (variant.curved || variant.trace.traced)) || (!shadowMaps && variant.shadowed) ||
           (!transparent && variant.covered) || (!textured && variant.diffuseLookup != gpu::textureNone);
  });
}

uint32_t RenderSystem::recordSky(const PassScope& scope, const FrameInfo& info, const DrawList& pass) {
  const PassFormat format = formatOf(scope.desc(), info.settings);
  const Pipeline& pipeline = skies_.get(format, [&] {
    return format.describe({.name = "sky",
                            .vert = "full_screen.vert",
                            .frag = "sky.frag",
                            .setLayouts = {frameLayout_},
                            .depthWrite = false,
                            .depthCompare = VK_COMPARE_OP_GREATER_OR_EQUAL});
  });
  info.data.bind(pipeline, scope.commands(), pass);
  vkCmdDraw(scope.commands(), 3, 1, 0, 0);
  return 1;
}

RenderSystem::Variant RenderSystem::variantOf(const PassScope& scope, const FrameInfo& info, const DrawList& pass) {
  const ClipMethod clip = info.settings.reflection.clip;
  return {.format = formatOf(scope.desc(), info.settings),
          .clipDistance = pass.mirrorView && clip == ClipMethod::clipDistance,
          .clampDepth = !(pass.mirrorView && clip == ClipMethod::oblique),
          .wireframe = info.settings.view.wireframe && !scope.drawsEither(),
          .handed = info.data.handsOn()};
}

uint32_t RenderSystem::record(const PassScope& scope, const FrameInfo& info, const DrawList& pass) {
  Variant variant = variantOf(scope, info, pass);
  Bound bound;
  uint32_t draws = 0;
  for (const Batch& batch : pass.batches) {
    variant.deferred = defers(info, batch) && !asks(info, batch);
    draws += recordBatch(scope, info, pass, batch, variant, bound);
  }
  scope.cull(VK_CULL_MODE_NONE);
  const bool encodes = variant.format.encoding != gpu::encodingNone;
  const bool drawsBackground = info.environment.sky || (encodes && !info.encodedBackground);
  return draws + (drawsBackground ? recordSky(scope, info, pass) : 0);
}

uint32_t RenderSystem::recordReflections(const PassScope& scope, const FrameInfo& info, const DrawList& pass,
                                         const DeferredShading& shading) {
  Variant variant = variantOf(scope, info, pass);
  variant.added = true;
  Bound bound;
  uint32_t draws = 0;
  for (const Batch& batch : pass.batches) {
    if (batch.environment && defers(info, batch)) {
      draws += recordBatch(scope, info, pass, batch, variant, bound, &shading);
    }
  }
  scope.cull(VK_CULL_MODE_NONE);
  return draws;
}

}  // namespace speculum
