#include <algorithm>
#include <stdexcept>

#include "core/device.hpp"

namespace speculum {

Memory Device::allocate(const VkMemoryRequirements& requirements, VkMemoryPropertyFlags wanted, std::string_view name) {
  for (uint32_t type = 0; type < memoryProperties_.memoryTypeCount; ++type) {
    const VkMemoryPropertyFlags properties = memoryProperties_.memoryTypes[type].propertyFlags;
    if (!(requirements.memoryTypeBits & (1u << type)) || (properties & wanted) != wanted) {
      continue;
    }
    const VkMemoryAllocateInfo info{
        .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, .allocationSize = requirements.size, .memoryTypeIndex = type};
    VkDeviceMemory memory = VK_NULL_HANDLE;
    check(vkAllocateMemory(device_.get(), &info, nullptr, &memory),
          "allocate " + std::to_string(requirements.size) + " bytes for " + std::string(name));
    MemoryHandle handle(device_.get(), memory);
    setName(memory, name);
    return Memory(*this, std::move(handle), requirements.size, properties);
  }
  throw std::runtime_error("the GPU has no memory of the kind that " + std::string(name) + " needs");
}

MemoryBudget Device::memoryBudget() const {
  VkPhysicalDeviceMemoryBudgetPropertiesEXT budget{.sType =
                                                       VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_BUDGET_PROPERTIES_EXT};
  VkPhysicalDeviceMemoryProperties2 properties{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_PROPERTIES_2,
                                               .pNext = caps_.memoryBudget ? &budget : nullptr};
  vkGetPhysicalDeviceMemoryProperties2(physical_, &properties);
  MemoryBudget result{.usedBytes = caps_.memoryBudget ? 0 : allocatedBytes()};
  for (uint32_t heap = 0; heap < properties.memoryProperties.memoryHeapCount; ++heap) {
    const VkMemoryHeap& description = properties.memoryProperties.memoryHeaps[heap];
    if (description.flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) {
      result.budgetBytes += caps_.memoryBudget ? budget.heapBudget[heap] : description.size;
      result.usedBytes += caps_.memoryBudget ? budget.heapUsage[heap] : 0;
    }
  }
  return result;
}

Memory::Memory(Device& device, MemoryHandle memory, uint64_t bytes, VkMemoryPropertyFlags properties)
    : device_(&device), memory_(std::move(memory)), bytes_(bytes), properties_(properties) {
  device_->allocatedBytes_ += bytes_;
}

Memory::Memory(Memory&& other) noexcept {
  *this = std::move(other);
}

Memory& Memory::operator=(Memory&& other) noexcept {
  if (this != &other) {
    release();
    device_ = other.device_;
    memory_ = std::move(other.memory_);
    bytes_ = std::exchange(other.bytes_, 0);
    properties_ = other.properties_;
  }
  return *this;
}

Memory::~Memory() {
  release();
}

void Memory::release() {
  if (memory_) {
    device_->allocatedBytes_ -= bytes_;
    memory_.reset();
  }
}

}  // namespace speculum
