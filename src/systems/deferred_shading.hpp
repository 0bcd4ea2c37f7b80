#pragma once

#include <span>

#include "systems/frame_info.hpp"
#include "systems/pipeline_variants.hpp"

namespace speculum {

// Shades the surfaces whose shading needs rays. A pass draws their identifiers (shaders/identifiers.glsl) in the place
// of radiance and pauses; a compute shader then traces rays for what the pass's samples see, and no rays for what they
// do not; the pass goes on with the radiance. GPUs have more room for rays in compute shaders than in fragment shaders.
class DeferredShading {
 public:
  DeferredShading(Device& device, PipelineFactory& factory, VkDescriptorSetLayout frameLayout)
      : device_(device), frameLayout_(frameLayout), collecting_(factory), shading_(factory), drawing_(factory) {}

  // Divides parts of a pass into bands whose radiance a storage buffer holds on every device, each part's lowest first.
  static std::vector<PixelRect> bands(std::span<const PixelRect> parts, VkSampleCountFlagBits samples);
  // Descriptions of the two renderings of a pass that is described by `pass`.
  static PassDesc identifying(PassDesc pass);
  static PassDesc shaded(PassDesc pass);

  // Computes the radiance of the surfaces that the pass has identified. The scope is paused.
  void shade(const PassScope& scope, const FrameInfo& info, const DrawList& pass);
  // Replaces the identifiers by the radiance. The scope was resumed after shade(). Returns the number of draws.
  uint32_t record(const PassScope& scope);

  // The samples, for shaders that include shaded.glsl, and the area of the pass that they belong to.
  VkDescriptorSetLayout layout() const { return layout_.get(); }
  VkDescriptorSet set() const { return set_; }
  static gpu::ShadeConstants areaOf(const PassDesc& pass);

  void countPipelines(EffectLedger& ledger) const;
  // Drops what has not been used for some frames. While cached images are shown, the pipelines stay.
  void endFrame(const TraceVariant& trace, bool imagesShown, RetireQueue& retired);
  uint64_t bytes() const { return shaded_.bytes() + requests_.bytes(); }

 private:
  struct Variant {
    VkSampleCountFlagBits samples;
    TraceVariant trace;
    bool trilinear = false;  // textures
    auto operator<=>(const Variant&) const = default;
  };
  void prepare(const FrameInfo& info, const PassDesc& pass);
  // Lists the surfaces in requests_, so that no invocation is without one to shade.
  void collect(const PassScope& scope, const TraceVariant& trace);

  Device& device_;
  VkDescriptorSetLayout frameLayout_;
  DescriptorSetLayoutHandle layout_;
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
