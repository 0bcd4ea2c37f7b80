#pragma once

#include <map>
#include <memory>

#include "systems/frame_info.hpp"

namespace speculum {

// Draws the mirrors of a pass: fronts sample the images that earlier passes rendered for them, fronts without an image
// show the background, backs their paint.
class MirrorSystem {
 public:
  MirrorSystem(Device& device, Uploader& uploader, PipelineFactory& factory, VkDescriptorSetLayout frameLayout);

  uint32_t record(const PassScope& scope, const FrameInfo& info, size_t pass, const PassFormat& format);
  size_t pipelineCount() const { return pipelines_.size(); }

 private:
  struct Variant {
    VkSampleCountFlagBits samples;
    bool clampDepth;
    auto operator<=>(const Variant&) const = default;
  };
  const Pipeline& pipeline(const Variant& variant);

  Device& device_;
  PipelineFactory& factory_;
  VkDescriptorSetLayout frameLayout_;
  DescriptorSetLayoutHandle imageLayout_;
  SamplerHandle sampler_;
  Image noImage_;  // bound where a mirror has none: every set that a shader names must be bound
  std::map<Variant, std::unique_ptr<Pipeline>> pipelines_;
};

}  // namespace speculum
