#pragma once

#include <array>
#include <functional>
#include <optional>
#include <ranges>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "core/device.hpp"
#include "core/image.hpp"

namespace speculum {

// A command pool and its one primary command buffer, which begin() records anew.
class CommandPool {
 public:
  CommandPool(Device& device, const std::string& name);

  // Empties the command buffer and begins to record. The GPU must have finished the commands recorded before.
  VkCommandBuffer begin();

 private:
  Device& device_;
  CommandPoolHandle pool_;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
};

// Copies data to and from the GPU. All copies are finished on return, or on that of together(): for loading, not for
// every frame.
class Uploader {
 public:
  // Bytes of the staging buffer, and thereby of the largest piece that is copied at once.
  static constexpr VkDeviceSize stagingBytes = VkDeviceSize{4} << 20;

  explicit Uploader(Device& device);

  Device& device() const { return device_; }

  // Returns a device buffer that holds `data`; its usage gets TRANSFER_DST added.
  Buffer buffer(std::span<const std::byte> data, VkBufferUsageFlags usage, const std::string& name);
  Buffer buffer(const std::ranges::contiguous_range auto& data, VkBufferUsageFlags usage, const std::string& name) {
    // The span's type must not have the length of an array: such a span would call this template again.
    const std::span<const std::byte> bytes = std::as_bytes(std::span(data));
    return buffer(bytes, usage, name);
  }
  // Returns a sampled image of `texels` (tightly packed rows, top first), in SHADER_READ_ONLY layout. With `mipmaps`
  // all further levels follow, each half as wide and high, rounded down, but at least 1 texel: blits of devices may
  // round halves down. Throws std::logic_error if there are too few or too many texels.
  Image image(std::span<const std::byte> texels, VkExtent2D extent, VkFormat format, bool mipmaps,
              const std::string& name);

  // Returns what the device reads from each code of 8 bits in R8G8B8A8_SRGB: devices decode with different precision.
  std::array<float, 256> decodedSrgb();
  // Whether that is as precise as half floats; empty: nobody has looked yet.
  std::optional<bool> exactSrgb;
  // Returns the texels of level 0, tightly packed in the image's own format. The image keeps its layout.
  std::vector<std::byte> read(Image& image);
  // Returns r, g, b, a of each texel of level 0. Throws std::logic_error unless the format is RGBA16F or RGBA32F.
  std::vector<float> readFloats(Image& image);

  // Records with `record`, submits and waits. Throws as check() does.
  void run(const std::function<void(VkCommandBuffer)>& record);
  // Calls `work`, whose buffers and images are finished on return: they are copied together, a staging buffer at a
  // time. They must outlive this call, also if it throws; what is copied in `work` may not be read there by other means
  // than this uploader's.
  void together(const std::function<void()>& work);

 private:
  friend class BufferWriter;
  struct Staged {
    std::span<std::byte> bytes;  // to be written before the next call
    VkDeviceSize offset = 0;     // in the staging buffer
  };
  // Returns room in the staging buffer for `bytes` or, if there is less, for as many multiples of `unit` as fit. Their
  // copy is to be recorded in commands().
  Staged stage(VkDeviceSize bytes, VkDeviceSize unit);
  VkCommandBuffer commands();
  void submit();

  Device& device_;
  CommandPool pool_;
  FenceHandle fence_;
  Buffer staging_;                             // made for the first copy
  VkDeviceSize staged_ = 0;                    // bytes of staging_ that commands_ read
  VkCommandBuffer commands_ = VK_NULL_HANDLE;  // that are being recorded
  int nested_ = 0;                             // calls of together()
};

// Writes a device buffer from front to back, in pieces of the uploader's staging buffer, which nothing else may use
// meanwhile. All functions throw what Uploader::run() throws.
class BufferWriter {
 public:
  // `bytes`, which may be 0, and `usage` are those of a Buffer; TRANSFER_DST is added. Keeps a reference to the
  // uploader.
  BufferWriter(Uploader& uploader, VkDeviceSize bytes, VkBufferUsageFlags usage, const std::string& name);

  // Throws std::out_of_range past the buffer's end.
  void write(std::span<const std::byte> data);
  template <typename T>
  requires std::is_trivially_copyable_v<T>
  void add(const T& value) { write(std::as_bytes(std::span(&value, 1))); }
  // Returns the buffer, which ends the writing. Throws std::logic_error unless all bytes were added.
  Buffer finish();

 private:
  void flush();

  Uploader& uploader_;
  VkDeviceSize bytes_;
  Buffer target_;
  Uploader::Staged piece_;
  VkDeviceSize flushed_ = 0;  // bytes in the target
  VkDeviceSize filled_ = 0;   // bytes of the piece
};

}  // namespace speculum
