#include "core/debug_messages.hpp"

#include <spdlog/spdlog.h>

namespace speculum {

VkDebugUtilsMessengerCreateInfoEXT DebugMessages::createInfo() {
  return {.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
          .messageSeverity =
              VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
          .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT,
          .pfnUserCallback = &DebugMessages::receive,
          .pUserData = this};
}

int DebugMessages::count() const {
  const std::lock_guard lock(mutex_);
  return count_;
}

std::vector<std::string> DebugMessages::latest() const {
  const std::lock_guard lock(mutex_);
  return {latest_.begin(), latest_.end()};
}

VkBool32 DebugMessages::receive(VkDebugUtilsMessageSeverityFlagBitsEXT severity, VkDebugUtilsMessageTypeFlagsEXT,
                                const VkDebugUtilsMessengerCallbackDataEXT* data, void* self) {
  const bool error = severity & VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  static_cast<DebugMessages*>(self)->add(error, data->pMessage ? data->pMessage : "");
  return VK_FALSE;
}

void DebugMessages::add(bool error, const std::string& text) {
  spdlog::log(error ? spdlog::level::err : spdlog::level::warn, "validation: {}", text);
  const std::lock_guard lock(mutex_);
  ++count_;
  latest_.push_back(text);
  if (latest_.size() > kept) {
    latest_.pop_front();
  }
}

}  // namespace speculum
