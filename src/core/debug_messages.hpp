#pragma once

#include <vulkan/vulkan.h>

#include <deque>
#include <mutex>
#include <string>
#include <vector>

namespace speculum {

// Receives the messages of the validation layer, logs them and keeps the latest for tests.
class DebugMessages {
 public:
  VkDebugUtilsMessengerCreateInfoEXT createInfo();  // points here; covers instance creation too

  int count() const;
  std::vector<std::string> latest() const;

 private:
  static VKAPI_ATTR VkBool32 VKAPI_CALL receive(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                                VkDebugUtilsMessageTypeFlagsEXT types,
                                                const VkDebugUtilsMessengerCallbackDataEXT* data, void* self);
  void add(bool error, const std::string& text);

  static constexpr size_t kept = 32;

  mutable std::mutex mutex_;
  std::deque<std::string> latest_;
  int count_ = 0;
};

}  // namespace speculum
