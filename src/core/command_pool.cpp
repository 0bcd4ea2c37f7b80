#include "core/command_pool.hpp"

namespace speculum {

CommandPool::CommandPool(Device& device, const std::string& name)
    : device_(device),
      pool_(device.create(vkCreateCommandPool,
                          {.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                           .flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT,
                           .queueFamilyIndex = device.queueFamily()},
                          name)) {
  const VkCommandBufferAllocateInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                         .commandPool = pool_.get(),
                                         .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                         .commandBufferCount = 1};
  check(vkAllocateCommandBuffers(device.get(), &info, &commands_), "allocate the command buffer of " + name);
  device.setName(commands_, name);
}

VkCommandBuffer CommandPool::begin() {
  check(vkResetCommandPool(device_.get(), pool_.get(), 0), "reset a command pool");
  const VkCommandBufferBeginInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                      .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
  check(vkBeginCommandBuffer(commands_, &info), "begin to record commands");
  return commands_;
}

}  // namespace speculum
