// A Vulkan layer for tests, which environment variables steer:
//   SPECULUM_FAULT        "FUNCTION N RESULT": the N-th call (from 1) returns RESULT, a number; VK_INCOMPLETE from the
//                         first call from there on that asks for more than a count
//   SPECULUM_FAULT_AFTER  a file: calls before it exists do not fail
//   SPECULUM_FAULT_CALLS  a file that gets a line "FUNCTION CALLS" for each function when the instance ends, and a line
//                         "pipelines_without_cache CALLS"
//   SPECULUM_HIDE         words for what the devices lack: NAME, NAME=VALUE, NAME@DEVICE; see hidden() and limited().
//                         The name of a function: there is none
// It supports one instance with one device at a time.
#include <unistd.h>
#include <vulkan/vk_layer.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "failing_functions.hpp"

namespace {

// The headers of X11 declare these; the layer only passes their arguments on.
using PFN_vkCreateXcbSurfaceKHR = VkResult(VKAPI_PTR*)(VkInstance, const void*, const VkAllocationCallbacks*,
                                                       VkSurfaceKHR*);
using PFN_vkCreateXlibSurfaceKHR = PFN_vkCreateXcbSurfaceKHR;

// Functions that are watched or changed but do not fail in this program.
#define SPECULUM_WATCHED_FUNCTIONS(X)          \
  X(vkGetPhysicalDeviceFeatures)               \
  X(vkGetPhysicalDeviceFeatures2)              \
  X(vkGetPhysicalDeviceProperties)             \
  X(vkGetPhysicalDeviceProperties2)            \
  X(vkGetPhysicalDeviceQueueFamilyProperties)  \
  X(vkGetPhysicalDeviceQueueFamilyProperties2) \
  X(vkGetDeviceQueue)                          \
  X(vkDestroyDevice)                           \
  X(vkDestroyInstance)

// One state for each function.
struct Function {
  const char* name;
  PFN_vkVoidFunction hook;
  bool reportsLoss;
  PFN_vkVoidFunction next = nullptr;
  std::atomic<int> calls = 0;
};
#define SPECULUM_FUNCTION(NAME, ...) \
  struct NAME##_ {                   \
    using Type = PFN_##NAME;         \
    static Function function;        \
  };
SPECULUM_FAILING_FUNCTIONS(SPECULUM_FUNCTION)
SPECULUM_WATCHED_FUNCTIONS(SPECULUM_FUNCTION)

struct Fault {
  std::string function;
  int call = 0;
  VkResult result = VK_SUCCESS;

  bool waits() const {
    const char* file = std::getenv("SPECULUM_FAULT_AFTER");
    return file && access(file, F_OK) != 0;
  }
};
Fault readFault() {
  Fault fault;
  if (const char* text = std::getenv("SPECULUM_FAULT")) {
    int result = 0;
    std::istringstream(text) >> fault.function >> fault.call >> result;
    fault.result = static_cast<VkResult>(result);
  }
  return fault;
}

// A queue of a family that the layer adds. The loader reads the first member of every dispatchable object.
struct PresentQueue {
  void* loaderTable = nullptr;
};

struct State {
  Fault fault = readFault();
  VkInstance instance = VK_NULL_HANDLE;
  PFN_vkGetInstanceProcAddr nextInstanceProc = nullptr;
  VkDevice device = VK_NULL_HANDLE;
  PFN_vkGetDeviceProcAddr nextDeviceProc = nullptr;
  std::vector<VkPhysicalDevice> devices;
  bool lost = false;
  bool addsFamily = false;            // to the device
  std::atomic<int> withoutCache = 0;  // graphics pipelines
  VkQueue queue = VK_NULL_HANDLE;
  PresentQueue presentQueue;
};
State state;

// Returns the value of NAME in SPECULUM_HIDE for this device; 1 for a word without a value.
std::optional<uint32_t> limited(const std::string& name, VkPhysicalDevice device) {
  const char* text = std::getenv("SPECULUM_HIDE");
  std::istringstream words(text ? text : "");
  for (std::string word; words >> word;) {
    const size_t at = word.find('@');
    if (at != std::string::npos) {
      const size_t index = std::stoul(word.substr(at + 1));
      if (index >= state.devices.size() || state.devices[index] != device) {
        continue;
      }
      word.resize(at);
    }
    const size_t equals = word.find('=');
    if (word.substr(0, equals) == name) {
      return equals == std::string::npos ? 1 : static_cast<uint32_t>(std::stoul(word.substr(equals + 1)));
    }
  }
  return std::nullopt;
}
bool hidden(const std::string& name, VkPhysicalDevice device) {
  return limited(name, device).has_value();
}

