#include "core/instance.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "core/device.hpp"
#include "platform/files.hpp"
#include "platform/process.hpp"
#include "platform/window.hpp"

namespace speculum {

namespace {

constexpr const char* validationLayer = "VK_LAYER_KHRONOS_validation";

bool extensionPresent(std::string_view name) {
  const auto extensions =
      enumerate<VkExtensionProperties>("list instance extensions", vkEnumerateInstanceExtensionProperties, nullptr);
  return std::ranges::any_of(extensions, [&](const auto& extension) { return name == extension.extensionName; });
}

uint32_t usedVersion() {
  uint32_t version = VK_API_VERSION_1_0;
  check(vkEnumerateInstanceVersion(&version), "query the Vulkan loader");
  if (version < VK_API_VERSION_1_1) {
    throw std::runtime_error("the Vulkan loader is older than 1.1 (update libvulkan1)");
  }
  return std::min(version, VK_API_VERSION_1_3);
}

// Mesa's software driver keeps compiled shaders on disk under a key that leaves out its vector width (seen in 22.3.6):
// code of another width crashes. Each width gets a cache of its own; a cache that the user chose is kept.
void separateShaderCaches() {
  const std::string width = environment("LP_NATIVE_VECTOR_WIDTH");
  constexpr const char* variable = "MESA_SHADER_CACHE_DIR";
  if (!width.empty() && environment(variable).empty()) {
    const std::filesystem::path directory = userCacheDir() / ("mesa_width_" + width);
    std::error_code error;
    std::filesystem::create_directories(directory, error);
    setEnvironment(variable, directory.string());
  }
}

// Turns on checks for which Vulkan has no structure, by environment variables that the layer reads when the instance is
// made: checks across submissions in the layers of 2023, checks of what shaders access in newer ones. A value that the
// user has set is kept.
void enableSynchronisationChecks() {
  for (const auto& [variable, value] :
       {std::pair{"VK_LAYER_ENABLES", "VALIDATION_CHECK_ENABLE_SYNCHRONIZATION_VALIDATION_QUEUE_SUBMIT"},
        std::pair{"VK_KHRONOS_VALIDATION_SYNCVAL_SHADER_ACCESSES_HEURISTIC", "1"}}) {
    if (environment(variable).empty()) {
      setEnvironment(variable, value);
    }
  }
}

std::vector<const char*> chooseLayers(const DeviceOptions& options) {
  if (!options.validation) {
    return {};
  }
  const auto layers = enumerate<VkLayerProperties>("list Vulkan layers", vkEnumerateInstanceLayerProperties);
  if (std::ranges::none_of(layers, [](const auto& l) { return std::string_view(l.layerName) == validationLayer; })) {
    throw std::runtime_error(
        "--validation: VK_LAYER_KHRONOS_validation is missing (install vulkan-validationlayers, or see "
        "VK_LAYER_PATH)");
  }
  enableSynchronisationChecks();
  return {validationLayer};
}

}  // namespace

VkDebugUtilsMessengerCreateInfoEXT DebugMessages::createInfo() {
  return {.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
          .messageSeverity =
              VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
          .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT,
          .pfnUserCallback = &DebugMessages::receive,
          .pUserData = this};
}

VkBool32 DebugMessages::receive(VkDebugUtilsMessageSeverityFlagBitsEXT severity, VkDebugUtilsMessageTypeFlagsEXT,
                                const VkDebugUtilsMessengerCallbackDataEXT* data, void* self) {
  const bool error = severity & VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  std::string text = data->pMessage ? data->pMessage : "";
  // Older layers begin the text with the message's name already.
  if (data->pMessageIdName && text.find(data->pMessageIdName) == std::string::npos) {
    text = std::string(data->pMessageIdName) + ": " + text;
  }
  spdlog::log(error ? spdlog::level::err : spdlog::level::warn, "validation: {}", text);
  ++static_cast<DebugMessages*>(self)->count_;
  return VK_FALSE;
}

Instance::Instance(const DeviceOptions& options) : version_(usedVersion()) {
  const VkApplicationInfo application{.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                      .pApplicationName = "speculum",
                                      .applicationVersion = 1,
                                      .pEngineName = "speculum",
                                      .apiVersion = version_};
  separateShaderCaches();
  const std::vector<const char*> layers = chooseLayers(options);
  debugUtils_ = extensionPresent(VK_EXT_DEBUG_UTILS_EXTENSION_NAME) || options.validation;
  std::vector<const char*> extensions;
  if (debugUtils_) {
    extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
  }
  if (options.window) {
    const std::vector<const char*> needed = options.window->requiredInstanceExtensions();
    extensions.insert(extensions.end(), needed.begin(), needed.end());
  }
  const VkDebugUtilsMessengerCreateInfoEXT messengerInfo = messages_.createInfo();
  const VkValidationFeatureEnableEXT enables[] = {VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
  const VkValidationFeaturesEXT features{.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT,
                                         .pNext = &messengerInfo,
                                         .enabledValidationFeatureCount = 1,
                                         .pEnabledValidationFeatures = enables};
  const VkInstanceCreateInfo info{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                  .pNext = options.validation ? &features : nullptr,
                                  .pApplicationInfo = &application,
                                  .enabledLayerCount = static_cast<uint32_t>(layers.size()),
                                  .ppEnabledLayerNames = layers.data(),
                                  .enabledExtensionCount = static_cast<uint32_t>(extensions.size()),
                                  .ppEnabledExtensionNames = extensions.data()};
  VkInstance instance = VK_NULL_HANDLE;
  {
    const std::lock_guard lock(loaderMutex());
    check(vkCreateInstance(&info, nullptr, &instance), "create the Vulkan instance");
  }
  instance_.reset(instance);
  if (options.validation) {
    const auto create = functionOf<PFN_vkCreateDebugUtilsMessengerEXT>(instance, "vkCreateDebugUtilsMessengerEXT");
    VkDebugUtilsMessengerEXT messenger = VK_NULL_HANDLE;
    check(create(instance, &messengerInfo, nullptr, &messenger), "create the debug messenger");
    messenger_ = {instance, messenger};
  }
}

}  // namespace speculum
