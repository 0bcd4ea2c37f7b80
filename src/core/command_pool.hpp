#pragma once

#include "core/device.hpp"

namespace speculum {

// A command pool and its one primary command buffer, which records anew after each reset.
class CommandPool {
 public:
  CommandPool(Device& device, const std::string& name);

  // Empties the buffer and begins to record. The GPU has finished what was recorded before.
  VkCommandBuffer begin();

 private:
  Device& device_;
  CommandPoolHandle pool_;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
};

}  // namespace speculum
