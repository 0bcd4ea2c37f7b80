#include "core/physical_device.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include "core/image.hpp"
#include "platform/text.hpp"

namespace speculum {

namespace {

VkSampleCountFlags sampleCounts(VkPhysicalDevice device, VkFormat format, VkImageUsageFlags usage) {
  VkImageFormatProperties properties{};
  const VkResult result = vkGetPhysicalDeviceImageFormatProperties(device, format, VK_IMAGE_TYPE_2D,
                                                                   VK_IMAGE_TILING_OPTIMAL, usage, 0, &properties);
  return result == VK_SUCCESS ? properties.sampleCounts : 0;
}

// Reads whether compute shaders can query acceleration structures. Needs Vulkan 1.2 for addresses of buffers.
void readRayQueries(PhysicalDevice& device, uint32_t instanceVersion) {
  if (std::min(device.properties.apiVersion, instanceVersion) < VK_API_VERSION_1_2 ||
      !std::ranges::all_of(rayQueryExtensions, [&](const char* name) { return device.hasExtension(name); })) {
    return;
  }
  RayQueryFeatures found;
  VkPhysicalDeviceFeatures2 features{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2,
                                     .pNext = found.chain(nullptr)};
  vkGetPhysicalDeviceFeatures2(device.handle, &features);
  VkPhysicalDeviceAccelerationStructurePropertiesKHR limits{
      .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_PROPERTIES_KHR};
  VkPhysicalDeviceProperties2 properties{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, .pNext = &limits};
  vkGetPhysicalDeviceProperties2(device.handle, &properties);
  device.caps.rayQueries =
      found.addresses.bufferDeviceAddress && found.structures.accelerationStructure && found.queries.rayQuery;
  device.caps.scratchAlignment = limits.minAccelerationStructureScratchOffsetAlignment;
}

void readFeatures(PhysicalDevice& device) {
  VkPhysicalDeviceDynamicRenderingFeatures dynamic{.sType =
                                                       VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DYNAMIC_RENDERING_FEATURES};
  VkPhysicalDeviceExtendedDynamicStateFeaturesEXT state{
      .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_EXTENDED_DYNAMIC_STATE_FEATURES_EXT};
  VkPhysicalDeviceExtendedDynamicState3FeaturesEXT state3{
      .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_EXTENDED_DYNAMIC_STATE_3_FEATURES_EXT};
  void* next = nullptr;
  if (device.hasExtension(VK_EXT_EXTENDED_DYNAMIC_STATE_3_EXTENSION_NAME)) {
    state3.pNext = std::exchange(next, &state3);
  }
  if (device.core13 || device.hasExtension(VK_KHR_DYNAMIC_RENDERING_EXTENSION_NAME)) {
    dynamic.pNext = std::exchange(next, &dynamic);
  }
  if (!device.core13 && device.hasExtension(VK_EXT_EXTENDED_DYNAMIC_STATE_EXTENSION_NAME)) {
    state.pNext = std::exchange(next, &state);
  }
  VkPhysicalDeviceFeatures2 features{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, .pNext = next};
  vkGetPhysicalDeviceFeatures2(device.handle, &features);
  device.features = features.features;
  device.extendedDynamicState = device.core13 || state.extendedDynamicState;
  device.caps.dynamicRendering = dynamic.dynamicRendering;
  device.caps.dynamicPolygonMode = state3.extendedDynamicState3PolygonMode && device.features.fillModeNonSolid;
}

std::string driverText(const PhysicalDevice& device) {
  VkPhysicalDeviceDriverProperties driver{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
  if (device.properties.apiVersion < VK_API_VERSION_1_2 &&
      !device.hasExtension(VK_KHR_DRIVER_PROPERTIES_EXTENSION_NAME)) {
    return "version " + std::to_string(device.properties.driverVersion);
  }
  VkPhysicalDeviceProperties2 properties{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, .pNext = &driver};
  vkGetPhysicalDeviceProperties2(device.handle, &properties);
  return std::string(driver.driverName) + " " + driver.driverInfo;
}

uint64_t largestLocalHeap(VkPhysicalDevice device) {
  VkPhysicalDeviceMemoryProperties memory{};
  vkGetPhysicalDeviceMemoryProperties(device, &memory);
  uint64_t bytes = 0;
  for (uint32_t i = 0; i < memory.memoryHeapCount; ++i) {
    if (memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) {
      bytes = std::max(bytes, memory.memoryHeaps[i].size);
    }
  }
  return bytes;
}

// Chooses the queue families, a single one for everything if there is one. Returns what is missing, if anything.
std::optional<std::string> chooseQueueFamilies(PhysicalDevice& device, VkSurfaceKHR surface) {
  uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(device.handle, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(device.handle, &count, families.data());
  // A device with a queue that draws has one that draws and computes.
  constexpr VkQueueFlags wanted = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
  std::optional<uint32_t> draws;
  std::optional<uint32_t> presents;
  for (uint32_t i = 0; i < count; ++i) {
    const bool drawing = (families[i].queueFlags & wanted) == wanted;
    const bool presenting = surface == VK_NULL_HANDLE || (device.hasExtension(VK_KHR_SWAPCHAIN_EXTENSION_NAME) &&
                                                          presentsTo(device.handle, i, surface));
    if (drawing && presenting) {
      draws = presents = i;
      break;
    }
    draws = drawing && !draws ? i : draws;
    presents = presenting && !presents ? i : presents;
  }
  if (!draws) {
    return "a queue that draws";
  }
  device.queueFamily = *draws;
  device.presentFamily = presents.value_or(0);
  device.caps.timestampValidBits = families[*draws].timestampValidBits;
  return presents ? std::nullopt : std::optional("a queue that presents to this window");
}

std::optional<std::string> missing(const PhysicalDevice& device) {
  if (device.properties.apiVersion < VK_API_VERSION_1_1) {
    return "Vulkan 1.1";
  }
  if (!device.features.shaderClipDistance) {
    return "shaderClipDistance";
  }
  if (!device.extendedDynamicState) {
    return "Vulkan 1.3 or VK_EXT_extended_dynamic_state";
  }
  if (!(device.caps.sampleCounts & VK_SAMPLE_COUNT_1_BIT)) {
    return "RGBA16F color and 24 or 32 bit depth attachments";
  }
  return std::nullopt;
}

PhysicalDevice inspect(VkPhysicalDevice handle, int index, uint32_t instanceVersion, VkSurfaceKHR surface) {
  PhysicalDevice device{.handle = handle};
  vkGetPhysicalDeviceProperties(handle, &device.properties);
  device.extensions =
      enumerate<VkExtensionProperties>("list device extensions", vkEnumerateDeviceExtensionProperties, handle, nullptr);
  device.core13 = std::min(device.properties.apiVersion, instanceVersion) >= VK_API_VERSION_1_3;
  readFeatures(device);
  readRayQueries(device, instanceVersion);
  DeviceCaps& caps = device.caps;
  const auto depthCounts = [&](VkFormat format) {
    return sampleCounts(handle, format, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT);
  };
  const auto depth = std::ranges::find_if(depthFormats, [&](VkFormat format) { return depthCounts(format) != 0; });
  caps.depthFormat = depth == depthFormats.end() ? VK_FORMAT_UNDEFINED : *depth;
  caps.sampleCounts =
      depth == depthFormats.end()
          ? 0
          : sampleCounts(handle, colorFormat, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT) &
                depthCounts(*depth) & device.properties.limits.framebufferColorSampleCounts &
                device.properties.limits.framebufferDepthSampleCounts;
  caps.pipelineStatistics = device.features.pipelineStatisticsQuery;
  caps.countsSamples = device.features.occlusionQueryPrecise;
  caps.sampleRateShading = device.features.sampleRateShading;
  caps.depthClamp = device.features.depthClamp;
  caps.primitiveId = device.features.geometryShader;
  caps.fillModeNonSolid = device.features.fillModeNonSolid;
  caps.wideLines = device.features.wideLines;
  // lavapipe's takes time in proportion to the footprint: minutes where a texture repeats often.
  const bool isCpu = device.properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
  caps.anisotropy = device.features.samplerAnisotropy && !isCpu;
  caps.memoryBudget = device.hasExtension(VK_EXT_MEMORY_BUDGET_EXTENSION_NAME);
  device.info = {.index = index,
                 .name = device.properties.deviceName,
                 .driver = driverText(device),
                 .apiVersion = device.properties.apiVersion,
                 .type = device.properties.deviceType,
                 .memoryBytes = largestLocalHeap(handle),
                 .dynamicRendering = caps.dynamicRendering,
                 .rayQueries = caps.rayQueries};
  device.info.missing = missing(device);
  const std::optional<std::string> missingQueue = chooseQueueFamilies(device, surface);
  device.info.missing = device.info.missing ? device.info.missing : missingQueue;
  return device;
}

std::string listOf(const std::vector<PhysicalDevice>& devices) {
  std::string text;
  for (const PhysicalDevice& device : devices) {
    text += (text.empty() ? "" : "; ") + std::to_string(device.info.index) + " " + device.info.name;
  }
  return text;
}

// Returns the rank of a type of device; 0 is the best.
int rank(VkPhysicalDeviceType type) {
  constexpr std::array types = {VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU, VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU,
                                VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU};
  return static_cast<int>(std::ranges::find(types, type) - types.begin());
}

const PhysicalDevice* find(const std::vector<PhysicalDevice>& devices, const std::string& wanted) {
  size_t index = 0;
  const auto [end, error] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), index);
  if (error == std::errc() && end == wanted.data() + wanted.size()) {
    return index < devices.size() ? &devices[index] : nullptr;
  }
  for (const PhysicalDevice& device : devices) {
    if (lowerCase(device.info.name).find(lowerCase(wanted)) != std::string::npos) {
      return &device;
    }
  }
  return nullptr;
}

const PhysicalDevice* best(const std::vector<PhysicalDevice>& devices) {
  const PhysicalDevice* chosen = nullptr;
  for (const PhysicalDevice& device : devices) {
    if (!device.info.missing && (!chosen || rank(device.info.type) < rank(chosen->info.type))) {
      chosen = &device;
    }
  }
  return chosen;
}

}  // namespace

std::string DeviceInfo::vulkanVersion() const {
  return fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(apiVersion), VK_API_VERSION_MINOR(apiVersion),
                     VK_API_VERSION_PATCH(apiVersion));
}

