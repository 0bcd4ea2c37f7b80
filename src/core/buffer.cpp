#include "core/buffer.hpp"

#include <algorithm>
#include <stdexcept>

namespace speculum {

namespace {

constexpr VkDeviceSize texelBytes = 16;

}  // namespace

VkDeviceSize largestShaderBuffer(const Device& device) {
  return std::min<VkDeviceSize>(device.limits().maxStorageBufferRange,
                                texelBytes * device.limits().maxTexelBufferElements);
}

Buffer::Buffer(Device& device, VkDeviceSize bytes, VkBufferUsageFlags usage, BufferMemory memory,
               const std::string& name)
    : bytes_(std::max<VkDeviceSize>(bytes, usage & VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT ? texelBytes : 4)) {
  buffer_ = device.create(vkCreateBuffer,
                          {.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
                           .size = bytes_,
                           .usage = usage,
                           .sharingMode = VK_SHARING_MODE_EXCLUSIVE},
                          name);
  VkMemoryRequirements requirements{};
  vkGetBufferMemoryRequirements(device.get(), buffer_.get(), &requirements);
  const VkMemoryPropertyFlags properties =
      memory == BufferMemory::host ? VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT
                                   : VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
  memory_ = Memory(device, requirements, properties, name, (usage & VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT) != 0);
  check(vkBindBufferMemory(device.get(), buffer_.get(), memory_.get(), 0), "bind the memory of " + name);
  if (usage & VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT) {
    texels_ = device.create(vkCreateBufferView,
                            {.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO,
                             .buffer = buffer_.get(),
                             .format = VK_FORMAT_R32G32B32A32_UINT,
                             .range = VK_WHOLE_SIZE},
                            name);
  }
  if (memory == BufferMemory::host) {
    void* data = nullptr;
    check(vkMapMemory(device.get(), memory_.get(), 0, VK_WHOLE_SIZE, 0, &data), "map the memory of " + name);
    mapped_ = static_cast<std::byte*>(data);
  }
  if (usage & VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT) {
    const VkBufferDeviceAddressInfo info{.sType = VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO,
                                         .buffer = buffer_.get()};
    address_ = vkGetBufferDeviceAddress(device.get(), &info);
  }
}

void Buffer::write(std::span<const std::byte> data, VkDeviceSize offset) const {
  if (!mapped_ || offset + data.size() > bytes_) {
    throw std::out_of_range("a write of " + std::to_string(data.size()) + " bytes at " + std::to_string(offset) +
                            " does not fit into a mapped buffer of " + std::to_string(mapped_ ? bytes_ : 0));
  }
  if (!data.empty()) {
    std::memcpy(mapped_ + offset, data.data(), data.size());
  }
}

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
  // Leaves some allocations for the panels.
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
