#pragma once

#include <array>
#include <vector>

#include "core/renderer.hpp"

namespace speculum::examples {

// Uniform buffers and descriptor sets of views: binding 0 is a buffer with a View, binding 1 an image that fragments
// look up. Each frame in flight has buffers of its own, because the GPU may still read those of the other one. A set
// lives for one frame.
template <typename View>
class ViewSets {
 public:
  explicit ViewSets(Renderer& renderer)
      : device_(renderer.device()),
        layout_(descriptorSetLayout(device_,
                                    {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER},
                                    VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, "view")),
        none_(renderer.uploader().image(std::array<std::byte, 4>{}, {1, 1}, VK_FORMAT_R8G8B8A8_UNORM, false, "none")),
        sampler_(createSampler(device_, nearestSampler, "none")) {}

  VkDescriptorSetLayout layout() const { return layout_; }

  // Copies `view` into a buffer of the frame, and returns a set of that buffer and `image`.
  VkDescriptorSet write(Frame& frame, const View& view, const OffScreen* image = nullptr) {
    used_ = frame.number == number_ ? used_ + 1 : 0;
    number_ = frame.number;
    std::vector<Buffer>& buffers = buffers_[frame.index];
    if (used_ == buffers.size()) {
      buffers.emplace_back(device_, sizeof(View), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, BufferMemory::host, "view");
    }
    buffers[used_].write(std::as_bytes(std::span(&view, 1)));
    const VkDescriptorSet set = frame.descriptors->allocate(layout_);
    DescriptorWriter()
        .buffer(0, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, buffers[used_].descriptor())
        .image(1, image ? image->descriptor() : none_.descriptor(sampler_.get()))
        .update(device_, set);
    return set;
  }

 private:
  Device& device_;
  VkDescriptorSetLayout layout_ = VK_NULL_HANDLE;
  Image none_;  // for shaders that look up no image: lavapipe of Mesa 22.3 reads all descriptors of a set
  SamplerHandle sampler_;
  std::array<std::vector<Buffer>, framesInFlight> buffers_;
  uint64_t number_ = 0;  // of the frame written to last
  size_t used_ = 0;      // index of the buffer written last
};

}  // namespace speculum::examples
