#include "core/device.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <ctime>
#include <set>
#include <stdexcept>
#include <system_error>
#include <thread>

#include "platform/process.hpp"
#include "platform/text.hpp"
#include "platform/window.hpp"

namespace speculum {

namespace {

VkPhysicalDeviceFeatures usedFeatures(const VkPhysicalDeviceFeatures& available) {
  return {
      .geometryShader = available.geometryShader,  // for gl_PrimitiveID in fragment shaders
      .sampleRateShading = available.sampleRateShading,
      .depthClamp = available.depthClamp,
      .fillModeNonSolid = available.fillModeNonSolid,
      .wideLines = available.wideLines,
      .samplerAnisotropy = available.samplerAnisotropy,
      .occlusionQueryPrecise = available.occlusionQueryPrecise,
      .pipelineStatisticsQuery = available.pipelineStatisticsQuery,
      .shaderClipDistance = VK_TRUE,
  };
}

// Throws if no further thread can be started. lavapipe 22.3 may then have fewer than one a core, and would wait for the
// missing ones for ever, in the first draw.
void requireThreads(const std::string& gpu) {
  try {
    std::thread([] {}).join();
  } catch (const std::system_error& error) {
    throw std::runtime_error("start the threads of " + gpu + ": " + error.code().message() + memoryLimitAdvice());
  }
}

constexpr std::array<std::string_view, 3> renderPathNames{"auto", "dynamic", "renderpass"};

}  // namespace

std::string_view renderPathName(RenderPath path) {
  return renderPathNames[static_cast<size_t>(path)];
}

std::optional<RenderPath> renderPathFromName(std::string_view name) {
  const auto found = std::ranges::find(renderPathNames, name);
  return found == renderPathNames.end() ? std::nullopt
                                        : std::optional(static_cast<RenderPath>(found - renderPathNames.begin()));
}

std::vector<DeviceInfo> Device::list() {
  const Instance instance{DeviceOptions{}};
  std::vector<DeviceInfo> infos;
  for (const PhysicalDevice& device : physicalDevices(instance, VK_NULL_HANDLE)) {
    infos.push_back(device.info);
  }
  return infos;
}

Device::Device(const DeviceOptions& options) : instance_(options) {
  if (options.window) {
    makeSurface(*options.window);
  }
  gpu_ = choose(physicalDevices(instance_, surface_.get()), options.gpu);
  choosePath(options.renderPath);
  createDevice(options);
  loadFunctions();
  setName(queue_, "graphics queue");
  if (caps().depthFormat == depthFormats.back()) {
    spdlog::warn("{} has no 32 bit depth: with 24 bits, far surfaces may cross", info().name);
  }
  spdlog::info("GPU {}: {}, {}, render path {}", info().index, info().name, info().driver, renderPathName(renderPath_));
}

void Device::choosePath(RenderPath wanted) {
  if (wanted == RenderPath::dynamic && !gpu_.caps.dynamicRendering) {
    throw std::runtime_error("--render-path dynamic: " + gpu_.info.name +
                             " has no dynamic rendering (use auto or renderpass)");
  }
  const bool dynamic = wanted == RenderPath::automatic ? gpu_.caps.dynamicRendering : wanted == RenderPath::dynamic;
  renderPath_ = dynamic ? RenderPath::dynamic : RenderPath::renderPass;
}

std::vector<const char*> Device::deviceExtensions(const DeviceOptions& options) const {
  std::vector<const char*> extensions = options.extensions;
  for (const char* name : extensions) {
    if (!gpu_.hasExtension(name)) {
      throw std::runtime_error(info().name + " has no " + name + " (update its driver, " + info().driver + ")");
    }
  }
  if (surface_) {
    extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
  }
  if (gpu_.caps.memoryBudget) {
    extensions.push_back(VK_EXT_MEMORY_BUDGET_EXTENSION_NAME);
  }
  if (gpu_.caps.rayQueries) {
    extensions.insert(extensions.end(), rayQueryExtensions.begin(), rayQueryExtensions.end());
  }
  if (!gpu_.core13) {
    extensions.push_back(VK_EXT_EXTENDED_DYNAMIC_STATE_EXTENSION_NAME);
  }
  if (gpu_.caps.dynamicPolygonMode) {
    extensions.push_back(VK_EXT_EXTENDED_DYNAMIC_STATE_3_EXTENSION_NAME);
  }
  if (!gpu_.core13 && renderPath_ == RenderPath::dynamic) {
    // Dynamic rendering needs the other extensions, unless the device has Vulkan 1.2.
    for (const char* name : {VK_KHR_DYNAMIC_RENDERING_EXTENSION_NAME, VK_KHR_DEPTH_STENCIL_RESOLVE_EXTENSION_NAME,
                             VK_KHR_CREATE_RENDERPASS_2_EXTENSION_NAME, VK_KHR_MULTIVIEW_EXTENSION_NAME,
                             VK_KHR_MAINTENANCE_2_EXTENSION_NAME}) {
      if (gpu_.hasExtension(name)) {
        extensions.push_back(name);
      }
    }
  }
  return extensions;
}

void Device::createDevice(const DeviceOptions& options) {
  const std::vector<const char*> extensions = deviceExtensions(options);
  VkPhysicalDeviceDynamicRenderingFeatures dynamic{
      .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DYNAMIC_RENDERING_FEATURES, .dynamicRendering = VK_TRUE};
  VkPhysicalDeviceExtendedDynamicStateFeaturesEXT state{
      .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_EXTENDED_DYNAMIC_STATE_FEATURES_EXT, .extendedDynamicState = VK_TRUE};
  VkPhysicalDeviceExtendedDynamicState3FeaturesEXT state3{
      .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_EXTENDED_DYNAMIC_STATE_3_FEATURES_EXT,
      .extendedDynamicState3PolygonMode = VK_TRUE};
  void* next = options.features;
  if (gpu_.caps.dynamicPolygonMode) {
    state3.pNext = std::exchange(next, &state3);
  }
  if (renderPath_ == RenderPath::dynamic) {
    dynamic.pNext = std::exchange(next, &dynamic);
  }
  if (!gpu_.core13) {
    state.pNext = std::exchange(next, &state);
  }
  RayQueryFeatures rays;
  rays.addresses.bufferDeviceAddress = VK_TRUE;
  rays.structures.accelerationStructure = VK_TRUE;
  rays.queries.rayQuery = VK_TRUE;
  if (gpu_.caps.rayQueries) {
    next = rays.chain(next);
  }
  const VkPhysicalDeviceFeatures features = usedFeatures(gpu_.features);
  const float priority = 1.0f;
  std::vector<VkDeviceQueueCreateInfo> queues;
  for (const uint32_t family : std::set{gpu_.queueFamily, gpu_.presentFamily}) {
    queues.push_back({.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                      .queueFamilyIndex = family,
                      .queueCount = 1,
                      .pQueuePriorities = &priority});
  }
  const VkDeviceCreateInfo info{.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                .pNext = next,
                                .queueCreateInfoCount = static_cast<uint32_t>(queues.size()),
                                .pQueueCreateInfos = queues.data(),
                                .enabledExtensionCount = static_cast<uint32_t>(extensions.size()),
                                .ppEnabledExtensionNames = extensions.data(),
                                .pEnabledFeatures = &features};
  VkDevice device = VK_NULL_HANDLE;
  {
    const std::lock_guard lock(loaderMutex());
    check(vkCreateDevice(gpu_.handle, &info, nullptr, &device), "create the logical device of " + gpu_.info.name);
  }
  device_.reset(device);
  if (this->info().isCpu()) {
    requireThreads(this->info().name);
  }
  vkGetDeviceQueue(device, gpu_.queueFamily, 0, &queue_);
  vkGetDeviceQueue(device, gpu_.presentFamily, 0, &presentQueue_);
}

void Device::loadFunctions() {
  const auto load = [&]<typename F>(F& function, const char* core, const char* extension) {
    function = this->function<F>(gpu_.core13 ? core : extension);
  };
  if (renderPath_ == RenderPath::dynamic) {
    load(functions_.beginRendering, "vkCmdBeginRendering", "vkCmdBeginRenderingKHR");
    load(functions_.endRendering, "vkCmdEndRendering", "vkCmdEndRenderingKHR");
  }
  load(functions_.setFrontFace, "vkCmdSetFrontFace", "vkCmdSetFrontFaceEXT");
  load(functions_.setCullMode, "vkCmdSetCullMode", "vkCmdSetCullModeEXT");
  if (gpu_.caps.dynamicPolygonMode) {
    functions_.setPolygonMode = function<PFN_vkCmdSetPolygonModeEXT>("vkCmdSetPolygonModeEXT");
  }
  if (instance_.hasDebugUtils()) {
    const auto loadInstance = [this]<typename F>(F& function, const char* name) {
      function = functionOf<F>(instance_.get(), name);
    };
    loadInstance(functions_.setName, "vkSetDebugUtilsObjectNameEXT");
    loadInstance(functions_.beginLabel, "vkCmdBeginDebugUtilsLabelEXT");
    loadInstance(functions_.endLabel, "vkCmdEndDebugUtilsLabelEXT");
  }
}

void Device::makeSurface(const Window& window) {
  const std::shared_lock lock(loaderMutex());
  surface_ = {instance_.get(), window.createSurface(instance_.get())};
}

void Device::renewSurface(const Window& window) {
  surface_.reset();
  makeSurface(window);
  if (!presentsTo(gpu_.handle, gpu_.presentFamily, surface_.get())) {
    throw std::runtime_error(gpu_.info.name + " no longer presents to this window (choose another with --gpu)");
  }
}

void Device::submit(const VkSubmitInfo& commands, VkFence fence, std::string_view what) {
  check(vkResetFences(get(), 1, &fence), "reset a fence");
  check(vkQueueSubmit(queue(), 1, &commands, fence), what);
}

// The minute is divided, so that a time in which the process was stopped counts as one second.
void Device::await(VkFence fence, std::string_view what) {
  constexpr uint64_t second = 1'000'000'000;
  constexpr int patience = 60;
  VkResult result = VK_TIMEOUT;
  for (int waited = 0; result == VK_TIMEOUT; ++waited) {
    if (waited == patience) {
      stuck_ = std::string(what) + ": " + info().name +
               " has not finished within a minute (see the kernel's log, or choose another GPU with --gpu)" +
               (info().isCpu() ? memoryLimitAdvice() : "");
      throw std::runtime_error(stuck_);
    }
    const std::clock_t before = std::clock();  // of all threads, among them those of a driver for CPUs
    result = vkWaitForFences(get(), 1, &fence, VK_TRUE, second);
    waited = info().isCpu() && std::clock() - before > CLOCKS_PER_SEC / 100 ? 0 : waited;
  }
  check(result, what);
}

void Device::settle() const {
  if (!stuck_.empty()) {
    printLine(stuck_, stderr);
    std::_Exit(2);
  }
  vkDeviceWaitIdle(device_.get());
}

VkSampleCountFlagBits Device::sampleCount(int wanted) {
  const auto asked = static_cast<VkSampleCountFlags>(std::clamp(wanted, 1, 64));
  const VkSampleCountFlags count = std::bit_floor(gpu_.caps.sampleCounts & (2 * std::bit_floor(asked) - 1));
  if (count != asked && !(reportedSampleCounts_ & asked)) {
    reportedSampleCounts_ |= asked;
    spdlog::warn("{} has no {} samples per pixel: {} are used", gpu_.info.name, wanted, count);
  }
  return static_cast<VkSampleCountFlagBits>(count);
}

float Device::anisotropy(float wanted) const {
  return gpu_.caps.anisotropy ? std::min(wanted, limits().maxSamplerAnisotropy) : 1.0f;
}

float Device::lineWidth(float wanted) {
  const float width = std::min(wanted, gpu_.caps.wideLines ? limits().lineWidthRange[1] : 1.0f);
  if (width < wanted && !std::exchange(reportedLineWidth_, true)) {
    spdlog::warn("{} has no lines {} pixels wide: {} is used", gpu_.info.name, wanted, width);
  }
  return width;
}

MemoryBudget Device::memoryBudget() const {
  VkPhysicalDeviceMemoryBudgetPropertiesEXT budget{.sType =
                                                       VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_BUDGET_PROPERTIES_EXT};
  VkPhysicalDeviceMemoryProperties2 properties{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_PROPERTIES_2,
                                               .pNext = gpu_.caps.memoryBudget ? &budget : nullptr};
  vkGetPhysicalDeviceMemoryProperties2(gpu_.handle, &properties);
  MemoryBudget result{.usedBytes = gpu_.caps.memoryBudget ? 0 : memory_.bytes()};
  for (uint32_t heap = 0; heap < properties.memoryProperties.memoryHeapCount; ++heap) {
    const VkMemoryHeap& description = properties.memoryProperties.memoryHeaps[heap];
    if (description.flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) {
      result.budgetBytes += gpu_.caps.memoryBudget ? budget.heapBudget[heap] : description.size;
      result.usedBytes += gpu_.caps.memoryBudget ? budget.heapUsage[heap] : 0;
    }
  }
  return result;
}

void Device::setObjectName(VkObjectType type, uint64_t object, std::string_view name) const {
  if (functions_.setName) {
    const std::string text(name);
    const VkDebugUtilsObjectNameInfoEXT info{.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT,
                                             .objectType = type,
                                             .objectHandle = object,
                                             .pObjectName = text.c_str()};
    const std::shared_lock lock(loaderMutex());
    functions_.setName(device_.get(), &info);  // ignores failure: the name is for debugging only
  }
}

void Device::beginLabel(VkCommandBuffer commands, std::string_view name) const {
  if (functions_.beginLabel) {
    const std::string text(name);
    const VkDebugUtilsLabelEXT label{.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT, .pLabelName = text.c_str()};
    functions_.beginLabel(commands, &label);
  }
}

void Device::endLabel(VkCommandBuffer commands) const {
  if (functions_.endLabel) {
    functions_.endLabel(commands);
  }
}

}  // namespace speculum