template <typename Tag, typename... Arguments>
auto next(Arguments... arguments) {
  return reinterpret_cast<typename Tag::Type>(Tag::function.next)(arguments...);
}

// forward(Tag, arguments...) calls the layer below; overloads change its results.
template <typename Tag, typename... Arguments>
auto forward(Tag, Arguments... arguments) {
  return next<Tag>(arguments...);
}

void hide(VkPhysicalDevice device, VkPhysicalDeviceFeatures& features) {
  const auto off = [&](const char* name, VkBool32& feature) { feature = feature && !hidden(name, device); };
  off("clip_distance", features.shaderClipDistance);
  off("primitive_id", features.geometryShader);
  off("sample_shading", features.sampleRateShading);
  off("depth_clamp", features.depthClamp);
  off("lines", features.fillModeNonSolid);
  off("wide_lines", features.wideLines);
  off("anisotropy", features.samplerAnisotropy);
  off("precise_counts", features.occlusionQueryPrecise);
  off("statistics", features.pipelineStatisticsQuery);
}
void hide(VkPhysicalDevice device, VkPhysicalDeviceProperties& properties) {
  VkPhysicalDeviceLimits& limits = properties.limits;
  const auto lower = [&](const char* name, uint32_t& limit) { limit = limited(name, device).value_or(limit); };
  if (const auto minor = limited("vulkan", device)) {
    properties.apiVersion = VK_MAKE_API_VERSION(0, 1, *minor, 0);
  }
  lower("storage_buffers", limits.maxPerStageDescriptorStorageBuffers);
  lower("storage_range", limits.maxStorageBufferRange);
  lower("image_side", limits.maxImageDimension2D);
  lower("allocations", limits.maxMemoryAllocationCount);
  lower("color_samples", limits.framebufferColorSampleCounts);
  lower("depth_samples", limits.framebufferDepthSampleCounts);
  if (hidden("timestamps", device)) {
    limits.timestampPeriod = 0.0f;
    limits.timestampComputeAndGraphics = VK_FALSE;
  }
}
void hide(VkPhysicalDevice device, VkQueueFamilyProperties& family) {
  if (hidden("timestamps", device)) {
    family.timestampValidBits = 0;
  }
  if (hidden("graphics", device)) {
    family.queueFlags &= ~VkQueueFlags{VK_QUEUE_GRAPHICS_BIT};
  }
}

void forward(vkGetPhysicalDeviceFeatures_, VkPhysicalDevice device, VkPhysicalDeviceFeatures* features) {
  next<vkGetPhysicalDeviceFeatures_>(device, features);
  hide(device, *features);
}
void forward(vkGetPhysicalDeviceFeatures2_, VkPhysicalDevice device, VkPhysicalDeviceFeatures2* features) {
  next<vkGetPhysicalDeviceFeatures2_>(device, features);
  hide(device, features->features);
}
void forward(vkGetPhysicalDeviceProperties_, VkPhysicalDevice device, VkPhysicalDeviceProperties* properties) {
  next<vkGetPhysicalDeviceProperties_>(device, properties);
  hide(device, *properties);
}
void forward(vkGetPhysicalDeviceProperties2_, VkPhysicalDevice device, VkPhysicalDeviceProperties2* properties) {
  next<vkGetPhysicalDeviceProperties2_>(device, properties);
  hide(device, properties->properties);
}

