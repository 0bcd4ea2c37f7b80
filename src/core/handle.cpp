#include "core/handle.hpp"

namespace speculum {

std::map<std::string, int64_t> liveObjects() {
  std::map<std::string, int64_t> all = {{"VkDebugUtilsMessengerEXT", liveHandles<VkDebugUtilsMessengerEXT>}};
#define SPECULUM_COUNT(HANDLE, TYPE, VALUE, DESTROY) all[#TYPE] = liveHandles<TYPE>;
  SPECULUM_HANDLES(SPECULUM_COUNT)
#undef SPECULUM_COUNT
  std::erase_if(all, [](const auto& entry) { return entry.second == 0; });
  return all;
}

int64_t liveObjectCount() {
  int64_t sum = 0;
  for (const auto& [type, count] : liveObjects()) {
    sum += count;
  }
  return sum;
}

}  // namespace speculum
