#pragma once

#include <shared_mutex>

#include "core/vulkan_result.hpp"

namespace speculum {

// Returns the mutex that guards the loader's list of instances and devices, which threads with devices of their own
// share. Lock it exclusively to make or destroy one. Lock it shared to look up a function, to name an object and to
// make a surface or a swapchain: loaders (at least 1.3.239) search the list for that while another thread may free what
// they look at.
inline std::shared_mutex& loaderMutex() {
  static std::shared_mutex mutex;
  return mutex;
}

// Return a function that the loader does not export. Throw as requireFunction() does.
template <typename F>
F functionOf(VkInstance instance, const char* name) {
  const std::shared_lock lock(loaderMutex());
  return reinterpret_cast<F>(requireFunction(vkGetInstanceProcAddr(instance, name), name));
}
template <typename F>
F functionOf(VkDevice device, const char* name) {
  const std::shared_lock lock(loaderMutex());
  return reinterpret_cast<F>(requireFunction(vkGetDeviceProcAddr(device, name), name));
}

}  // namespace speculum
