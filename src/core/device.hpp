#pragma once

#include <vulkan/vulkan.h>

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/barriers.hpp"
#include "core/device_memory.hpp"
#include "core/handle.hpp"
#include "core/loader.hpp"
#include "core/physical_device.hpp"
#include "core/retire_queue.hpp"
#include "core/vulkan_result.hpp"

namespace speculum {

class Window;

enum class RenderPath { automatic, dynamic, renderPass };
std::string_view renderPathName(RenderPath path);  // auto, dynamic, renderpass
std::optional<RenderPath> renderPathFromName(std::string_view name);

struct DeviceOptions {
  std::string gpu;           // index, or part of the name in any case; empty: the best GPU
  bool validation = false;   // core and synchronisation validation of VK_LAYER_KHRONOS_validation
  Window* window = nullptr;  // null: headless, without any surface extension
  RenderPath renderPath = RenderPath::automatic;
  // Device extensions besides those that Device enables by itself; the constructor throws if one is missing.
  std::vector<const char*> extensions;
  void* features = nullptr;  // chain of feature structures for `extensions`; must live until the constructor returns
};

// Device-local memory. A driver without VK_EXT_memory_budget gives no advice: then the budget is the size of the heaps,
// and only what this Device has allocated counts as used.
struct MemoryBudget {
  uint64_t budgetBytes = 0;  // that this process may use
  uint64_t usedBytes = 0;    // that this process uses
};

// Functions that the Vulkan loader does not export. The first four are of Vulkan 1.3 or of the extensions that became
// part of it; setPolygonMode is null without DeviceCaps::dynamicPolygonMode, the last three without VK_EXT_debug_utils.
struct DeviceFunctions {
  PFN_vkCmdBeginRendering beginRendering = nullptr;
  PFN_vkCmdEndRendering endRendering = nullptr;
  PFN_vkCmdSetFrontFace setFrontFace = nullptr;
  PFN_vkCmdSetCullMode setCullMode = nullptr;
  PFN_vkCmdSetPolygonModeEXT setPolygonMode = nullptr;
  PFN_vkSetDebugUtilsObjectNameEXT setName = nullptr;
  PFN_vkCmdBeginDebugUtilsLabelEXT beginLabel = nullptr;
  PFN_vkCmdEndDebugUtilsLabelEXT endLabel = nullptr;
};

// Layouts by the binding, type, count and stages of each of their bindings.
using SetLayouts = std::map<std::vector<std::array<uint32_t, 4>>, DescriptorSetLayoutHandle>;

// Instance, the chosen GPU, logical device, its one queue and, where that queue cannot present, a second one that can.
// Must outlive everything made from it.
class Device {
 public:
  // Throws std::runtime_error if there is no Vulkan, no usable GPU, or if an option cannot be met.
  explicit Device(const DeviceOptions& options);
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  // Returns every GPU that the loader offers, for `speculum info`. Throws std::runtime_error if there is no Vulkan.
  static std::vector<DeviceInfo> list();

  VkInstance instance() const { return instance_.get(); }
  VkPhysicalDevice physical() const { return gpu_.handle; }
  VkDevice get() const { return device_.get(); }
  VkQueue queue() const { return queue_; }
  uint32_t queueFamily() const { return gpu_.queueFamily; }
  VkQueue presentQueue() const { return presentQueue_; }  // equals queue() if that queue can present
  uint32_t presentFamily() const { return gpu_.presentFamily; }
  VkSurfaceKHR surface() const { return surface_.get(); }  // null when headless
  // Creates a new surface after VK_ERROR_SURFACE_LOST_KHR. No swapchain may exist.
  void renewSurface(const Window& window);
  const DeviceInfo& info() const { return gpu_.info; }
  const DeviceCaps& caps() const { return gpu_.caps; }
  const VkPhysicalDeviceLimits& limits() const { return gpu_.properties.limits; }
  const VkPhysicalDeviceProperties& properties() const { return gpu_.properties; }
  RenderPath renderPath() const { return renderPath_; }  // dynamic or renderPass
  bool validation() const { return instance_.validation(); }

  // Returns the wanted number of samples a pixel, or the next lower one that the device has. Logs once for each wanted
  // number that the device lacks.
  VkSampleCountFlagBits sampleCount(int wanted);
  // Returns the wanted anisotropy of a sampler, or the greatest that the device has; 1: none.
  float anisotropy(float wanted) const;
  // Returns the wanted width of lines (pixels, at least 1), or the widest that the device has. Logs once if it lacks
  // it.
  float lineWidth(float wanted);

