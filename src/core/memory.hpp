#pragma once

#include <memory>

#include "core/device.hpp"

namespace speculum {

// One allocation of device memory, counted in Device::allocatedBytes(). Move-only.
class Memory {
 public:
  Memory() = default;
  // With `addressed`, buffers in it have device addresses. Throws OutOfMemoryError, or std::runtime_error if the GPU
  // has no memory with the wanted properties.
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

}  // namespace speculum
