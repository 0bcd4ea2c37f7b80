#pragma once

#include <string>
#include <vector>

#include "core/device.hpp"

namespace speculum {

// Properties of one GPU, read before a device is created.
struct PhysicalDevice {
  VkPhysicalDevice handle = VK_NULL_HANDLE;
  VkPhysicalDeviceProperties properties{};
  VkPhysicalDeviceFeatures features{};
  std::vector<std::string> extensions;
  DeviceInfo info;
  DeviceCaps caps;
  bool extendedDynamicState = false;
  bool core13 = false;

  bool hasExtension(std::string_view name) const;
};

std::vector<PhysicalDevice> physicalDevices(VkInstance instance);

// Chooses by index or part of the name, or if that is empty the first usable one of the best type. Throws
// std::runtime_error that lists the GPUs when nothing fits or the one named lacks a feature.
const PhysicalDevice& choose(const std::vector<PhysicalDevice>& devices, const std::string& wanted);

std::vector<VkQueueFamilyProperties> queueFamilies(VkPhysicalDevice device);

// Returns the index of a queue family that draws and, unless `surface` is null, presents to it. Throws
// std::runtime_error if there is none.
uint32_t chooseQueueFamily(const PhysicalDevice& device, VkSurfaceKHR surface);

}  // namespace speculum
