#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "core/handle.hpp"
#include "core/loader.hpp"

namespace speculum {

struct DeviceOptions;

// Receives the messages of the validation layer, logs and counts them.
class DebugMessages {
 public:
  // Points to this object. In the chain of the instance's create info it covers the instance's creation, too.
  VkDebugUtilsMessengerCreateInfoEXT createInfo();

  int count() const { return count_; }  // since the start

 private:
  static VKAPI_ATTR VkBool32 VKAPI_CALL receive(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                                VkDebugUtilsMessageTypeFlagsEXT types,
                                                const VkDebugUtilsMessengerCallbackDataEXT* data, void* self);

  std::atomic<int> count_{0};
};

// The Vulkan instance, with validation if the options ask for it, and with the extensions that their window needs.
class Instance {
 public:
  explicit Instance(const DeviceOptions& options);

  VkInstance get() const { return instance_.get(); }
  uint32_t version() const { return version_; }  // version of Vulkan that loader and program both have
  bool hasDebugUtils() const { return debugUtils_; }
  bool validation() const { return static_cast<bool>(messenger_); }
  const DebugMessages& messages() const { return messages_; }

 private:
  struct Destroy {
    using pointer = VkInstance;
    void operator()(VkInstance instance) const {
      const std::lock_guard lock(loaderMutex());
      vkDestroyInstance(instance, nullptr);
    }
  };

  DebugMessages messages_;
  uint32_t version_;
  bool debugUtils_ = false;
  std::unique_ptr<VkInstance, Destroy> instance_;
  MessengerHandle messenger_;
};

}  // namespace speculum
