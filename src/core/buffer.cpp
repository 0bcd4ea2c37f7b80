#include "core/buffer.hpp"

#include <algorithm>
#include <cstring>
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
  memory_ = Memory(device, buffer_.get(), memory == BufferMemory::host,
                   (usage & VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT) != 0, name);
  if (usage & VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT) {
    texels_ = device.create(vkCreateBufferView,
                            {.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO,
                             .buffer = buffer_.get(),
                             .format = VK_FORMAT_R32G32B32A32_UINT,
                             .range = VK_WHOLE_SIZE},
                            name);
  }
  if (usage & VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT) {
    const VkBufferDeviceAddressInfo info{.sType = VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO,
                                         .buffer = buffer_.get()};
    address_ = vkGetBufferDeviceAddress(device.get(), &info);
  }
}

void Buffer::write(std::span<const std::byte> data, VkDeviceSize offset) const {
  if (!mapped() || offset + data.size() > bytes_) {
    throw std::out_of_range("a write of " + std::to_string(data.size()) + " bytes at " + std::to_string(offset) +
                            " does not fit into a mapped buffer of " + std::to_string(mapped() ? bytes_ : 0));
  }
  if (!data.empty()) {
    std::memcpy(mapped() + offset, data.data(), data.size());
  }
}

}  // namespace speculum
