#pragma once

#include "systems/frame_info.hpp"
#include "systems/pipeline_variants.hpp"

namespace speculum {

// Keeps a mirror pass from shading what no lookup reads. A pass with a mask clears its depth to the nearest value, so
// that nothing passes the depth test; the mask, drawn first, opens its polygon with the farthest depth.
class MaskSystem {
 public:
  MaskSystem(PipelineFactory& factory, VkDescriptorSetLayout frameLayout)
      : frameLayout_(frameLayout), pipelines_(factory) {}

  // Value that a pass clears its depth to.
  static float clearDepth(const DrawList& pass) { return pass.maskVertexCount > 0 ? 1.0f : 0.0f; }
  uint32_t record(const PassScope& scope, const FrameInfo& info, const DrawList& pass);

 private:
  VkDescriptorSetLayout frameLayout_;
  PipelineVariants<VkSampleCountFlagBits> pipelines_;
};

}  // namespace speculum
