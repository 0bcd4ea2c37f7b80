#pragma once

#include <cstring>
#include <memory>
#include <span>

#include "core/device.hpp"

namespace speculum {

// One allocation of device memory, counted in Device::allocatedBytes(). Move-only.
class Memory {
 public:
  Memory() = default;
  // With `addressed`, buffers in this memory have device addresses. Throws OutOfMemoryError, or std::runtime_error if
  // the GPU has no memory with the wanted properties.
  Memory(Device& device, const VkMemoryRequirements& requirements, VkMemoryPropertyFlags wanted,
         const std::string& name, bool addressed = false);

  VkDeviceMemory get() const { return memory_.get(); }
  uint64_t bytes() const { return counted_ ? counted_.get_deleter().bytes : 0; }

 private:
  struct Uncount {
    uint64_t bytes;
    void operator()(Device* device) const {
      device->allocatedBytes_ -= bytes;
      --device->allocations_;
    }
  };
  MemoryHandle memory_;
  std::unique_ptr<Device, Uncount> counted_;
};

enum class BufferMemory {
  host,    // mapped and coherent, for the CPU to write or read
  device,  // filled once through Uploader
};

// Upper bound of the bytes of a buffer that shaders read as storage or as texels.
VkDeviceSize largestShaderBuffer(const Device& device);

// A buffer with memory of its own; construction throws as Memory's does. `bytes` 0 is allowed and becomes 4, or 16 for
// texels: Vulkan has no empty buffers.
class Buffer {
 public:
  Buffer() = default;
  Buffer(Device& device, VkDeviceSize bytes, VkBufferUsageFlags usage, BufferMemory memory, const std::string& name);

  VkBuffer get() const { return buffer_.get(); }
  VkDeviceSize bytes() const { return bytes_; }
  explicit operator bool() const { return static_cast<bool>(buffer_); }
  std::byte* mapped() const { return mapped_; }         // null in BufferMemory::device
  VkDeviceAddress address() const { return address_; }  // 0 without VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT
  VkDescriptorBufferInfo descriptor() const { return {buffer_.get(), 0, VK_WHOLE_SIZE}; }
  // Texels of four 32-bit integers; null without VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT.
  VkBufferView texels() const { return texels_.get(); }

  // Writes into a host buffer. Throws std::out_of_range past its end.
  void write(std::span<const std::byte> data, VkDeviceSize offset = 0) const;

 private:
  Memory memory_;  // freed after the buffer, and thereby unmapped
  BufferHandle buffer_;
  BufferViewHandle texels_;
  VkDeviceSize bytes_ = 0;
  std::byte* mapped_ = nullptr;
  VkDeviceAddress address_ = 0;
};

}  // namespace speculum
