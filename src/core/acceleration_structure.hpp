#pragma once

#include "core/buffer.hpp"

namespace speculum {

// Input of the build of one acceleration structure. All of this file needs a device with DeviceCaps::rayQueries.
struct StructureInput {
  VkAccelerationStructureTypeKHR type = VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR;
  VkBuildAccelerationStructureFlagsKHR flags = 0;
  VkAccelerationStructureGeometryKHR geometry{.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR};
  uint32_t count = 0;  // number of triangles, boxes or instances
};

// Usages of buffers: the input of a build, the memory of acceleration structures, and the scratch memory of a build.
inline constexpr VkBufferUsageFlags structureInputUsage =
    VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
inline constexpr VkBufferUsageFlags structureUsage =
    VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_STORAGE_BIT_KHR | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
inline constexpr VkBufferUsageFlags scratchUsage =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;

struct StructureSizes {
  VkDeviceSize structure = 0;  // bytes, a multiple of 256, so that structures can follow each other in a buffer
  VkDeviceSize scratch = 0;    // bytes of a scratch buffer for builds and updates, with room to align its address
};
StructureSizes structureSizes(const Device& device, const StructureInput& input);

// Makes a structure, not built yet, at an offset (a multiple of 256) in a buffer that must outlive the structure.
AccelerationStructureHandle createStructure(const Device& device, VkAccelerationStructureTypeKHR type,
                                            const Buffer& buffer, VkDeviceSize offset, VkDeviceSize bytes,
                                            const std::string& name);
// Returns the address by which instances refer to the structure.
VkDeviceAddress addressOf(const Device& device, const AccelerationStructureHandle& structure);

// Records a build; with `updates`, an update that keeps the hierarchy of the structure's last build and only fits its
// boxes to the new input. Builds that share scratch memory need Barriers::buildToBuild between them.
void recordBuild(const Device& device, VkCommandBuffer commands, const StructureInput& input,
                 const AccelerationStructureHandle& structure, const Buffer& scratch, bool updates = false);

class Uploader;
// Builds a structure for each input and returns them compacted. They lie one after the other in `buffer`, which this
// function makes. Waits for the GPU.
std::vector<AccelerationStructureHandle> buildCompacted(Device& device, Uploader& uploader,
                                                        std::span<const StructureInput> inputs, Buffer& buffer,
                                                        const std::string& name);

}  // namespace speculum
