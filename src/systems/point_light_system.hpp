#pragma once

#include <map>
#include <memory>

#include "systems/frame_info.hpp"

namespace speculum {

// Draws the glyphs of point lights: spheres by ray casting in the fragment shader, with the depth of the hit. One
// invocation per sample where the device can, so that their outlines are as smooth as those of triangles.
class PointLightSystem {
 public:
  PointLightSystem(PipelineFactory& factory, VkDescriptorSetLayout frameLayout);

  uint32_t record(const PassScope& scope, const FrameInfo& info, size_t pass, const PassFormat& format);
  size_t pipelineCount() const { return pipelines_.size(); }

 private:
  PipelineFactory& factory_;
  VkDescriptorSetLayout frameLayout_;
  std::map<VkSampleCountFlagBits, std::unique_ptr<Pipeline>> pipelines_;
};

}  // namespace speculum
