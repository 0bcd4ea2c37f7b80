#pragma once

#include "core/descriptors.hpp"
#include "core/pass.hpp"
#include "core/pipeline.hpp"
#include "core/renderer.hpp"
#include "systems/pipeline_variants.hpp"

namespace speculum {

// Depth of the pass that the debug view shows. Other passes share depth images, so this one gets an image of its own.
// Nothing exists on the GPU before prepare() and after release().
class WatchedDepth {
 public:
  WatchedDepth(Renderer& renderer, VkDescriptorSetLayout displayLayout);

  // Makes the pass, which has not begun, write its depth here.
  void prepare(PassDesc& pass, RetireQueue& retired);
  // Makes the depth readable; call it after the pass.
  void finish(VkCommandBuffer commands);
  void release(RetireQueue& retired);

  bool exists() const { return static_cast<bool>(image_); }
  Image& image() { return image_; }
  VkDescriptorImageInfo descriptor() const { return image_.descriptor(sampler_.get()); }
  // Pipeline that draws the depth with display_depth.glsl.
  const Pipeline& pipeline();
  size_t pipelineCount() const { return pipelines_.size(); }

 private:
  Renderer& renderer_;
  VkDescriptorSetLayout displayLayout_;
  Image image_;
  SamplerHandle sampler_;
  PipelineVariants<bool> pipelines_;  // for an image with several samples, or with one
};

}  // namespace speculum
