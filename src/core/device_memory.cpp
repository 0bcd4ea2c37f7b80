#include "core/device_memory.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <bit>
#include <exception>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "core/device.hpp"

namespace speculum {

std::optional<VkDeviceSize> FreeRanges::take(VkDeviceSize bytes, VkDeviceSize alignment) {
  for (auto range = sizes_.begin(); range != sizes_.end(); ++range) {
    const auto [begin, size] = *range;
    const VkDeviceSize offset = (begin + alignment - 1) / alignment * alignment;
    if (offset + bytes > begin + size) {
      continue;
    }
    sizes_.erase(range);
    if (offset > begin) {
      sizes_.emplace(begin, offset - begin);
    }
    if (offset + bytes < begin + size) {
      sizes_.emplace(offset + bytes, begin + size - offset - bytes);
    }
    return offset;
  }
  return std::nullopt;
}

void FreeRanges::give(VkDeviceSize offset, VkDeviceSize bytes) {
  auto range = sizes_.emplace(offset, bytes).first;
  if (const auto after = std::next(range); after != sizes_.end() && after->first == offset + bytes) {
    range->second += after->second;
    sizes_.erase(after);
  }
  if (range != sizes_.begin()) {
    if (const auto before = std::prev(range); before->first + before->second == offset) {
      before->second += range->second;
      sizes_.erase(range);
    }
  }
}

std::vector<uint32_t> memoryTypes(const VkPhysicalDeviceMemoryProperties& memory, uint32_t allowed,
                                  VkMemoryPropertyFlags wanted) {
  // Types with other properties, such as memory that is only there while it is used, are for resources made for them.
  constexpr VkMemoryPropertyFlags usual = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT | VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT |
                                          VK_MEMORY_PROPERTY_HOST_COHERENT_BIT | VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
  std::vector<uint32_t> types;
  for (uint32_t type = 0; type < memory.memoryTypeCount; ++type) {
    if (allowed & (1u << type) && !(memory.memoryTypes[type].propertyFlags & ~usual)) {
      types.push_back(type);
    }
  }
  const auto others = std::stable_partition(types.begin(), types.end(), [&](uint32_t type) {
    return (memory.memoryTypes[type].propertyFlags & wanted) == wanted;
  });
  if (wanted != VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT) {
    types.erase(others, types.end());
  }
  return types;
}

MemoryBlocks::Place MemoryBlocks::take(const Device& device, const Request& request) {
  VkPhysicalDeviceMemoryProperties memory{};
  vkGetPhysicalDeviceMemoryProperties(device.physical(), &memory);
  const std::vector<uint32_t> types = memoryTypes(memory, request.requirements.memoryTypeBits, request.wanted);
  if (types.empty()) {
    throw std::runtime_error("the GPU has no memory of the kind that " + request.name + " needs");
  }
  const std::scoped_lock lock(mutex_);
  std::exception_ptr lack;
  for (const uint32_t type : types) {
    try {
      const Place place = takeOfType(device, request, type);
      const bool local = memory.memoryTypes[type].propertyFlags & VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
      if (lack && !local && !std::exchange(spilled_, true)) {
        spdlog::warn("the GPU's own memory is full: {} and others lie in memory that it reaches more slowly",
                     request.name);
      }
      usedBytes_ += request.requirements.size;
      return place;
    } catch (const OutOfMemoryError&) {
      lack = lack ? lack : std::current_exception();
    }
  }
  std::rethrow_exception(lack);
}

// Blocks grow with what the resources of their kind take, so that a small scene takes little and a large one few
// allocations.
MemoryBlocks::Place MemoryBlocks::takeOfType(const Device& device, const Request& request, uint32_t type) {
  const auto& [bytes, alignment, allowed] = request.requirements;
  VkDeviceSize sum = 0;
  for (const auto& block : blocks_) {
    const bool fits = block->type == type && block->use == request.use;
    sum += fits && block->free ? block->bytes : 0;
    if (fits && block->free && !request.apart && bytes <= largestBlock / 2) {
      if (const std::optional<VkDeviceSize> offset = block->free->take(bytes, alignment)) {
        return {block.get(), *offset};
      }
    }
  }
  const VkDeviceSize next = std::clamp(std::bit_ceil(sum), smallestBlock, largestBlock);
  if (!request.apart && bytes <= next / 2) {
    try {
      Block* block = allocate(device, request, type, next);
      return {block, block->free->take(bytes, alignment).value()};
    } catch (const OutOfMemoryError&) {  // what the resource itself needs may still be there
    }
  }
  return {allocate(device, request, type, {}), 0};
}

// Allocates a block of `shared` bytes or, without, the memory of this resource alone.
MemoryBlocks::Block* MemoryBlocks::allocate(const Device& device, const Request& request, uint32_t type,
                                            std::optional<VkDeviceSize> shared) {
  // Leaves some allocations for the panels.
  const uint32_t most = device.limits().maxMemoryAllocationCount;
  if (allocations_ + 16 >= most) {
    throw OutOfMemoryError("allocate memory for " + request.name + ": the device takes " + std::to_string(most) +
                           " allocations (fewer textures, or a lower reflection.max_passes)");
  }
  VkMemoryAllocateFlagsInfo flags{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO,
                                  .pNext = shared ? nullptr : &request.resource,
                                  .flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT};
  const VkMemoryAllocateInfo info{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                  .pNext = request.use == MemoryUse::addressedBuffers ? &flags : flags.pNext,
                                  .allocationSize = shared.value_or(request.requirements.size),
                                  .memoryTypeIndex = type};
  VkDeviceMemory memory = VK_NULL_HANDLE;
  check(vkAllocateMemory(device.get(), &info, nullptr, &memory),
        "allocate " + std::to_string(request.requirements.size) + " bytes for " + request.name);
  auto block = std::make_unique<Block>();
  block->memory = {device.get(), memory};
  block->bytes = info.allocationSize;
  block->type = type;
  block->use = request.use;
  if (shared) {
    block->free.emplace(*shared);
  }
  device.setName(memory, shared ? "block of memory" : request.name);
  bytes_ += block->bytes;
  ++allocations_;
  return blocks_.emplace_back(std::move(block)).get();
}

// Empty blocks of the smallest size, of which a kind has few, are kept for what comes next.
void MemoryBlocks::give(const Place& place, VkDeviceSize bytes) {
  const std::scoped_lock lock(mutex_);
  usedBytes_ -= bytes;
  Block& block = *place.block;
  if (block.free) {
    block.free->give(place.offset, bytes);
  }
  if (!block.free || (block.free->nothingTaken() && block.bytes > smallestBlock)) {
    bytes_ -= block.bytes;
    --allocations_;
    std::erase_if(blocks_, [&](const auto& other) { return other.get() == &block; });
  }
}

template <typename Info>
MemoryBlocks::Request MemoryBlocks::requestOf(const Device& device, MemoryUse use, const Info& info,
                                              void (*ask)(VkDevice, const Info*, VkMemoryRequirements2*),
                                              const std::string& name) {
  VkMemoryDedicatedRequirements dedicated{.sType = VK_STRUCTURE_TYPE_MEMORY_DEDICATED_REQUIREMENTS};
  VkMemoryRequirements2 needed{.sType = VK_STRUCTURE_TYPE_MEMORY_REQUIREMENTS_2, .pNext = &dedicated};
  ask(device.get(), &info, &needed);
  return {.requirements = needed.memoryRequirements,
          .wanted = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT,
          .use = use,
          .apart = dedicated.prefersDedicatedAllocation || dedicated.requiresDedicatedAllocation,
          .name = name};
}

Memory::Memory(Device& device, VkBuffer buffer, bool forHost, bool addressed, const std::string& name) {
  const VkBufferMemoryRequirementsInfo2 info{.sType = VK_STRUCTURE_TYPE_BUFFER_MEMORY_REQUIREMENTS_INFO_2,
                                             .buffer = buffer};
  MemoryBlocks::Request request = MemoryBlocks::requestOf(
      device, addressed ? MemoryUse::addressedBuffers : MemoryUse::buffers, info, vkGetBufferMemoryRequirements2, name);
  if (addressed) {
    // What reads a buffer by its address may want more than the driver asks for buffers, such as 16 bytes for
    // instances.
    request.requirements.alignment = std::max<VkDeviceSize>(request.requirements.alignment, 256);
  }
  if (forHost) {
    request.wanted = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  }
  request.resource.buffer = buffer;
  take(device, request);
  check(vkBindBufferMemory(device.get(), buffer, memory(), offset()), "bind the memory of " + name);
}

Memory::Memory(Device& device, VkImage image, const std::string& name) {
  const VkImageMemoryRequirementsInfo2 info{.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_REQUIREMENTS_INFO_2,
                                            .image = image};
  MemoryBlocks::Request request =
      MemoryBlocks::requestOf(device, MemoryUse::images, info, vkGetImageMemoryRequirements2, name);
  request.resource.image = image;
  take(device, request);
  check(vkBindImageMemory(device.get(), image, memory(), offset()), "bind the memory of " + name);
}

void Memory::take(Device& device, const MemoryBlocks::Request& request) {
  MemoryBlocks& blocks = device.memory();
  const MemoryBlocks::Place place = blocks.take(device, request);
  taken_ = {&blocks, MemoryBlocks::Give{place, request.requirements.size}};
  if (request.wanted & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) {
    const std::scoped_lock lock(blocks.mutex_);
    if (!place.block->mapped) {
      void* data = nullptr;
      check(vkMapMemory(device.get(), memory(), 0, VK_WHOLE_SIZE, 0, &data), "map the memory of " + request.name);
      place.block->mapped = static_cast<std::byte*>(data);
    }
    mapped_ = place.block->mapped + place.offset;
  }
}

}  // namespace speculum
