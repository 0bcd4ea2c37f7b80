#include "core/memory.hpp"

namespace speculum {

Memory::Memory(Device& device, const VkMemoryRequirements& requirements, VkMemoryPropertyFlags wanted,
               const std::string& name, bool addressed) {
  VkPhysicalDeviceMemoryProperties types{};
  vkGetPhysicalDeviceMemoryProperties(device.physical(), &types);
  uint32_t type = 0;
  while (type < types.memoryTypeCount && (!(requirements.memoryTypeBits & (1u << type)) ||
                                          (types.memoryTypes[type].propertyFlags & wanted) != wanted)) {
    ++type;
  }
  if (type == types.memoryTypeCount) {
    throw std::runtime_error("the GPU has no memory of the kind that " + name + " needs");
  }
  // Some are left for the panels.
  const uint32_t most = device.limits().maxMemoryAllocationCount;
  if (device.allocations_ + 16 >= most) {
    throw OutOfMemoryError("allocate memory for " + name + ": the device takes " + std::to_string(most) +
                           " allocations (fewer textures, or a lower reflection.max_passes)");
  }
  const VkMemoryAllocateFlagsInfo flags{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO,
                                        .flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT};
  const VkMemoryAllocateInfo info{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                  .pNext = addressed ? &flags : nullptr,
                                  .allocationSize = requirements.size,
                                  .memoryTypeIndex = type};
  VkDeviceMemory memory = VK_NULL_HANDLE;
  check(vkAllocateMemory(device.get(), &info, nullptr, &memory),
        "allocate " + std::to_string(requirements.size) + " bytes for " + name);
  memory_ = {device.get(), memory};
  device.setName(memory, name);
  device.allocatedBytes_ += requirements.size;
  ++device.allocations_;
  counted_ = {&device, Uncount{requirements.size}};
}

}  // namespace speculum
