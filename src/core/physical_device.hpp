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
  std::optional<std::string> missing;  // feature without which the device is not usable

  bool isCpu() const { return type == VK_PHYSICAL_DEVICE_TYPE_CPU; }
};

struct DeviceCaps {
  VkSampleCountFlags sampleCounts = VK_SAMPLE_COUNT_1_BIT;  // for RGBA16F color and D32F depth alike
  double timestampPeriod = 0.0;                             // nanoseconds per tick
  uint32_t timestampValidBits = 0;                          // 0: no timestamps
  bool pipelineStatistics = false;
  bool countsSamples = false;  // exactly, in occlusion queries
  bool sampleRateShading = false;
  bool depthClamp = false;
  bool fillModeNonSolid = false;
  bool primitiveId = false;  // in fragment shaders
  bool dynamicRendering = false;
  bool memoryBudget = false;
  bool rayQueries = false;        // VK_KHR_ray_query and what it needs
  uint32_t scratchAlignment = 0;  // bytes, of scratch memory for acceleration structures
};

// Extensions and features that ray queries need, to be asked about and to be enabled.
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
  uint32_t presentFamily = 0;  // presents to the window; queueFamily where it can

  bool hasExtension(std::string_view name) const;
};

// With a surface, DeviceInfo::missing of a GPU that cannot present to it says so.
std::vector<PhysicalDevice> physicalDevices(const Instance& instance, VkSurfaceKHR surface);

// Chooses by index or part of the name, or if that is empty the first usable one of the best type. Throws
// std::runtime_error that lists the GPUs when nothing fits or the one named lacks a feature.
const PhysicalDevice& choose(const std::vector<PhysicalDevice>& devices, const std::string& wanted);

bool presentsTo(VkPhysicalDevice device, uint32_t queueFamily, VkSurfaceKHR surface);

}  // namespace speculum
