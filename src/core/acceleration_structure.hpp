#pragma once

#include "core/buffer.hpp"

namespace speculum {

// Input of one build, for devices with DeviceCaps::rayQueries.
struct StructureInput {
  VkAccelerationStructureTypeKHR type = VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR;
  VkBuildAccelerationStructureFlagsKHR flags = 0;
  VkAccelerationStructureGeometryKHR geometry{.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR};
  uint32_t count = 0;  // triangles, boxes or instances
};

// Usage of buffers that a build reads, that hold structures, and that builds use as scratch memory.
inline constexpr VkBufferUsageFlags structureInputUsage =
    VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
inline constexpr VkBufferUsageFlags structureUsage =
    VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_STORAGE_BIT_KHR | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
inline constexpr VkBufferUsageFlags scratchUsage =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;

struct StructureSizes {
  VkDeviceSize structure = 0;  // bytes, a multiple of what offsets in buffers must be
  VkDeviceSize scratch = 0;    // bytes of a scratch buffer, with room to align the address
};
StructureSizes structureSizes(const Device& device, const StructureInput& input);

// Makes a structure at an offset, a multiple of 256, in a buffer that outlives it.
AccelerationStructureHandle createStructure(const Device& device, VkAccelerationStructureTypeKHR type,
                                            const Buffer& buffer, VkDeviceSize offset, VkDeviceSize bytes,
                                            const std::string& name);
VkDeviceAddress addressOf(const Device& device, const AccelerationStructureHandle& structure);

// Records a build, or with `updates` one that keeps the hierarchy of the last build and fits its boxes. Builds that
// share scratch memory need Barriers::buildToBuild between them.
void recordBuild(const Device& device, VkCommandBuffer commands, const StructureInput& input,
                 const AccelerationStructureHandle& structure, const Buffer& scratch, bool updates = false);

// Returns the structures of these inputs, compacted, one after the other in `buffer`. Waits for the GPU.
class Uploader;
std::vector<AccelerationStructureHandle> buildCompacted(Device& device, Uploader& uploader,
                                                        std::span<const StructureInput> inputs, Buffer& buffer,
                                                        const std::string& name);

}  // namespace speculum
