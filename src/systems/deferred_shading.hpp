#pragma once

#include "systems/frame_info.hpp"
#include "systems/pipeline_variants.hpp"

namespace speculum {

// Shades the surfaces whose light takes rays. A pass draws their identifiers (shaders/identifiers.glsl) in the place of
// radiance and pauses; a compute shader then traces rays for what the pass's samples see, and no rays for what they do
// not; the pass goes on with the radiance. GPUs have more room for rays in compute shaders than in fragment shaders.
class DeferredShading {
 public:
  DeferredShading(Device& device, PipelineFactory& factory, VkDescriptorSetLayout frameLayout);

  // Descriptions of the two renderings of a pass that is described by `pass`.
  static PassDesc identifying(PassDesc pass);
  static PassDesc shaded(PassDesc pass);

  // Computes the radiance of the surfaces that pass `pass` of info.data has identified. The scope is paused.
  void shade(const PassScope& scope, const FrameInfo& info, size_t pass);
  // Replaces the identifiers by the radiance. The scope was resumed after shade(). Returns the number of draws.
  uint32_t record(const PassScope& scope);

  void countPipelines(EffectLedger& ledger) const;
  // Drops what has not been used for some frames. While cached images are shown, the pipelines stay.
  void endFrame(const TraceVariant& trace, bool imagesShown, RetireQueue& retired);
  size_t pipelineCount() const { return shading_.size() + drawing_.size(); }
  uint64_t bytes() const { return shaded_.bytes(); }

 private:
  struct Variant {
    VkSampleCountFlagBits samples;
    bool trilinear;
    TraceVariant trace;
    auto operator<=>(const Variant&) const = default;
  };
  void prepare(const FrameInfo& info, const PassDesc& pass);

  Device& device_;
  VkDescriptorSetLayout frameLayout_;
  DescriptorSetLayoutHandle layout_;
  SamplerHandle sampler_;
  PipelineVariants<Variant> shading_;
  PipelineVariants<VkSampleCountFlagBits> drawing_;
  Buffer shaded_;                         // radiance and disparity of each sample of the largest pass
  VkDescriptorSet set_ = VK_NULL_HANDLE;  // of the paused pass
  int idleFrames_ = 0;
};

}  // namespace speculum
