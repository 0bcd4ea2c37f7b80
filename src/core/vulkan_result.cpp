#include "core/vulkan_result.hpp"

#include "platform/process.hpp"

namespace speculum {

std::string resultName(VkResult result) {
  switch (result) {
#define SPECULUM_NAME(RESULT) \
  case RESULT:                \
    return #RESULT;
    SPECULUM_NAME(VK_SUCCESS)
    SPECULUM_NAME(VK_NOT_READY)
    SPECULUM_NAME(VK_TIMEOUT)
    SPECULUM_NAME(VK_INCOMPLETE)
    SPECULUM_NAME(VK_SUBOPTIMAL_KHR)
    SPECULUM_NAME(VK_ERROR_OUT_OF_HOST_MEMORY)
    SPECULUM_NAME(VK_ERROR_OUT_OF_DEVICE_MEMORY)
    SPECULUM_NAME(VK_ERROR_INITIALIZATION_FAILED)
    SPECULUM_NAME(VK_ERROR_DEVICE_LOST)
    SPECULUM_NAME(VK_ERROR_LAYER_NOT_PRESENT)
    SPECULUM_NAME(VK_ERROR_EXTENSION_NOT_PRESENT)
    SPECULUM_NAME(VK_ERROR_FEATURE_NOT_PRESENT)
    SPECULUM_NAME(VK_ERROR_INCOMPATIBLE_DRIVER)
    SPECULUM_NAME(VK_ERROR_TOO_MANY_OBJECTS)
    SPECULUM_NAME(VK_ERROR_FORMAT_NOT_SUPPORTED)
    SPECULUM_NAME(VK_ERROR_MEMORY_MAP_FAILED)
    SPECULUM_NAME(VK_ERROR_FRAGMENTED_POOL)
    SPECULUM_NAME(VK_ERROR_OUT_OF_POOL_MEMORY)
    SPECULUM_NAME(VK_ERROR_NATIVE_WINDOW_IN_USE_KHR)
    SPECULUM_NAME(VK_ERROR_SURFACE_LOST_KHR)
    SPECULUM_NAME(VK_ERROR_OUT_OF_DATE_KHR)
#undef SPECULUM_NAME
    default:
      return "VkResult " + std::to_string(static_cast<int>(result));
  }
}

namespace {

std::string remedy(VkResult result) {
  switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
      return " (lower --size, view.samples or reflection.samples)";
    case VK_ERROR_INCOMPATIBLE_DRIVER:
      return " (no Vulkan driver was found: install one, e.g. mesa-vulkan-drivers, and see VK_ICD_FILENAMES)";
    case VK_ERROR_DEVICE_LOST:
      return " (the GPU stopped: see the kernel's log, and try --validation)";
    default:
      return "";
  }
}

}  // namespace

void throwVulkanError(VkResult result, std::string_view what) {
  const std::string text = std::string(what) + ": " + resultName(result) + remedy(result) + memoryLimitAdvice();
  if (result == VK_ERROR_OUT_OF_DEVICE_MEMORY || result == VK_ERROR_OUT_OF_HOST_MEMORY) {
    throw OutOfMemoryError(text);
  }
  if (result == VK_ERROR_DEVICE_LOST) {
    throw DeviceLostError(text);
  }
  if (result == VK_ERROR_SURFACE_LOST_KHR) {
    throw SurfaceLostError(text);
  }
  throw std::runtime_error(text);
}

PFN_vkVoidFunction requireFunction(PFN_vkVoidFunction function, std::string_view name) {
  if (!function) {
    throw std::runtime_error("the Vulkan driver does not return " + std::string(name) +
                             ", though it must (update the driver and libvulkan1)");
  }
  return function;
}

void check(VkResult result, std::string_view what) {
  if (result != VK_SUCCESS) {
    throwVulkanError(result, what);
  }
}

}  // namespace speculum