  Barriers& barriers() { return barriers_; }
  // For descriptorSetLayout() and PipelineFactory. One thread at a time.
  SetLayouts& setLayouts() { return setLayouts_; }
  SparePipelines& sparePipelines() { return sparePipelines_; }
  void waitIdle() const { check(vkDeviceWaitIdle(device_.get()), "wait for the GPU"); }
  // Submits commands that signal the fence. It is reset first, not after a wait, so that a wait in vain leaves no fence
  // that the next submission could not use.
  void submit(const VkSubmitInfo& commands, VkFence fence, std::string_view what);
  // Waits for the fence. Throws std::runtime_error if the GPU does not finish within a minute; `what` says what is
  // waited for. A driver for CPUs has as much time as it computes.
  void await(VkFence fence, std::string_view what);
  // Waits until nothing is in use, so that objects may be destroyed. After an await() in vain this would take for ever:
  // it ends the process instead, with one line and exit code 2.
  void settle() const;

  // Warnings and errors of the validation layer since the start; 0 is the only good figure.
  int validationMessages() const { return instance_.messages().count(); }

  MemoryBlocks& memory() { return memory_; }
  uint64_t allocatedBytes() const { return memory_.usedBytes(); }  // of live buffers and images
  uint32_t allocations() const { return memory_.allocations(); }   // of memory, which may hold many of these
  MemoryBudget memoryBudget() const;

  // Creates a named object: create(vkCreateFence, {.sType = ...}, "upload"). Throws as throwVulkanError() does.
  template <typename Info, typename T>
  Handle<T> create(VkResult (*function)(VkDevice, const Info*, const VkAllocationCallbacks*, T*),
                   const std::type_identity_t<Info>& info, std::string_view name) const {
    T object = VK_NULL_HANDLE;
    const VkResult result = function(get(), &info, nullptr, &object);
    if (result != VK_SUCCESS) {
      throwVulkanError(result, "create " + std::string(ObjectTraits<T>::name) + " " + std::string(name));
    }
    setName(object, name);
    return {get(), object};
  }
  template <typename T>
  void setName(T object, std::string_view name) const {
    setObjectName(ObjectTraits<T>::type, reinterpret_cast<uint64_t>(object), name);
  }
  // Begin and end a debug label in the commands; do nothing without VK_EXT_debug_utils.
  void beginLabel(VkCommandBuffer commands, std::string_view name) const;
  void endLabel(VkCommandBuffer commands) const;
  const DeviceFunctions& functions() const { return functions_; }
  // Returns a function that the loader does not export. Throws std::runtime_error with its name if there is none.
  template <typename F>
  F function(const char* name) const {
    return functionOf<F>(get(), name);
  }

 private:
  struct Destroy {
    using pointer = VkDevice;
    void operator()(VkDevice device) const {
      const std::lock_guard lock(loaderMutex());
      vkDestroyDevice(device, nullptr);
    }
  };

  void makeSurface(const Window& window);
  void choosePath(RenderPath wanted);
  std::vector<const char*> deviceExtensions(const DeviceOptions& options) const;
  void createDevice(const DeviceOptions& options);
  void loadFunctions();
  void setObjectName(VkObjectType type, uint64_t object, std::string_view name) const;

  Instance instance_;
  SurfaceHandle surface_;
  PhysicalDevice gpu_;
  RenderPath renderPath_ = RenderPath::dynamic;
  std::unique_ptr<VkDevice, Destroy> device_;
  VkQueue queue_ = VK_NULL_HANDLE;
  VkQueue presentQueue_ = VK_NULL_HANDLE;
  DeviceFunctions functions_;
  Barriers barriers_;
  SetLayouts setLayouts_;
  SparePipelines sparePipelines_;
  MemoryBlocks memory_;
  VkSampleCountFlags reportedSampleCounts_ = 0;
  bool reportedLineWidth_ = false;
  std::string stuck_;  // why the GPU is not waited for any more; empty as long as it is
};

// Waits for the GPU when it is destroyed. Make it the last member of a class that owns objects of frames in flight.
class IdleGuard {
 public:
  explicit IdleGuard(const Device& device) : device_(device) {}
  ~IdleGuard() { device_.settle(); }
  IdleGuard(const IdleGuard&) = delete;
  IdleGuard& operator=(const IdleGuard&) = delete;

 private:
  const Device& device_;
};

}  // namespace speculum
