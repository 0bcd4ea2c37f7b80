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
  bool core13 = false;         // both GPU and loader have Vulkan 1.3
  uint32_t queueFamily = 0;    // draws and computes
  uint32_t presentFamily = 0;  // presents to the window; queueFamily where it can

  bool hasExtension(std::string_view name) const;
};

// With a surface, DeviceInfo::missing says so of a GPU that cannot present to it.
std::vector<PhysicalDevice> physicalDevices(const Instance& instance, VkSurfaceKHR surface);

// Chooses by index or part of the name, or if that is empty the first usable one of the best type. Throws
// std::runtime_error that lists the GPUs when nothing fits or the one named lacks a feature.
const PhysicalDevice& choose(const std::vector<PhysicalDevice>& devices, const std::string& wanted);

bool presentsTo(VkPhysicalDevice device, uint32_t queueFamily, VkSurfaceKHR surface);

}  // namespace speculum
