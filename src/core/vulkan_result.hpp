#pragma once

#include <vulkan/vulkan.h>

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace speculum {

// VK_ERROR_OUT_OF_DEVICE_MEMORY or VK_ERROR_OUT_OF_HOST_MEMORY.
struct OutOfMemoryError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct DeviceLostError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct SurfaceLostError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Throws a std::runtime_error, or one of the classes above if it fits, that says what failed, why and how to mend it.
[[noreturn]] void throwVulkanError(VkResult result, std::string_view what);
// Throws as throwVulkanError() does unless `result` is VK_SUCCESS.
void check(VkResult result, std::string_view what);
std::string resultName(VkResult result);
// Returns `function`. Throws std::runtime_error with its name if it is null: the loader or the driver has no such one.
PFN_vkVoidFunction requireFunction(PFN_vkVoidFunction function, std::string_view name);

// Lists what Vulkan enumerates in two calls: query(first..., &count, nullptr) says how many, query(first..., &count,
// data) which. Repeats both if the number grew in between.
template <typename T, typename Query, typename... First>
std::vector<T> enumerate(std::string_view what, Query query, First... first) {
  std::vector<T> items;
  VkResult result = VK_INCOMPLETE;
  while (result == VK_INCOMPLETE) {
    uint32_t count = 0;
    check(query(first..., &count, nullptr), what);
    items.resize(count);
    result = query(first..., &count, items.data());
    items.resize(count);
  }
  check(result, what);
  return items;
}

}  // namespace speculum
