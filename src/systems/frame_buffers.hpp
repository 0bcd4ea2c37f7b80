#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/renderer.hpp"

namespace speculum {

// Host buffers that the CPU writes every frame, for shaders and vertex attributes: one of each kind for each frame in
// flight. A buffer that is too small is replaced by one with room for half as much again.
class FrameBuffers {
 public:
  // `names` of the kinds have static lifetime. `advice` says how to make a scene's frames smaller. With `texels`,
  // shaders may read the buffers as texels too.
  FrameBuffers(Device& device, std::span<const char* const> names, std::string advice, bool texels = false);

  // Throws std::runtime_error with the advice if the device takes no buffer of that size, as write() does. Call it
  // before much memory is filled.
  void checkSize(size_t kind, uint64_t bytes) const;
  // Replaces the content of the frame's buffer of this kind.
  void write(const Frame& frame, size_t kind, std::span<const std::byte> data);
  template <typename T>
  void write(const Frame& frame, size_t kind, const std::vector<T>& data) {
    write(frame, kind, std::as_bytes(std::span(data)));
  }
  const Buffer& buffer(const Frame& frame, size_t kind) const { return buffers_[indexOf(frame, kind)]; }
  uint64_t bytes() const { return bytesOf(buffers_); }
  void retire(RetireQueue& retired);

 private:
  // Bytes of the largest buffer that the device takes.
  uint64_t largest() const { return texels_ ? largestShaderBuffer(device_) : device_.limits().maxStorageBufferRange; }
  size_t indexOf(const Frame& frame, size_t kind) const { return frame.index * names_.size() + kind; }

  Device& device_;
  std::span<const char* const> names_;
  std::string advice_;
  bool texels_;
  std::vector<Buffer> buffers_;
};

}  // namespace speculum
