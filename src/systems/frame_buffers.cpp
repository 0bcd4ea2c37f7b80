#include "systems/frame_buffers.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace speculum {

FrameBuffers::FrameBuffers(Device& device, std::span<const char* const> names, std::string advice, bool texels)
    : device_(device),
      names_(names),
      advice_(std::move(advice)),
      texels_(texels),
      buffers_(framesInFlight * names.size()) {}

void FrameBuffers::checkSize(size_t kind, uint64_t bytes) const {
  if (bytes > largest()) {
    throw std::runtime_error("a frame has " + std::to_string(bytes >> 20) + " MiB of " + names_[kind] +
                             ", the device takes " + std::to_string(largest() >> 20) + " (" + advice_ + ")");
  }
}

void FrameBuffers::write(const Frame& frame, size_t kind, std::span<const std::byte> data) {
  checkSize(kind, data.size());
  Buffer& buffer = buffers_[indexOf(frame, kind)];
  if (!buffer || buffer.bytes() < data.size()) {
    const VkBufferUsageFlags other = texels_ ? VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT
                                             : VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_VERTEX_BUFFER_BIT;
    buffer = Buffer(device_, std::min<uint64_t>(data.size() + data.size() / 2, largest()),
                    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | other, BufferMemory::host, names_[kind]);
  }
  buffer.write(data);
}

void FrameBuffers::retire(RetireQueue& retired) {
  for (Buffer& buffer : buffers_) {
    retired.take(buffer);
  }
}

}  // namespace speculum
