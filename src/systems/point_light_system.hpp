#pragma once

#include "systems/frame_data.hpp"
#include "systems/pipeline_variants.hpp"

namespace speculum {

// Draws the glyphs of point lights: spheres by ray casting in the fragment shader, with the depth of the hit. One
// invocation per sample where the device can, so that their outlines are as smooth as those of triangles.
class PointLightSystem {
 public:
  PointLightSystem(PipelineFactory& factory, VkDescriptorSetLayout frameLayout)
      : frameLayout_(frameLayout), pipelines_(factory) {}

  // Returns the number of draws.
  uint32_t record(const PassScope& scope, const FrameInfo& info, const DrawList& pass);
  // Drops pipelines that have not been used for idleFramesKept frames, unless `stays`: while cached images show glyphs.
  void endFrame(bool stays) {
    pipelines_.endFrame([&](const PassFormat&) { return !stays; });
  }
  size_t pipelineCount() const { return pipelines_.size(); }

 private:
  VkDescriptorSetLayout frameLayout_;
  PipelineVariants<PassFormat> pipelines_;
};

}  // namespace speculum
