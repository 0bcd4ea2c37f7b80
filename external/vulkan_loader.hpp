#pragma once

namespace speculum {

// Returns the address of the function NAME of the system's Vulkan loader, which is opened at the first call. Throws
// std::runtime_error if there is no loader, or if it is too old to know the function. May be called on any thread.
void* findVulkanFunction(const char* name);

template <typename Function>
Function vulkanFunction(const char* name) {
  return reinterpret_cast<Function>(findVulkanFunction(name));
}

}  // namespace speculum
