#include "core/acceleration_structure.hpp"

#include <algorithm>

#include "core/uploader.hpp"

namespace speculum {

namespace {

constexpr VkDeviceSize structureAlignment = 256;

VkDeviceSize aligned(VkDeviceSize bytes, VkDeviceSize alignment) {
  return (bytes + alignment - 1) / alignment * alignment;
}

VkAccelerationStructureBuildGeometryInfoKHR buildInfo(const StructureInput& input) {
  return {.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_GEOMETRY_INFO_KHR,
          .type = input.type,
          .flags = input.flags,
          .mode = VK_BUILD_ACCELERATION_STRUCTURE_MODE_BUILD_KHR,
          .geometryCount = 1,
          .pGeometries = &input.geometry};
}

// Makes `buffer` and in it, one after the other, a structure of `bytes` for each input.
std::vector<AccelerationStructureHandle> placed(Device& device, std::span<const StructureInput> inputs,
                                                const std::vector<VkDeviceSize>& bytes, Buffer& buffer,
                                                const std::string& name) {
  VkDeviceSize all = 0;
  for (const VkDeviceSize each : bytes) {
    all += aligned(each, structureAlignment);
  }
  buffer = Buffer(device, all, structureUsage, BufferMemory::device, name);
  std::vector<AccelerationStructureHandle> structures;
  VkDeviceSize offset = 0;
  for (size_t i = 0; i < inputs.size(); ++i) {
    structures.push_back(createStructure(device, inputs[i].type, buffer, offset, bytes[i], name));
    offset += aligned(bytes[i], structureAlignment);
  }
  return structures;
}

}  // namespace

StructureSizes structureSizes(const Device& device, const StructureInput& input) {
  const VkAccelerationStructureBuildGeometryInfoKHR info = buildInfo(input);
  VkAccelerationStructureBuildSizesInfoKHR sizes{.sType =
                                                     VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_SIZES_INFO_KHR};
  device.function<PFN_vkGetAccelerationStructureBuildSizesKHR>("vkGetAccelerationStructureBuildSizesKHR")(
      device.get(), VK_ACCELERATION_STRUCTURE_BUILD_TYPE_DEVICE_KHR, &info, &input.count, &sizes);
  return {aligned(sizes.accelerationStructureSize, structureAlignment),
          std::max(sizes.buildScratchSize, sizes.updateScratchSize) + device.caps().scratchAlignment};
}

AccelerationStructureHandle createStructure(const Device& device, VkAccelerationStructureTypeKHR type,
                                            const Buffer& buffer, VkDeviceSize offset, VkDeviceSize bytes,
                                            const std::string& name) {
  const auto create = device.function<PFN_vkCreateAccelerationStructureKHR>("vkCreateAccelerationStructureKHR");
  return device.create(create,
                       {.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_CREATE_INFO_KHR,
                        .buffer = buffer.get(),
                        .offset = offset,
                        .size = bytes,
                        .type = type},
                       name);
}

VkDeviceAddress addressOf(const Device& device, const AccelerationStructureHandle& structure) {
  const VkAccelerationStructureDeviceAddressInfoKHR info{
      .sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_DEVICE_ADDRESS_INFO_KHR,
      .accelerationStructure = structure.get()};
  return device.function<PFN_vkGetAccelerationStructureDeviceAddressKHR>("vkGetAccelerationStructureDeviceAddressKHR")(
      device.get(), &info);
}

void recordBuild(const Device& device, VkCommandBuffer commands, const StructureInput& input,
                 const AccelerationStructureHandle& structure, const Buffer& scratch, bool updates) {
  VkAccelerationStructureBuildGeometryInfoKHR info = buildInfo(input);
  if (updates) {
    info.mode = VK_BUILD_ACCELERATION_STRUCTURE_MODE_UPDATE_KHR;
    info.srcAccelerationStructure = structure.get();
  }
  info.dstAccelerationStructure = structure.get();
  info.scratchData.deviceAddress = aligned(scratch.address(), std::max(device.caps().scratchAlignment, 1u));
  const VkAccelerationStructureBuildRangeInfoKHR range{.primitiveCount = input.count};
  const VkAccelerationStructureBuildRangeInfoKHR* ranges = &range;
  device.function<PFN_vkCmdBuildAccelerationStructuresKHR>("vkCmdBuildAccelerationStructuresKHR")(commands, 1, &info,
                                                                                                  &ranges);
}

std::vector<AccelerationStructureHandle> buildCompacted(Device& device, Uploader& uploader,
                                                        std::span<const StructureInput> inputs, Buffer& buffer,
                                                        const std::string& name) {
  const auto count = static_cast<uint32_t>(inputs.size());
  std::vector<VkDeviceSize> bytes;
  VkDeviceSize scratchBytes = 0;
  for (const StructureInput& input : inputs) {
    const StructureSizes sizes = structureSizes(device, input);
    bytes.push_back(sizes.structure);
    scratchBytes = std::max(scratchBytes, sizes.scratch);
  }
  Buffer looseBuffer;
  const std::vector<AccelerationStructureHandle> loose = placed(device, inputs, bytes, looseBuffer, "loose " + name);
  const Buffer scratch(device, scratchBytes, scratchUsage, BufferMemory::device, "scratch of " + name);
  const QueryPoolHandle queries = device.create(vkCreateQueryPool,
                                                {.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO,
                                                 .queryType = VK_QUERY_TYPE_ACCELERATION_STRUCTURE_COMPACTED_SIZE_KHR,
                                                 .queryCount = count},
                                                "sizes of " + name);
  std::vector<VkAccelerationStructureKHR> handles;
  uploader.run([&](VkCommandBuffer commands) {
    vkCmdResetQueryPool(commands, queries.get(), 0, count);
    for (uint32_t i = 0; i < count; ++i) {
      Barriers::buildToBuild(commands);
      recordBuild(device, commands, inputs[i], loose[i], scratch);
      handles.push_back(loose[i].get());
    }
    Barriers::buildToBuild(commands);
    device.function<PFN_vkCmdWriteAccelerationStructuresPropertiesKHR>("vkCmdWriteAccelerationStructuresPropertiesKHR")(
        commands, count, handles.data(), VK_QUERY_TYPE_ACCELERATION_STRUCTURE_COMPACTED_SIZE_KHR, queries.get(), 0);
  });
  check(vkGetQueryPoolResults(device.get(), queries.get(), 0, count, count * sizeof(VkDeviceSize), bytes.data(),
                              sizeof(VkDeviceSize), VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
        "read the sizes of " + name);
  std::vector<AccelerationStructureHandle> compacted = placed(device, inputs, bytes, buffer, name);
  uploader.run([&](VkCommandBuffer commands) {
    const auto copy = device.function<PFN_vkCmdCopyAccelerationStructureKHR>("vkCmdCopyAccelerationStructureKHR");
    Barriers::buildToBuild(commands);
    for (uint32_t i = 0; i < count; ++i) {
      const VkCopyAccelerationStructureInfoKHR info{.sType = VK_STRUCTURE_TYPE_COPY_ACCELERATION_STRUCTURE_INFO_KHR,
                                                    .src = loose[i].get(),
                                                    .dst = compacted[i].get(),
                                                    .mode = VK_COPY_ACCELERATION_STRUCTURE_MODE_COMPACT_KHR};
      copy(commands, &info);
    }
    Barriers::buildToBuild(commands);
    Barriers::buildToTrace(commands);
  });
  return compacted;
}

}  // namespace speculum
