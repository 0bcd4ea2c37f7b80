#include "core/handle.hpp"

#include "core/loader.hpp"

namespace speculum {

void destroyAccelerationStructure(VkDevice device, VkAccelerationStructureKHR structure,
                                  const VkAllocationCallbacks* allocator) {
  functionOf<PFN_vkDestroyAccelerationStructureKHR>(device, "vkDestroyAccelerationStructureKHR")(device, structure,
                                                                                                 allocator);
}

void destroyMessenger(VkInstance instance, VkDebugUtilsMessengerEXT messenger, const VkAllocationCallbacks* allocator) {
  functionOf<PFN_vkDestroyDebugUtilsMessengerEXT>(instance, "vkDestroyDebugUtilsMessengerEXT")(instance, messenger,
                                                                                               allocator);
}

std::map<std::string, int64_t> liveObjects() {
  std::map<std::string, int64_t> all;
#define SPECULUM_COUNT(HANDLE, TYPE, VALUE, DESTROY) all[#TYPE] = liveHandles<TYPE>;
  SPECULUM_HANDLES(SPECULUM_COUNT)
#undef SPECULUM_COUNT
  std::erase_if(all, [](const auto& entry) { return entry.second == 0; });
  return all;
}

}  // namespace speculum
