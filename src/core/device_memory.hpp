#pragma once

#include <vulkan/vulkan.h>

#include <atomic>
#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/handle.hpp"

namespace speculum {

class Device;

// The free ranges of a block of memory, in bytes from its begin.
class FreeRanges {
 public:
  explicit FreeRanges(VkDeviceSize bytes) : sizes_{{0, bytes}}, bytes_(bytes) {}

  // Takes the first free range that fits and returns its offset, a multiple of `alignment`. Returns nothing if none
  // fits.
  std::optional<VkDeviceSize> take(VkDeviceSize bytes, VkDeviceSize alignment);
  // Frees a range that was taken, and joins it with its free neighbours.
  void give(VkDeviceSize offset, VkDeviceSize bytes);
  bool nothingTaken() const { return sizes_.size() == 1 && sizes_.begin()->second == bytes_; }

 private:
  std::map<VkDeviceSize, VkDeviceSize> sizes_;  // by offset
  VkDeviceSize bytes_;
};

// Returns the memory types of `allowed` (bits) in the order in which they are tried: those with the `wanted`
// properties, then, if these only say that memory is local to the device, all others.
std::vector<uint32_t> memoryTypes(const VkPhysicalDeviceMemoryProperties& memory, uint32_t allowed,
                                  VkMemoryPropertyFlags wanted);

// Resources that may share a block. A device can keep images and buffers on different pages (bufferImageGranularity),
// and the memory of buffers with addresses is allocated for them.
enum class MemoryUse { buffers, addressedBuffers, images };

// Allocations of a device: blocks that resources share, and allocations of one resource each, which are those that are
// large or that the driver wants apart. For several threads.
class MemoryBlocks {
 public:
  static constexpr VkDeviceSize smallestBlock = VkDeviceSize{4} << 20;
  static constexpr VkDeviceSize largestBlock = VkDeviceSize{64} << 20;

  uint64_t usedBytes() const { return usedBytes_; }  // of resources
  uint64_t bytes() const { return bytes_; }          // of allocations
  uint32_t allocations() const { return allocations_; }

 private:
  friend class Memory;
  struct Block {
    MemoryHandle memory;
    VkDeviceSize bytes = 0;
    uint32_t type = 0;
    MemoryUse use = MemoryUse::buffers;
    std::optional<FreeRanges> free;  // nothing: the allocation of one resource
    std::byte* mapped = nullptr;     // the host's view, from the first use by the host on
  };
  struct Request {
    VkMemoryRequirements requirements{};
    VkMemoryPropertyFlags wanted = 0;
    MemoryUse use = MemoryUse::buffers;
    bool apart = false;
    VkMemoryDedicatedAllocateInfo resource{.sType = VK_STRUCTURE_TYPE_MEMORY_DEDICATED_ALLOCATE_INFO};
    std::string name;
  };
  struct Place {
    Block* block = nullptr;
    VkDeviceSize offset = 0;
  };

  struct Give {
    Place place;
    uint64_t bytes = 0;
    void operator()(MemoryBlocks* blocks) const { blocks->give(place, bytes); }
  };

  template <typename Info>
  static Request requestOf(const Device& device, MemoryUse use, const Info& info,
                           void (*ask)(VkDevice, const Info*, VkMemoryRequirements2*), const std::string& name);
  Place take(const Device& device, const Request& request);
  Place takeOfType(const Device& device, const Request& request, uint32_t type);
  Block* allocate(const Device& device, const Request& request, uint32_t type, std::optional<VkDeviceSize> shared);
  void give(const Place& place, VkDeviceSize bytes);

  std::mutex mutex_;
  std::vector<std::unique_ptr<Block>> blocks_;
  std::atomic<uint64_t> usedBytes_{0};
  bool spilled_ = false;  // a resource lies in memory of the second choice
  std::atomic<uint64_t> bytes_{0};
  std::atomic<uint32_t> allocations_{0};
};

// The memory that a buffer or an image is bound to. Move-only. It may go before or after the resource, which must not
// be in use then.
class Memory {
 public:
  Memory() = default;
  // Allocates memory and binds it. Memory for the host is coherent and mapped. Buffers with `addressed` have device
  // addresses. Throws OutOfMemoryError, or std::runtime_error if the GPU has no memory with the wanted properties.
  Memory(Device& device, VkBuffer buffer, bool forHost, bool addressed, const std::string& name);
  Memory(Device& device, VkImage image, const std::string& name);

  uint64_t bytes() const { return taken_ ? taken_.get_deleter().bytes : 0; }
  std::byte* mapped() const { return mapped_; }  // null unless it is memory for the host

 private:
  void take(Device& device, const MemoryBlocks::Request& request);
  VkDeviceMemory memory() const { return taken_.get_deleter().place.block->memory.get(); }
  VkDeviceSize offset() const { return taken_.get_deleter().place.offset; }

  std::unique_ptr<MemoryBlocks, MemoryBlocks::Give> taken_;
  std::byte* mapped_ = nullptr;
};

}  // namespace speculum
