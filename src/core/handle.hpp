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

// VkObjectType of a Vulkan type, for debug names.
template <typename T>
constexpr VkObjectType objectType() = delete;
// Name of a type that a Handle owns, for messages.
template <typename T>
constexpr std::string_view objectName() = delete;

#define SPECULUM_OBJECT_TYPE(TYPE, VALUE)     \
  template <>                                 \
  constexpr VkObjectType objectType<TYPE>() { \
    return VALUE;                             \
  }
SPECULUM_OBJECT_TYPE(VkQueue, VK_OBJECT_TYPE_QUEUE)
SPECULUM_OBJECT_TYPE(VkCommandBuffer, VK_OBJECT_TYPE_COMMAND_BUFFER)

// Live handles of one type in the whole process, for tests that prove "no growth".
template <typename T>
inline std::atomic<int64_t> liveHandles{0};

// Live handles by the name of the Vulkan type; types without any are left out.
std::map<std::string, int64_t> liveObjects();

// Owns a child of an instance or a device and destroys it with `destroy(owner, object, nullptr)`. Move-only.
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
      destroy(owner_, std::exchange(object_, static_cast<T>(VK_NULL_HANDLE)), nullptr);
      --liveHandles<T>;
    }
  }

 private:
  Owner owner_ = VK_NULL_HANDLE;
  T object_ = VK_NULL_HANDLE;
};

// The Handle that owns a Vulkan type: HandleOf<VkFence> is FenceHandle.
template <typename T>
struct HandleTrait;
template <typename T>
using HandleOf = typename HandleTrait<T>::Type;

#define SPECULUM_HANDLE(HANDLE, TYPE, VALUE, DESTROY) \
  SPECULUM_OBJECT_TYPE(TYPE, VALUE)                   \
  template <>                                         \
  constexpr std::string_view objectName<TYPE>() {     \
    return #TYPE;                                     \
  }                                                   \
  using HANDLE = Handle<TYPE, DESTROY>;               \
  template <>                                         \
  struct HandleTrait<TYPE> {                          \
    using Type = HANDLE;                              \
  };
SPECULUM_HANDLES(SPECULUM_HANDLE)
#undef SPECULUM_HANDLE
#undef SPECULUM_OBJECT_TYPE

}  // namespace speculum
