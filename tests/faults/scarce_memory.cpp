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

extern "C" VKAPI_ATTR VkResult VKAPI_CALL __real_vkAllocateMemory(VkDevice device, const VkMemoryAllocateInfo* info,
                                                                  const VkAllocationCallbacks* callbacks,
                                                                  VkDeviceMemory* memory);

// The linker's --wrap=vkAllocateMemory puts this one in the place of the real one.
extern "C" VKAPI_ATTR VkResult VKAPI_CALL __wrap_vkAllocateMemory(VkDevice device, const VkMemoryAllocateInfo* info,
                                                                  const VkAllocationCallbacks* callbacks,
                                                                  VkDeviceMemory* memory) {
  auto& refused = speculum::testing_support::refused;
  if (info->allocationSize >= refused.fewest && info->allocationSize <= refused.most) {
    ++refused.count;
    return VK_ERROR_OUT_OF_DEVICE_MEMORY;
  }
  return __real_vkAllocateMemory(device, info, callbacks, memory);
}
