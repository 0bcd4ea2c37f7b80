#pragma once

#include <span>

#include "systems/frame_data.hpp"
#include "systems/pipeline_variants.hpp"

namespace speculum {

// Shades the surfaces whose shading needs rays. A pass draws their identifiers (shaders/identifiers.glsl) in the place
// of radiance and pauses; a compute shader then traces rays for the surfaces that the pass's samples see, and none for
// hidden ones; the pass goes on with the radiance. GPUs have more room for rays in compute shaders than in fragment
// shaders.
class DeferredShading {
 public:
  DeferredShading(Device& device, PipelineFactory& factory, VkDescriptorSetLayout frameLayout)
      : device_(device), frameLayout_(frameLayout), collecting_(factory), shading_(factory), drawing_(factory) {}

  // Divides parts of a pass, in pixels, into bands that are small enough for their radiance to fit into a storage
  // buffer of any device. The lowest band of a part comes first.
  static std::vector<PixelRect> bands(std::span<const PixelRect> parts, VkSampleCountFlagBits samples);
  // Return the descriptions of the two renderings of `pass`: of identifiers, and of radiance.
  static PassDesc identifying(PassDesc pass);
  static PassDesc shaded(PassDesc pass);

  // Computes the radiance of the surfaces that the pass has identified. The scope must be paused.
  void shade(const PassScope& scope, const FrameInfo& info, const DrawList& pass);
  // Replaces the identifiers by the radiance. Call it after shade(), when the scope is resumed. Returns the number of
  // draws.
  uint32_t record(const PassScope& scope);

  // Descriptor set of the shaded samples, for shaders that include shaded.glsl, and the area of the pass that the
  // samples belong to.
  VkDescriptorSetLayout layout() const { return layout_; }
  VkDescriptorSet set() const { return set_; }
  static gpu::ShadeConstants areaOf(const PassDesc& pass);

  void countPipelines(EffectLedger& ledger) const;
  // Drops pipelines and buffers that have not been used for idleFramesKept frames. While cached images are shown, the
  // pipelines for `trace` stay.
  void endFrame(const TraceVariant& trace, bool imagesShown, RetireQueue& retired);
  uint64_t bytes() const { return shaded_.bytes() + requests_.bytes(); }

 private:
  struct Variant {
    VkSampleCountFlagBits samples;
    TraceVariant trace;
    uint32_t textureFilter = gpu::textureBilinear;
    bool asksGroups = false;
    auto operator<=>(const Variant&) const = default;
  };
  void prepare(const FrameInfo& info, const PassDesc& pass);
  // Lists the surfaces in requests_, so that each invocation of the shading shader has one to shade.
  void collect(const PassScope& scope, const TraceVariant& trace);

  Device& device_;
  VkDescriptorSetLayout frameLayout_;
  VkDescriptorSetLayout layout_ = VK_NULL_HANDLE;
  SamplerHandle sampler_;
  PipelineVariants<Variant> collecting_;
  PipelineVariants<Variant> shading_;
  PipelineVariants<VkSampleCountFlagBits> drawing_;
  Buffer shaded_;                         // identifier, then radiance and disparity of each sample of a pass
  Buffer requests_;                       // surfaces to shade
  VkDescriptorSet set_ = VK_NULL_HANDLE;  // of the paused pass
  int idleFrames_ = 0;
};

}  // namespace speculum
