#pragma once

#include <vulkan/vulkan.h>

#include <atomic>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace speculum {

// Call functions of extensions, which the loader does not export.
void destroyAccelerationStructure(VkDevice device, VkAccelerationStructureKHR structure,
                                  const VkAllocationCallbacks* allocator);
void destroyMessenger(VkInstance instance, VkDebugUtilsMessengerEXT messenger, const VkAllocationCallbacks* allocator);

// Every type that a Handle owns: the handle's name, the Vulkan type, its object type and what destroys it.
#define SPECULUM_HANDLES(X)                                                                             \
  X(CommandPoolHandle, VkCommandPool, VK_OBJECT_TYPE_COMMAND_POOL, vkDestroyCommandPool)                \
  X(SemaphoreHandle, VkSemaphore, VK_OBJECT_TYPE_SEMAPHORE, vkDestroySemaphore)                         \
  X(FenceHandle, VkFence, VK_OBJECT_TYPE_FENCE, vkDestroyFence)                                         \
  X(MemoryHandle, VkDeviceMemory, VK_OBJECT_TYPE_DEVICE_MEMORY, vkFreeMemory)                           \
  X(BufferHandle, VkBuffer, VK_OBJECT_TYPE_BUFFER, vkDestroyBuffer)                                     \
  X(BufferViewHandle, VkBufferView, VK_OBJECT_TYPE_BUFFER_VIEW, vkDestroyBufferView)                    \
  X(ImageHandle, VkImage, VK_OBJECT_TYPE_IMAGE, vkDestroyImage)                                         \
  X(ImageViewHandle, VkImageView, VK_OBJECT_TYPE_IMAGE_VIEW, vkDestroyImageView)                        \
  X(SamplerHandle, VkSampler, VK_OBJECT_TYPE_SAMPLER, vkDestroySampler)                                 \
  X(ShaderModuleHandle, VkShaderModule, VK_OBJECT_TYPE_SHADER_MODULE, vkDestroyShaderModule)            \
  X(PipelineCacheHandle, VkPipelineCache, VK_OBJECT_TYPE_PIPELINE_CACHE, vkDestroyPipelineCache)        \
  X(PipelineLayoutHandle, VkPipelineLayout, VK_OBJECT_TYPE_PIPELINE_LAYOUT, vkDestroyPipelineLayout)    \
  X(PipelineHandle, VkPipeline, VK_OBJECT_TYPE_PIPELINE, vkDestroyPipeline)                             \
  X(RenderPassHandle, VkRenderPass, VK_OBJECT_TYPE_RENDER_PASS, vkDestroyRenderPass)                    \
  X(FramebufferHandle, VkFramebuffer, VK_OBJECT_TYPE_FRAMEBUFFER, vkDestroyFramebuffer)                 \
  X(DescriptorSetLayoutHandle, VkDescriptorSetLayout, VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT,             \
    vkDestroyDescriptorSetLayout)                                                                       \
  X(DescriptorPoolHandle, VkDescriptorPool, VK_OBJECT_TYPE_DESCRIPTOR_POOL, vkDestroyDescriptorPool)    \
  X(QueryPoolHandle, VkQueryPool, VK_OBJECT_TYPE_QUERY_POOL, vkDestroyQueryPool)                        \
  X(AccelerationStructureHandle, VkAccelerationStructureKHR, VK_OBJECT_TYPE_ACCELERATION_STRUCTURE_KHR, \
    destroyAccelerationStructure)                                                                       \
  X(SurfaceHandle, VkSurfaceKHR, VK_OBJECT_TYPE_SURFACE_KHR, vkDestroySurfaceKHR)                       \
  X(SwapchainHandle, VkSwapchainKHR, VK_OBJECT_TYPE_SWAPCHAIN_KHR, vkDestroySwapchainKHR)               \
  X(MessengerHandle, VkDebugUtilsMessengerEXT, VK_OBJECT_TYPE_DEBUG_UTILS_MESSENGER_EXT, destroyMessenger)

// Describes a Vulkan type: its object type for debug names and, if a Handle owns it, its name for messages and the
// function that destroys it.
template <typename T>
struct ObjectTraits;
template <>
struct ObjectTraits<VkQueue> {
  static constexpr VkObjectType type = VK_OBJECT_TYPE_QUEUE;
};
template <>
struct ObjectTraits<VkCommandBuffer> {
  static constexpr VkObjectType type = VK_OBJECT_TYPE_COMMAND_BUFFER;
};
#define SPECULUM_TRAITS(HANDLE, TYPE, VALUE, DESTROY) \
  template <>                                         \
  struct ObjectTraits<TYPE> {                         \
    static constexpr VkObjectType type = VALUE;       \
    static constexpr std::string_view name = #TYPE;   \
    static constexpr auto destroy = DESTROY;          \
  };
SPECULUM_HANDLES(SPECULUM_TRAITS)
#undef SPECULUM_TRAITS

// Live handles of one type in the whole process, for tests that prove "no growth".
template <typename T>
inline std::atomic<int64_t> liveHandles{0};

// Live handles by the name of the Vulkan type; types without any are left out.
std::map<std::string, int64_t> liveObjects();

// Owns a child of an instance or a device and destroys it. Move-only.
template <typename T>
class Handle {
  template <typename Owner>
  static Owner ownerOf(void (*)(Owner, T, const VkAllocationCallbacks*));

 public:
  using Owner = decltype(ownerOf(ObjectTraits<T>::destroy));

  Handle() = default;
  Handle(Owner owner, T object) : owner_(owner), object_(object) {
    if (object_ != VK_NULL_HANDLE) {
      ++liveHandles<T>;
    }
  }
  Handle(Handle&& other) noexcept
      : owner_(other.owner_), object_(std::exchange(other.object_, static_cast<T>(VK_NULL_HANDLE))) {}
  Handle& operator=(Handle other) noexcept {
    std::swap(owner_, other.owner_);
    std::swap(object_, other.object_);
    return *this;
  }
  ~Handle() { reset(); }

  T get() const { return object_; }
  explicit operator bool() const { return object_ != VK_NULL_HANDLE; }
  void reset() {
    if (object_ != VK_NULL_HANDLE) {
      ObjectTraits<T>::destroy(owner_, std::exchange(object_, static_cast<T>(VK_NULL_HANDLE)), nullptr);
      --liveHandles<T>;
    }
  }

 private:
  Owner owner_ = VK_NULL_HANDLE;
  T object_ = VK_NULL_HANDLE;
};

#define SPECULUM_ALIAS(HANDLE, TYPE, VALUE, DESTROY) using HANDLE = Handle<TYPE>;
SPECULUM_HANDLES(SPECULUM_ALIAS)
#undef SPECULUM_ALIAS

}  // namespace speculum
