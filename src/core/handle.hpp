#pragma once

#include <vulkan/vulkan.h>

#include <atomic>
#include <cstdint>
#include <map>
#include <string>
#include <utility>

namespace speculum {

// Which VkObjectType a handle type has; also the key under which live handles are counted.
template <typename T>
constexpr VkObjectType objectType() = delete;

#define SPECULUM_OBJECT_TYPE(TYPE, VALUE)     \
  template <>                                 \
  constexpr VkObjectType objectType<TYPE>() { \
    return VALUE;                             \
  }
SPECULUM_OBJECT_TYPE(VkInstance, VK_OBJECT_TYPE_INSTANCE)
SPECULUM_OBJECT_TYPE(VkDevice, VK_OBJECT_TYPE_DEVICE)
SPECULUM_OBJECT_TYPE(VkQueue, VK_OBJECT_TYPE_QUEUE)
SPECULUM_OBJECT_TYPE(VkCommandBuffer, VK_OBJECT_TYPE_COMMAND_BUFFER)
SPECULUM_OBJECT_TYPE(VkCommandPool, VK_OBJECT_TYPE_COMMAND_POOL)
SPECULUM_OBJECT_TYPE(VkSemaphore, VK_OBJECT_TYPE_SEMAPHORE)
SPECULUM_OBJECT_TYPE(VkFence, VK_OBJECT_TYPE_FENCE)
SPECULUM_OBJECT_TYPE(VkDeviceMemory, VK_OBJECT_TYPE_DEVICE_MEMORY)
SPECULUM_OBJECT_TYPE(VkBuffer, VK_OBJECT_TYPE_BUFFER)
SPECULUM_OBJECT_TYPE(VkImage, VK_OBJECT_TYPE_IMAGE)
SPECULUM_OBJECT_TYPE(VkImageView, VK_OBJECT_TYPE_IMAGE_VIEW)
SPECULUM_OBJECT_TYPE(VkSampler, VK_OBJECT_TYPE_SAMPLER)
SPECULUM_OBJECT_TYPE(VkShaderModule, VK_OBJECT_TYPE_SHADER_MODULE)
SPECULUM_OBJECT_TYPE(VkPipelineCache, VK_OBJECT_TYPE_PIPELINE_CACHE)
SPECULUM_OBJECT_TYPE(VkPipelineLayout, VK_OBJECT_TYPE_PIPELINE_LAYOUT)
SPECULUM_OBJECT_TYPE(VkPipeline, VK_OBJECT_TYPE_PIPELINE)
SPECULUM_OBJECT_TYPE(VkRenderPass, VK_OBJECT_TYPE_RENDER_PASS)
SPECULUM_OBJECT_TYPE(VkFramebuffer, VK_OBJECT_TYPE_FRAMEBUFFER)
SPECULUM_OBJECT_TYPE(VkDescriptorSetLayout, VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT)
SPECULUM_OBJECT_TYPE(VkDescriptorPool, VK_OBJECT_TYPE_DESCRIPTOR_POOL)
SPECULUM_OBJECT_TYPE(VkDescriptorSet, VK_OBJECT_TYPE_DESCRIPTOR_SET)
SPECULUM_OBJECT_TYPE(VkQueryPool, VK_OBJECT_TYPE_QUERY_POOL)
SPECULUM_OBJECT_TYPE(VkSurfaceKHR, VK_OBJECT_TYPE_SURFACE_KHR)
SPECULUM_OBJECT_TYPE(VkSwapchainKHR, VK_OBJECT_TYPE_SWAPCHAIN_KHR)
SPECULUM_OBJECT_TYPE(VkDebugUtilsMessengerEXT, VK_OBJECT_TYPE_DEBUG_UTILS_MESSENGER_EXT)
#undef SPECULUM_OBJECT_TYPE

// Live handles of one type over the whole process, for tests that prove "no growth".
template <typename T>
inline std::atomic<int64_t> liveHandles{0};

// Name of the Vulkan type -> live handles, types without any left out.
std::map<std::string, int64_t> liveObjects();
int64_t liveObjectCount();

// Owns one child of an instance or device and destroys it with `destroy(owner, object, nullptr)`. Move-only.
template <typename T, auto destroy>
class Handle {
  template <typename Owner>
  static Owner ownerOf(void (*)(Owner, T, const VkAllocationCallbacks*));

 public:
  using Owner = decltype(ownerOf(destroy));

  Handle() = default;
  Handle(Owner owner, T object) : owner_(owner), object_(object) {
    if (object_ != VK_NULL_HANDLE) {
      ++liveHandles<T>;
    }
  }
  Handle(Handle&& other) noexcept
      : owner_(other.owner_), object_(std::exchange(other.object_, static_cast<T>(VK_NULL_HANDLE))) {}
  Handle& operator=(Handle&& other) noexcept {
    if (this != &other) {
      reset();
      owner_ = other.owner_;
      object_ = std::exchange(other.object_, static_cast<T>(VK_NULL_HANDLE));
    }
    return *this;
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() { reset(); }

  T get() const { return object_; }
  explicit operator bool() const { return object_ != VK_NULL_HANDLE; }
  void reset() {
    if (object_ != VK_NULL_HANDLE) {
      destroy(owner_, std::exchange(object_, static_cast<T>(VK_NULL_HANDLE)), nullptr);
      --liveHandles<T>;
    }
  }

 private:
  Owner owner_ = VK_NULL_HANDLE;
  T object_ = VK_NULL_HANDLE;
};

using SemaphoreHandle = Handle<VkSemaphore, vkDestroySemaphore>;
using FenceHandle = Handle<VkFence, vkDestroyFence>;
using CommandPoolHandle = Handle<VkCommandPool, vkDestroyCommandPool>;
using MemoryHandle = Handle<VkDeviceMemory, vkFreeMemory>;
using BufferHandle = Handle<VkBuffer, vkDestroyBuffer>;
using ImageHandle = Handle<VkImage, vkDestroyImage>;
using ImageViewHandle = Handle<VkImageView, vkDestroyImageView>;
using SamplerHandle = Handle<VkSampler, vkDestroySampler>;
using ShaderModuleHandle = Handle<VkShaderModule, vkDestroyShaderModule>;
using PipelineCacheHandle = Handle<VkPipelineCache, vkDestroyPipelineCache>;
using PipelineLayoutHandle = Handle<VkPipelineLayout, vkDestroyPipelineLayout>;
using PipelineHandle = Handle<VkPipeline, vkDestroyPipeline>;
using RenderPassHandle = Handle<VkRenderPass, vkDestroyRenderPass>;
using FramebufferHandle = Handle<VkFramebuffer, vkDestroyFramebuffer>;
using DescriptorSetLayoutHandle = Handle<VkDescriptorSetLayout, vkDestroyDescriptorSetLayout>;
using DescriptorPoolHandle = Handle<VkDescriptorPool, vkDestroyDescriptorPool>;
using QueryPoolHandle = Handle<VkQueryPool, vkDestroyQueryPool>;
using SurfaceHandle = Handle<VkSurfaceKHR, vkDestroySurfaceKHR>;
using SwapchainHandle = Handle<VkSwapchainKHR, vkDestroySwapchainKHR>;

}  // namespace speculum