// With present_queue a second family follows, which presents and does not draw.
template <typename Tag, typename Property>
void families(VkPhysicalDevice device, uint32_t* count, Property* properties,
              VkQueueFamilyProperties& (*plain)(Property&)) {
  const bool adds = hidden("present_queue", device);
  uint32_t below = 1;
  if (!properties) {
    next<Tag>(device, count, properties);
    *count += adds;
    return;
  }
  next<Tag>(device, adds ? &below : count, properties);
  if (adds && *count > 1) {
    plain(properties[1]) = plain(properties[0]);
    plain(properties[1]).queueFlags = VK_QUEUE_TRANSFER_BIT;
    *count = 2;
  }
  std::for_each(properties, properties + *count, [&](Property& property) { hide(device, plain(property)); });
}
void forward(vkGetPhysicalDeviceQueueFamilyProperties_ tag, VkPhysicalDevice device, uint32_t* count,
             VkQueueFamilyProperties* properties) {
  families<decltype(tag), VkQueueFamilyProperties>(
      device, count, properties, [](auto& p) -> auto& { return p; });
}
void forward(vkGetPhysicalDeviceQueueFamilyProperties2_ tag, VkPhysicalDevice device, uint32_t* count,
             VkQueueFamilyProperties2* properties) {
  families<decltype(tag), VkQueueFamilyProperties2>(
      device, count, properties, [](VkQueueFamilyProperties2 & p) -> auto& { return p.queueFamilyProperties; });
}

VkResult forward(vkEnumeratePhysicalDevices_, VkInstance instance, uint32_t* count, VkPhysicalDevice* devices) {
  const VkResult result = next<vkEnumeratePhysicalDevices_>(instance, count, devices);
  if (devices) {
    state.devices.assign(devices, devices + *count);
  }
  return result;
}
VkResult forward(vkEnumerateDeviceExtensionProperties_, VkPhysicalDevice device, const char* layer, uint32_t* count,
                 VkExtensionProperties* properties) {
  const VkResult result = next<vkEnumerateDeviceExtensionProperties_>(device, layer, count, properties);
  for (uint32_t i = 0; properties && i < *count; ++i) {
    char* name = properties[i].extensionName;
    if (hidden(name, device)) {
      std::strcpy(name, "VK_SPECULUM_hidden");
    }
  }
  return result;
}
VkResult forward(vkGetPhysicalDeviceImageFormatProperties_, VkPhysicalDevice device, VkFormat format, VkImageType type,
                 VkImageTiling tiling, VkImageUsageFlags usage, VkImageCreateFlags flags,
                 VkImageFormatProperties* properties) {
  const VkResult result =
      next<vkGetPhysicalDeviceImageFormatProperties_>(device, format, type, tiling, usage, flags, properties);
  const bool depth = usage & VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
  const char* sampled =
      usage & VK_IMAGE_USAGE_SAMPLED_BIT ? depth ? "sampled_depth_samples" : "sampled_color_samples" : "";
  properties->sampleCounts &= limited(sampled, device).value_or(~0u);
  const bool lacks = (format == VK_FORMAT_D32_SFLOAT && hidden("D32", device)) ||
                     (format == VK_FORMAT_D32_SFLOAT_S8_UINT && hidden("D32_S8", device));
  return lacks ? VK_ERROR_FORMAT_NOT_SUPPORTED : result;
}
VkResult forward(vkGetPhysicalDeviceSurfaceSupportKHR_, VkPhysicalDevice device, uint32_t family, VkSurfaceKHR surface,
                 VkBool32* presents) {
  const bool made = hidden("present_queue", device);
  const VkResult result = next<vkGetPhysicalDeviceSurfaceSupportKHR_>(device, made ? 0 : family, surface, presents);
  *presents = *presents && !hidden("present", device) && (!made || family == 1);
  return result;
}
VkResult forward(vkGetPhysicalDeviceSurfaceCapabilitiesKHR_, VkPhysicalDevice device, VkSurfaceKHR surface,
                 VkSurfaceCapabilitiesKHR* capabilities) {
  const VkResult result = next<vkGetPhysicalDeviceSurfaceCapabilitiesKHR_>(device, surface, capabilities);
  if (hidden("transfer_src", device)) {
    capabilities->supportedUsageFlags &= ~VkImageUsageFlags{VK_IMAGE_USAGE_TRANSFER_SRC_BIT};
  }
  if (const auto most = limited("swapchain_images", device)) {
    capabilities->minImageCount = std::min(capabilities->minImageCount, *most);
    capabilities->maxImageCount = *most;
  }
  return result;
}

