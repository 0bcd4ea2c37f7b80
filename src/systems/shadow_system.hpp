#pragma once

#include <memory>

#include "core/off_screen.hpp"
#include "systems/frame_data.hpp"
#include "systems/pass_log.hpp"
#include "systems/pipeline_variants.hpp"

namespace speculum {

// Renders shadow maps, all in one target, and binds them for shaders that look them up (shadow_map.glsl). A face of a
// map may be drawn over a layer, which holds the casters that stand still and is kept. Nothing exists before a frame
// has a map, and all is released some frames after the last one.
class ShadowSystem {
 public:
  ShadowSystem(Device& device, PipelineFactory& factory, VkDescriptorSetLayout frameLayout);

  // Makes the target of the plan's maps; call it before anything of the frame is recorded.
  void prepare(Frame& frame, const FramePlan& plan);
  // Records a face and before it, if the plan draws it too, the face's layer. The layer is a pass of its own for the
  // GPU's timings; the draws returned are those of both. `index` is that of the face in plan.passes.
  RecordedPass record(Renderer& renderer, const FrameInfo& info, size_t index);
  void endFrame(const FramePlan& plan, RetireQueue& retired);

  // Descriptor set 2 of pipelines that look maps up, and its layout. The set is null in a frame without maps.
  VkDescriptorSetLayout layout() const { return layout_; }
  VkDescriptorSet set() const { return set_; }
  // Value of onlyShadowFace in shadow_map.glsl. It stays the same as long as no light or object moves into another
  // face.
  uint32_t onlyFace() const { return onlyFace_; }
  uint64_t bytes() const;
  size_t pipelineCount() const { return pipelines_.size(); }

 private:
  enum class Drawn { objects, covered, mirrors, layer, edges, coveredEdges, mirrorEdges };
  struct Variant {
    Drawn drawn;
    bool clamps = false;       // of `covered`: the material's textures do
    bool vertexAlpha = false;  // of `covered`: the mesh's colors have alpha
    auto operator<=>(const Variant&) const = default;
  };
  const Pipeline& pipelineFor(const Variant& variant, const FrameInfo& info);
  // Draws marks of the edges of what draw() has drawn, for lookups that ask (shadow_edge.frag).
  uint32_t drawEdges(const PassScope& scope, const FrameInfo& info, const DrawList& data);
  uint32_t drawParts(const PassScope& scope, const FrameInfo& info, const DrawList& data, const Batch& batch);
  // Targets of the faces' layers. A layer lies where its face lies in target_, and uses the depth of target_.
  PassTargets layerTargets();
  // Draws pass `pass` of info.data: a face, with `overLayer` over its layer, or a layer. Returns the number of draws.
  uint32_t draw(const PassScope& scope, const FrameInfo& info, size_t pass, bool overLayer);
  void create();
  void prepareLayers(Frame& frame, const FramePlan& plan);
  void release(RetireQueue& retired);

  Device& device_;
  VkDescriptorSetLayout frameLayout_;
  VkDescriptorSetLayout layout_ = VK_NULL_HANDLE;
  SamplerHandle sampler_;
  FrameBuffers buffers_;
  PipelineVariants<Variant> pipelines_;
  std::unique_ptr<OffScreen> target_;
  std::unique_ptr<OffScreen> layers_;  // null without a layer
  VkDescriptorSet set_ = VK_NULL_HANDLE;
  VkDescriptorSet layerSet_ = VK_NULL_HANDLE;
  uint32_t onlyFace_ = gpu::anyShadowFace;
  int idleFrames_ = 0;
  bool covered_ = false;  // this frame has drawn coverage
};

}  // namespace speculum
