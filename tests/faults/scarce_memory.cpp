#include "faults/scarce_memory.hpp"

#include <vulkan/vulkan.h>

namespace speculum::testing_support {

namespace {

struct Refused {
  uint64_t fewest = 1;
  uint64_t most = 0;
  int count = 0;
};
Refused refused;

constexpr VkDeviceSize refusedBytes = VkDeviceSize{1} << 48;

void refuse(VkMemoryRequirements2& needed) {
  VkDeviceSize& bytes = needed.memoryRequirements.size;
  bytes += bytes >= refused.fewest && bytes <= refused.most ? refusedBytes : 0;
}

}  // namespace

void refuseMemory(uint64_t fewest, uint64_t most) {
  refused.fewest = fewest;
  refused.most = most;
}

void stopRefusingMemory() {
  refuseMemory(1, 0);
}

int refusedAllocations() {
  return refused.count;
}

}  // namespace speculum::testing_support

// The linker's --wrap puts these in the place of the real functions. Blocks hold many resources, so a refused one says
// that it needs more memory than there is anywhere.
extern "C" {
VKAPI_ATTR VkResult VKAPI_CALL __real_vkAllocateMemory(VkDevice device, const VkMemoryAllocateInfo* info,
                                                       const VkAllocationCallbacks* callbacks, VkDeviceMemory* memory);
VKAPI_ATTR void VKAPI_CALL __real_vkGetBufferMemoryRequirements2(VkDevice device,
                                                                 const VkBufferMemoryRequirementsInfo2* info,
                                                                 VkMemoryRequirements2* needed);
VKAPI_ATTR void VKAPI_CALL __real_vkGetImageMemoryRequirements2(VkDevice device,
                                                                const VkImageMemoryRequirementsInfo2* info,
                                                                VkMemoryRequirements2* needed);

VKAPI_ATTR VkResult VKAPI_CALL __wrap_vkAllocateMemory(VkDevice device, const VkMemoryAllocateInfo* info,
                                                       const VkAllocationCallbacks* callbacks, VkDeviceMemory* memory) {
  if (info->allocationSize >= speculum::testing_support::refusedBytes) {
    ++speculum::testing_support::refused.count;
    return VK_ERROR_OUT_OF_DEVICE_MEMORY;
  }
  return __real_vkAllocateMemory(device, info, callbacks, memory);
}
VKAPI_ATTR void VKAPI_CALL __wrap_vkGetBufferMemoryRequirements2(VkDevice device,
                                                                 const VkBufferMemoryRequirementsInfo2* info,
                                                                 VkMemoryRequirements2* needed) {
  __real_vkGetBufferMemoryRequirements2(device, info, needed);
  speculum::testing_support::refuse(*needed);
}
VKAPI_ATTR void VKAPI_CALL __wrap_vkGetImageMemoryRequirements2(VkDevice device,
                                                                const VkImageMemoryRequirementsInfo2* info,
                                                                VkMemoryRequirements2* needed) {
  __real_vkGetImageMemoryRequirements2(device, info, needed);
  speculum::testing_support::refuse(*needed);
}
}