VkResult forward(vkGetPhysicalDeviceSurfaceFormatsKHR_, VkPhysicalDevice device, VkSurfaceKHR surface, uint32_t* count,
                 VkSurfaceFormatKHR* formats) {
  if (!hidden("unorm_formats", device)) {
    return next<vkGetPhysicalDeviceSurfaceFormatsKHR_>(device, surface, count, formats);
  }
  std::array<VkSurfaceFormatKHR, 64> all;
  uint32_t found = all.size();
  const VkResult result = next<vkGetPhysicalDeviceSurfaceFormatsKHR_>(device, surface, &found, all.data());
  const auto end = std::remove_if(all.begin(), all.begin() + found, [](const VkSurfaceFormatKHR& format) {
    return format.format == VK_FORMAT_B8G8R8A8_UNORM || format.format == VK_FORMAT_R8G8B8A8_UNORM;
  });
  const auto left = static_cast<uint32_t>(end - all.begin());
  *count = formats ? std::min(*count, left) : left;
  std::copy_n(all.begin(), formats ? *count : 0, formats);
  return result;
}

void forward(vkGetDeviceQueue_, VkDevice device, uint32_t family, uint32_t index, VkQueue* queue) {
  const bool made = state.addsFamily && family == 1;
  next<vkGetDeviceQueue_>(device, made ? 0 : family, index, queue);
  if (made) {
    state.queue = *queue;
    state.presentQueue.loaderTable = *reinterpret_cast<void**>(state.queue);
    *queue = reinterpret_cast<VkQueue>(&state.presentQueue);
  }
}
// With images=N, no image is free at first, N times.
VkResult forward(vkAcquireNextImageKHR_ tag, VkDevice device, VkSwapchainKHR swapchain, uint64_t timeout,
                 VkSemaphore semaphore, VkFence fence, uint32_t* index) {
  if (decltype(tag)::function.calls <= static_cast<int>(limited("images", VK_NULL_HANDLE).value_or(0))) {
    return VK_TIMEOUT;
  }
  // Refuses to wait for ever, as a window that is covered would.
  return timeout == UINT64_MAX ? VK_ERROR_UNKNOWN
                               : next<vkAcquireNextImageKHR_>(device, swapchain, timeout, semaphore, fence, index);
}
// With signals, no fence is ever signalled, and time flies.
VkResult forward(vkWaitForFences_, VkDevice device, uint32_t count, const VkFence* fences, VkBool32 all,
                 uint64_t timeout) {
  return hidden("signals", VK_NULL_HANDLE) ? VK_TIMEOUT : next<vkWaitForFences_>(device, count, fences, all, timeout);
}
VkResult forward(vkCreateGraphicsPipelines_, VkDevice device, VkPipelineCache cache, uint32_t count,
                 const VkGraphicsPipelineCreateInfo* infos, const VkAllocationCallbacks* callbacks,
                 VkPipeline* pipelines) {
  state.withoutCache += cache == VK_NULL_HANDLE;
  return next<vkCreateGraphicsPipelines_>(device, cache, count, infos, callbacks, pipelines);
}
VkResult forward(vkQueuePresentKHR_, VkQueue queue, const VkPresentInfoKHR* info) {
  const bool made = queue == reinterpret_cast<VkQueue>(&state.presentQueue);
  return next<vkQueuePresentKHR_>(made ? state.queue : queue, info);
}

VkResult forward(vkCreateInstance_, const VkInstanceCreateInfo* info, const VkAllocationCallbacks* callbacks,
                 VkInstance* instance);
VkResult forward(vkCreateDevice_, VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                 const VkAllocationCallbacks* callbacks, VkDevice* device);
void forward(vkDestroyInstance_, VkInstance instance, const VkAllocationCallbacks* callbacks);
void forward(vkDestroyDevice_, VkDevice device, const VkAllocationCallbacks* callbacks) {
  next<vkDestroyDevice_>(device, callbacks);
  state.device = VK_NULL_HANDLE;
  state.lost = false;
}

// Says whether a call only reads the number of items, so that it cannot be incomplete.
template <typename... Arguments>
bool counts(const Arguments&... arguments) {
  const auto last = std::get<sizeof...(arguments) - 1>(std::tie(arguments...));
  if constexpr (std::is_pointer_v<decltype(last)>) {
    return !last;
  }
  return false;
}

// Says whether a call has its effect although it returns `result`.
bool takesEffect(VkResult result, const Function& function) {
  return result == VK_SUBOPTIMAL_KHR || result == VK_INCOMPLETE ||
         (&function == &vkQueuePresentKHR_::function &&
          (result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_ERROR_SURFACE_LOST_KHR));
}

