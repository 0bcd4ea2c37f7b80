#pragma once

#include "core/descriptors.hpp"
#include "core/pass.hpp"
#include "core/pipeline.hpp"
#include "core/renderer.hpp"
#include "systems/pipeline_variants.hpp"

namespace speculum {

// Depth of the pass that the debug view shows. Other passes share depth images, so this one gets an image of its own,
// and a second one while several frames draw it: the first is shown until they end. Nothing exists on the GPU before
// prepare() and after release().
class WatchedDepth {
 public:
  WatchedDepth(Renderer& renderer, VkDescriptorSetLayout displayLayout);

  // Makes the pass, which has not begun, write its depth here. `divided`: several frames draw it.
  void prepare(PassDesc& pass, bool divided, RetireQueue& retired);
  // Makes the depth readable; call it after the whole pass.
  void finish(VkCommandBuffer commands, RetireQueue& retired);
  void release(RetireQueue& retired);

  bool exists() const { return static_cast<bool>(image_); }
  Image& image() { return image_; }
  VkDescriptorImageInfo descriptor() const { return image_.descriptor(sampler_.get()); }
  // Pipeline that draws the depth with display_depth.glsl.
  const Pipeline& pipeline();
  size_t pipelineCount() const { return pipelines_.size(); }

 private:
  static void drop(Image& image, RetireQueue& retired);

  Renderer& renderer_;
  VkDescriptorSetLayout displayLayout_;
  Image image_;
  Image next_;  // unfinished
  SamplerHandle sampler_;
  PipelineVariants<bool> pipelines_;  // for an image with several samples, or with one
};

}  // namespace speculum
