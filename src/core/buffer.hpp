#pragma once

#include <numeric>
#include <span>

#include "core/device.hpp"

namespace speculum {

enum class BufferMemory {
  host,    // mapped and coherent, for the CPU to write or read
  device,  // filled once through Uploader
};

// Upper bound of the bytes of a buffer that shaders read as storage or as texels.
VkDeviceSize largestShaderBuffer(const Device& device);

// A buffer with its memory; construction throws as Memory's does. `bytes` 0 is allowed and becomes 4, or 16 for
// texels: Vulkan has no empty buffers.
class Buffer {
 public:
  Buffer() = default;
  Buffer(Device& device, VkDeviceSize bytes, VkBufferUsageFlags usage, BufferMemory memory, const std::string& name);

  VkBuffer get() const { return buffer_.get(); }
  VkDeviceSize bytes() const { return bytes_; }
  explicit operator bool() const { return static_cast<bool>(buffer_); }
  std::byte* mapped() const { return memory_.mapped(); }  // null in BufferMemory::device
  VkDeviceAddress address() const { return address_; }    // 0 without VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT
  VkDescriptorBufferInfo descriptor() const { return {buffer_.get(), 0, VK_WHOLE_SIZE}; }
  // Texels of four 32-bit integers; null without VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT.
  VkBufferView texels() const { return texels_.get(); }

  // Writes into a host buffer. Throws std::out_of_range past its end.
  void write(std::span<const std::byte> data, VkDeviceSize offset = 0) const;

 private:
  Memory memory_;
  BufferHandle buffer_;
  BufferViewHandle texels_;
  VkDeviceSize bytes_ = 0;
  VkDeviceAddress address_ = 0;
};

inline uint64_t bytesOf(std::span<const Buffer> buffers) {
  return std::accumulate(buffers.begin(), buffers.end(), uint64_t{0},
                         [](uint64_t sum, const Buffer& buffer) { return sum + buffer.bytes(); });
}

}  // namespace speculum