// Finishes the device's work, then makes all functions that can report it return that the device is lost.
void lose() {
  if (state.device) {
    next<vkDeviceWaitIdle_>(state.device);
    state.lost = true;
  }
}

template <typename Tag, typename Type>
struct Hook;
template <typename Tag, typename Result, typename... Arguments>
struct Hook<Tag, Result(VKAPI_PTR*)(Arguments...)> {
  static VKAPI_ATTR Result VKAPI_CALL call(Arguments... arguments) {
    Function& function = Tag::function;
    const int number = ++function.calls;
    if constexpr (std::is_same_v<Result, VkResult>) {
      Fault& fault = state.fault;
      if (fault.function == function.name && fault.call == number) {
        if ((fault.result == VK_INCOMPLETE && counts(arguments...)) || fault.waits()) {
          ++fault.call;
          return forward(Tag{}, arguments...);
        }
        unsetenv("SPECULUM_FAULT");  // once, although the loader unloads the layer between two instances
        const VkResult happened = takesEffect(fault.result, function) ? forward(Tag{}, arguments...) : VK_SUCCESS;
        if (fault.result == VK_ERROR_DEVICE_LOST) {
          lose();
        }
        return happened == VK_SUCCESS ? fault.result : happened;
      }
      if (state.lost && function.reportsLoss) {
        return VK_ERROR_DEVICE_LOST;
      }
    }
    return forward(Tag{}, arguments...);
  }
};

bool contains(std::initializer_list<VkResult> results, VkResult wanted) {
  return std::find(results.begin(), results.end(), wanted) != results.end();
}
#define SPECULUM_DEFINE(NAME, ...)                                                                             \
  Function NAME##_::function = {#NAME, reinterpret_cast<PFN_vkVoidFunction>(&Hook<NAME##_, PFN_##NAME>::call), \
                                contains({__VA_ARGS__}, VK_ERROR_DEVICE_LOST)};
SPECULUM_FAILING_FUNCTIONS(SPECULUM_DEFINE)
SPECULUM_WATCHED_FUNCTIONS(SPECULUM_DEFINE)

#define SPECULUM_ADDRESS(NAME, ...) &NAME##_::function,
const std::array functions = {SPECULUM_FAILING_FUNCTIONS(SPECULUM_ADDRESS)
                                  SPECULUM_WATCHED_FUNCTIONS(SPECULUM_ADDRESS)};

Function* find(const char* name) {
  const auto known = std::find_if(functions.begin(), functions.end(),
                                  [&](const Function* function) { return std::strcmp(function->name, name) == 0; });
  return known == functions.end() ? nullptr : *known;
}

void forward(vkDestroyInstance_, VkInstance instance, const VkAllocationCallbacks* callbacks) {
  next<vkDestroyInstance_>(instance, callbacks);
  if (const char* file = std::getenv("SPECULUM_FAULT_CALLS")) {
    std::ofstream stream(file);
    for (const Function* function : functions) {
      stream << function->name << ' ' << function->calls << '\n';
    }
    stream << "pipelines_without_cache " << state.withoutCache << '\n';
  }
  for (Function* function : functions) {
    function->next = nullptr;
  }
}

// Returns the loader's link to the layer below, from the chain of a create info, and advances it for that layer.
template <typename Link>
auto* takeLink(const void* chain, VkStructureType type) {
  auto* link = reinterpret_cast<Link*>(const_cast<void*>(chain));
  while (link && !(link->sType == type && link->function == VK_LAYER_LINK_INFO)) {
    link = reinterpret_cast<Link*>(const_cast<void*>(link->pNext));
  }
  auto* taken = link->u.pLayerInfo;
  link->u.pLayerInfo = taken->pNext;
  return taken;
}

