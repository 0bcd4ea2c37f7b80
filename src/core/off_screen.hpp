#pragma once

#include <string>

#include "core/image.hpp"
#include "core/pass.hpp"
#include "core/retire_queue.hpp"

namespace speculum {

// One depth image that several OffScreen targets use in turn; as large as the largest of them.
class SharedDepth {
 public:
  SharedDepth(Device& device, VkSampleCountFlagBits samples, const std::string& name)
      : device_(&device), samples_(samples), name_(name) {}

  // Grows to cover `extent`; the old image is retired. Never shrinks: see trim.
  void require(VkExtent2D extent, RetireQueue& retired);
  // Makes the image exactly `extent`, or none for 0x0.
  void trim(VkExtent2D extent, RetireQueue& retired);

  VkSampleCountFlagBits samples() const { return samples_; }
  VkExtent2D extent() const { return extent_; }
  uint64_t bytes() const { return image_.bytes(); }
  Image* image() { return image_ ? &image_ : nullptr; }

 private:
  Device* device_;
  VkSampleCountFlagBits samples_;
  std::string name_;
  VkExtent2D extent_{0, 0};
  Image image_;
};

struct OffScreenDesc {
  std::string name;
  VkExtent2D extent{1, 1};
  VkFormat format = colorFormat;
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
  bool multisampledOutput = false;  // the output keeps all samples; else it is resolved to one
  bool readSamples = false;         // shaders can read the resolved samples too, if the pass stores them
  bool color = true;                // else the color images are empty, and there is no descriptor
  bool depth = true;
  TargetRole role = TargetRole::offscreen;
  SharedDepth* shared = nullptr;  // outlives the target; its sample count replaces `samples`
};

// A render target that is sampled later. The output is a color image with one sample, resolved to one, or with all
// samples. The depth is the target's own or shared.
class OffScreen {
 public:
  OffScreen(Device& device, const OffScreenDesc& desc, RetireQueue& retired);

  // Makes the images anew, without their content. Does nothing if the extent is the present one.
  void resize(VkExtent2D extent, RetireQueue& retired);

  const OffScreenDesc& desc() const { return desc_; }
  VkExtent2D extent() const { return desc_.extent; }
  VkSampleCountFlagBits samples() const { return desc_.samples; }
  uint64_t bytes() const { return color_.bytes() + samples_.bytes() + depth_.bytes(); }  // without shared depth
  Image& color() { return color_; }
  // The image that is resolved to color(), or null. Its descriptor is for shaders that read samples.
  Image* samplesImage() { return samples_ ? &samples_ : nullptr; }
  VkDescriptorImageInfo samplesDescriptor() const { return samples_.descriptor(sampler_.get()); }
  PassTargets targets();
  // Returns targets with `depth` in the place of the target's depth. `depth` must have as many samples, and grows to
  // cover the target.
  PassTargets targets(SharedDepth& depth, RetireQueue& retired);
  VkDescriptorImageInfo descriptor() const { return color_.descriptor(sampler_.get()); }

 private:
  void create(RetireQueue& retired);
  void retire(RetireQueue& retired);  // all images and the sampler

  Device* device_;
  OffScreenDesc desc_;
  SamplerHandle sampler_;
  Image color_;    // the output
  Image samples_;  // multisampled; resolved to color_
  Image depth_;
};

}  // namespace speculum
