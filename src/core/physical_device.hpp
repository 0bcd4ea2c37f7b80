#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/instance.hpp"

namespace speculum {

struct DeviceInfo {
  int index = 0;
  std::string name;
  std::string driver;  // name and version
  uint32_t apiVersion = 0;
  VkPhysicalDeviceType type = VK_PHYSICAL_DEVICE_TYPE_OTHER;
  uint64_t memoryBytes = 0;  // of the largest device-local heap
  bool dynamicRendering = false;
  bool rayQueries = false;
  std::optional<std::string> missing;  // what the program needs and the GPU lacks; nothing if the GPU is usable

  bool isCpu() const { return type == VK_PHYSICAL_DEVICE_TYPE_CPU; }
  std::string vulkanVersion() const;  // such as "1.3.0"
};

// Formats of depth, the best first. The last one is not as precise, but a device without D32F must have it.
inline constexpr std::array depthFormats{VK_FORMAT_D32_SFLOAT, VK_FORMAT_D32_SFLOAT_S8_UINT,
                                         VK_FORMAT_X8_D24_UNORM_PACK32};

struct DeviceCaps {
  VkFormat depthFormat = VK_FORMAT_UNDEFINED;               // the first of depthFormats that the device has
  VkSampleCountFlags sampleCounts = VK_SAMPLE_COUNT_1_BIT;  // for RGBA16F color and that depth alike
  uint32_t timestampValidBits = 0;                          // 0: no timestamps
  bool pipelineStatistics = false;
  bool countsSamples = false;  // occlusion queries count samples exactly
  bool sampleRateShading = false;
  bool depthClamp = false;
  bool fillModeNonSolid = false;
  bool wideLines = false;
  bool anisotropy = false;          // of samplers, where they take no unbounded time
  bool dynamicPolygonMode = false;  // pipelines may leave open whether they draw lines
  bool primitiveId = false;         // fragment shaders can read gl_PrimitiveID
  bool dynamicRendering = false;
  bool memoryBudget = false;
  bool rayQueries = false;        // VK_KHR_ray_query and what it needs
  uint32_t scratchAlignment = 0;  // bytes, of scratch memory for acceleration structures
};

// Extensions and features that ray queries need: to ask a GPU whether it has them, and to enable them.
inline constexpr std::array rayQueryExtensions = {VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME,
                                                  VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME,
                                                  VK_KHR_RAY_QUERY_EXTENSION_NAME};
struct RayQueryFeatures {
  VkPhysicalDeviceBufferDeviceAddressFeatures addresses{
      .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_BUFFER_DEVICE_ADDRESS_FEATURES};
  VkPhysicalDeviceAccelerationStructureFeaturesKHR structures{
      .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR};
  VkPhysicalDeviceRayQueryFeaturesKHR queries{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_QUERY_FEATURES_KHR};

  // Links the structures before `next` and returns the first.
  void* chain(void* next) {
    queries.pNext = next;
    structures.pNext = &queries;
    addresses.pNext = &structures;
    return &addresses;
  }
};

// Properties of one GPU, read before a device is created.
struct PhysicalDevice {
  VkPhysicalDevice handle = VK_NULL_HANDLE;
  VkPhysicalDeviceProperties properties{};
  VkPhysicalDeviceFeatures features{};
  std::vector<VkExtensionProperties> extensions;
  DeviceInfo info;
  DeviceCaps caps;
  bool extendedDynamicState = false;
  bool core13 = false;         // both GPU and loader have Vulkan 1.3
  uint32_t queueFamily = 0;    // draws and computes
  uint32_t presentFamily = 0;  // presents to the window; equals queueFamily if that family can

  bool hasExtension(std::string_view name) const;
};

// Lists all GPUs. With a surface, DeviceInfo::missing says so of a GPU that cannot present to the surface.
std::vector<PhysicalDevice> physicalDevices(const Instance& instance, VkSurfaceKHR surface);

// Chooses a GPU by index or part of its name or, if `wanted` is empty, the first usable one of the best type (discrete,
// integrated, virtual, others). Throws std::runtime_error that lists the GPUs when none fits or the wanted one lacks a
// feature.
const PhysicalDevice& choose(const std::vector<PhysicalDevice>& devices, const std::string& wanted);

// Says whether queues of the family can present to the surface.
bool presentsTo(VkPhysicalDevice device, uint32_t queueFamily, VkSurfaceKHR surface);

}  // namespace speculum
