#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "systems/frame_data.hpp"
#include "systems/pipeline_variants.hpp"

namespace speculum {

class DeferredShading;

// Adds the vertex input of scene.vert: attributes of vertices and of instances.
void addVertexInput(GraphicsPipelineDesc& desc);
// Binds the batch's mesh and the frame's instances as the input of addVertexInput(). If the batch culls backs, they are
// culled until the next PassScope::cull(). Leaves out what `before`, the batch that was bound last in the pass, shares;
// null: none was.
void bindBatch(const PassScope& scope, const FrameInfo& info, const Batch& batch, const Batch* before);

// Makes the vertex input that of scene_colored.vert, for meshes whose colors have alpha or have none.
void addVertexColors(GraphicsPipelineDesc& desc, bool withAlpha);
// Binds the colors of the batch's mesh for it.
void bindColors(VkCommandBuffer commands, const FrameInfo& info, const Batch& batch);

// Draws these indices of the batch's mesh, which is bound.
void drawBatch(VkCommandBuffer commands, const FrameInfo& info, const Batch& batch, const IndexRange& range);
// Returns the indices of the part that the batch draws.
RecycledVector<IndexRange> drawnRanges(const MeshPart& part, const Batch& batch);
// Makes the description that of a pipeline for materials with coverage, whose fragment shader is `frag` and whose
// descriptor set 3 is the opacity texture.
void addCoverage(GraphicsPipelineDesc& desc, const std::string& frag, VkDescriptorSetLayout textureLayout);
// Binds the opacity texture of a material for such a pipeline.
void bindOpacity(const Pipeline& pipeline, VkCommandBuffer commands, const FrameInfo& info, const Material& material);
gpu::CoverageConstants coverageConstants(const gpu::DrawConstants& draw, const Material& material);

// Draws the scene's objects and, where nothing was drawn, its sky, or its background if the pass cannot be cleared with
// it.
class RenderSystem {
 public:
  RenderSystem(PipelineFactory& factory, VkDescriptorSetLayout frameLayout, VkDescriptorSetLayout textureLayout)
      : frameLayout_(frameLayout), textureLayout_(textureLayout), objects_(factory), skies_(factory) {}

  // Returns the number of draws. Objects whose shading needs rays are drawn as identifiers.
  uint32_t record(const PassScope& scope, const FrameInfo& info, const DrawList& pass);
  // Says whether record() draws identifiers in a pass.
  static bool defers(const FrameInfo& info, const DrawList& pass);
  // Adds what curved mirrors look up in environment maps to their bases, after deferred shading.
  uint32_t recordReflections(const PassScope& scope, const FrameInfo& info, const DrawList& pass,
                             const DeferredShading& shading);
  void countPipelines(EffectLedger& ledger) const;
  // Drops pipelines that have not been used for idleFramesKept frames and are for traced surfaces, curved mirrors,
  // shadow maps (unless `shadowMaps`), textures (unless `textured`, which is drawsTextures()) or coverage (unless
  // `transparent`, which is drawsTransparency()). While cached images are shown, the pipelines for `trace` stay, those
  // of curved mirrors only if `curved`.
  void endFrame(const TraceVariant& trace, bool shadowMaps, bool imagesShown, bool curved, bool textured,
                bool transparent);

 private:
  struct Variant {
    PassFormat format;
    bool clipDistance;
    bool clampDepth;
    bool wireframe;  // always false where the polygon mode is dynamic
    bool curved;
    bool environment;        // curved mirrors that look up an environment map
    uint32_t diffuseLookup;  // constants of scene_shading.glsl and shading.glsl
    bool glossy;
    uint32_t lightCount;
    TraceVariant trace;           // of deferred surfaces
    bool deferred = false;        // draws identifiers
    bool added = false;           // only the reflection, added to the base that DeferredShading has drawn
    bool repeating = false;       // draws RepeatingTriangles
    bool vertexColors = false;    // the shader takes those of the mesh
    bool vertexAlpha = false;     // the mesh's colors have alpha
    bool covered = false;         // the material has coverage
    bool handed = false;          // scene_handed.vert hands on values of the draw
    bool clamps = false;          // the material's textures do
    bool shadowed = false;        // looks shadows up in maps
    bool asks = false;            // and draws identifiers where these do not decide
    uint32_t shadowedLights = 0;  // constants of shadow_map.glsl
    uint32_t onlyShadowFace = gpu::anyShadowFace;
    auto operator<=>(const Variant&) const = default;
  };
  // State that the draws of a pass have bound so far. It is bound again only where it changes.
  struct Bound {
    const Batch* batch = nullptr;
    const Pipeline* pipeline = nullptr;
    Variant variant{};  // of the pipeline
    VkDescriptorSet texture = VK_NULL_HANDLE;
    using Constants = std::array<std::byte, sizeof(gpu::DrawConstants)>;
    std::optional<Constants> constants;
  };
  GraphicsPipelineDesc objects(const Variant& variant, const FrameInfo& info, const DeferredShading* shading) const;
  static bool asks(const FrameInfo& info, const Batch& batch);
  static bool defers(const FrameInfo& info, const Batch& batch);
  static void countDraw(EffectLedger& ledger, const Variant& variant);
  static Variant variantOf(const PassScope& scope, const FrameInfo& info, const DrawList& pass);
  uint32_t recordBatch(const PassScope& scope, const FrameInfo& info, const DrawList& pass, const Batch& batch,
                       Variant variant, Bound& bound, const DeferredShading* shading = nullptr);
  uint32_t recordSky(const PassScope& scope, const FrameInfo& info, const DrawList& pass);

  VkDescriptorSetLayout frameLayout_;
  VkDescriptorSetLayout textureLayout_;
  PipelineVariants<Variant> objects_;
  PipelineVariants<PassFormat> skies_;
};

}  // namespace speculum
