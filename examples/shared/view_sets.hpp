#pragma once

#include <array>
#include <vector>

#include "core/renderer.hpp"

namespace speculum::examples {

// Tells shaders about passes: binding 0 is a uniform buffer with a View, binding 1 an image that fragments look up. The
// buffers belong to a frame in flight, because the GPU may still read those of the other one, and the sets live for one
// frame.
template <typename View>
class ViewSets {
 public:
  explicit ViewSets(Device& device)
      : device_(device),
        layout_(createDescriptorSetLayout(
            device, {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER},
            VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, "view")) {}

  VkDescriptorSetLayout layout() const { return layout_.get(); }

  // Only shaders that look up no image can do without `image`.
  VkDescriptorSet write(Frame& frame, const View& view, const OffScreen* image = nullptr) {
    used_ = frame.number == number_ ? used_ + 1 : 0;
    number_ = frame.number;
    std::vector<Buffer>& buffers = buffers_[frame.index];
    if (used_ == buffers.size()) {
      buffers.emplace_back(device_, sizeof(View), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, BufferMemory::host, "view");
    }
    buffers[used_].write(std::as_bytes(std::span(&view, 1)));
    const VkDescriptorSet set = frame.descriptors->allocate(layout_.get());
    DescriptorWriter writer;
    writer.buffer(0, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, buffers[used_].descriptor());
    if (image) {
      writer.image(1, image->descriptor());
    }
    writer.update(device_, set);
    return set;
  }

 private:
  Device& device_;
  DescriptorSetLayoutHandle layout_;
  std::array<std::vector<Buffer>, framesInFlight> buffers_;
  uint64_t number_ = 0;  // of the frame written to last
  size_t used_ = 0;      // index of the buffer written last
};

}  // namespace speculum::examples