bool PhysicalDevice::hasExtension(std::string_view name) const {
  return std::ranges::any_of(extensions, [&](const auto& extension) { return name == extension.extensionName; });
}

std::vector<PhysicalDevice> physicalDevices(const Instance& instance, VkSurfaceKHR surface) {
  std::vector<PhysicalDevice> devices;
  for (VkPhysicalDevice handle : enumerate<VkPhysicalDevice>("list GPUs", vkEnumeratePhysicalDevices, instance.get())) {
    devices.push_back(inspect(handle, static_cast<int>(devices.size()), instance.version(), surface));
  }
  return devices;
}

const PhysicalDevice& choose(const std::vector<PhysicalDevice>& devices, const std::string& wanted) {
  if (devices.empty()) {
    throw std::runtime_error("no GPU with a Vulkan driver was found (install one, e.g. mesa-vulkan-drivers)");
  }
  if (wanted.empty()) {
    if (const PhysicalDevice* chosen = best(devices)) {
      return *chosen;
    }
    throw std::runtime_error("no GPU is usable: " + devices.front().info.name + " lacks " +
                             *devices.front().info.missing + " (update its driver, or install mesa-vulkan-drivers)");
  }
  const PhysicalDevice* chosen = find(devices, wanted);
  if (!chosen) {
    throw std::runtime_error("--gpu: no GPU '" + wanted + "' (there are: " + listOf(devices) + ")");
  }
  if (chosen->info.missing) {
    throw std::runtime_error("--gpu: " + chosen->info.name + " lacks " + *chosen->info.missing +
                             " (choose another: " + listOf(devices) + ")");
  }
  return *chosen;
}

bool presentsTo(VkPhysicalDevice device, uint32_t queueFamily, VkSurfaceKHR surface) {
  VkBool32 presents = VK_FALSE;
  check(vkGetPhysicalDeviceSurfaceSupportKHR(device, queueFamily, surface, &presents), "query presentation");
  return presents;
}

}  // namespace speculum