VkResult forward(vkCreateInstance_, const VkInstanceCreateInfo* info, const VkAllocationCallbacks* callbacks,
                 VkInstance* instance) {
  const auto* link = takeLink<VkLayerInstanceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
  state.nextInstanceProc = link->pfnNextGetInstanceProcAddr;
  const auto create = reinterpret_cast<PFN_vkCreateInstance>(state.nextInstanceProc(nullptr, "vkCreateInstance"));
  const VkResult result = create(info, callbacks, instance);
  state.instance = *instance;
  return result;
}
VkResult forward(vkCreateDevice_, VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                 const VkAllocationCallbacks* callbacks, VkDevice* device) {
  const auto* link = takeLink<VkLayerDeviceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
  state.nextDeviceProc = link->pfnNextGetDeviceProcAddr;
  const auto create =
      reinterpret_cast<PFN_vkCreateDevice>(link->pfnNextGetInstanceProcAddr(state.instance, "vkCreateDevice"));
  VkDeviceCreateInfo below = *info;
  state.addsFamily = hidden("present_queue", physical);
  if (state.addsFamily) {
    below.queueCreateInfoCount = 1;  // of the family that is there
  }
  const VkResult result = create(physical, &below, callbacks, device);
  state.device = result == VK_SUCCESS ? *device : VK_NULL_HANDLE;
  if (state.device) {
    vkDeviceWaitIdle_::function.next = state.nextDeviceProc(*device, "vkDeviceWaitIdle");
  }
  return result;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL deviceProc(VkDevice device, const char* name) {
  if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) {
    return reinterpret_cast<PFN_vkVoidFunction>(&deviceProc);
  }
  const PFN_vkVoidFunction below = hidden(name, VK_NULL_HANDLE) ? nullptr : state.nextDeviceProc(device, name);
  Function* function = find(name);
  if (!below || !function) {
    return below;
  }
  function->next = below;
  return function->hook;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL instanceProc(VkInstance instance, const char* name) {
  if (std::strcmp(name, "vkGetInstanceProcAddr") == 0) {
    return reinterpret_cast<PFN_vkVoidFunction>(&instanceProc);
  }
  if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) {
    return reinterpret_cast<PFN_vkVoidFunction>(&deviceProc);
  }
  Function* function = find(name);
  const PFN_vkVoidFunction below = instance && state.nextInstanceProc && !hidden(name, VK_NULL_HANDLE)
                                       ? state.nextInstanceProc(instance, name)
                                       : nullptr;
  if (!function || (!below && instance && function != &vkCreateInstance_::function)) {
    return below;
  }
  function->next = function->next ? function->next : below;
  return function->hook;
}

// Functions that are called before there is an instance get the layer below with each call. The loader loads and
// unloads this layer for each, so that only a first call can fail.
template <typename Tag, typename Chain, typename... Arguments>
VkResult before(const Chain* chain, Arguments... arguments) {
  const Fault fault = state.fault;
  if (fault.function != Tag::function.name || (fault.result == VK_INCOMPLETE && counts(arguments...))) {
    return chain->pfnNextLayer(chain->pNextLink, arguments...);
  }
  unsetenv("SPECULUM_FAULT");
  state.fault = {};
  const VkResult happened =
      fault.result == VK_INCOMPLETE ? chain->pfnNextLayer(chain->pNextLink, arguments...) : VK_SUCCESS;
  return happened == VK_SUCCESS ? fault.result : happened;
}

}  // namespace

extern "C" {
VKAPI_ATTR VkResult VKAPI_CALL vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* interface) {
  interface->loaderLayerInterfaceVersion = 2;
  interface->pfnGetInstanceProcAddr = &instanceProc;
  interface->pfnGetDeviceProcAddr = &deviceProc;
  interface->pfnGetPhysicalDeviceProcAddr = nullptr;
  return VK_SUCCESS;
}
VKAPI_ATTR VkResult VKAPI_CALL faultInstanceExtensions(const VkEnumerateInstanceExtensionPropertiesChain* chain,
                                                       const char* layer, uint32_t* count,
                                                       VkExtensionProperties* properties) {
  return before<vkEnumerateInstanceExtensionProperties_>(chain, layer, count, properties);
}
VKAPI_ATTR VkResult VKAPI_CALL faultInstanceLayers(const VkEnumerateInstanceLayerPropertiesChain* chain,
                                                   uint32_t* count, VkLayerProperties* properties) {
  return before<vkEnumerateInstanceLayerProperties_>(chain, count, properties);
}
VKAPI_ATTR VkResult VKAPI_CALL faultInstanceVersion(const VkEnumerateInstanceVersionChain* chain, uint32_t* version) {
  const VkResult result = before<vkEnumerateInstanceVersion_>(chain, version);
  if (const auto minor = limited("loader", VK_NULL_HANDLE)) {
    *version = VK_MAKE_API_VERSION(0, 1, *minor, 0);
  }
  return result;
}
}
