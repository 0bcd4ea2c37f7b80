#include "core/handle.hpp"

namespace speculum {

std::map<std::string, int64_t> liveObjects() {
  std::map<std::string, int64_t> all = {
      {"VkCommandPool", liveHandles<VkCommandPool>},
      {"VkSemaphore", liveHandles<VkSemaphore>},
      {"VkFence", liveHandles<VkFence>},
      {"VkDeviceMemory", liveHandles<VkDeviceMemory>},
      {"VkBuffer", liveHandles<VkBuffer>},
      {"VkImage", liveHandles<VkImage>},
      {"VkImageView", liveHandles<VkImageView>},
      {"VkSampler", liveHandles<VkSampler>},
      {"VkShaderModule", liveHandles<VkShaderModule>},
      {"VkPipelineCache", liveHandles<VkPipelineCache>},
      {"VkPipelineLayout", liveHandles<VkPipelineLayout>},
      {"VkPipeline", liveHandles<VkPipeline>},
      {"VkRenderPass", liveHandles<VkRenderPass>},
      {"VkFramebuffer", liveHandles<VkFramebuffer>},
      {"VkDescriptorSetLayout", liveHandles<VkDescriptorSetLayout>},
      {"VkDescriptorPool", liveHandles<VkDescriptorPool>},
      {"VkQueryPool", liveHandles<VkQueryPool>},
      {"VkSurfaceKHR", liveHandles<VkSurfaceKHR>},
      {"VkSwapchainKHR", liveHandles<VkSwapchainKHR>},
      {"VkDebugUtilsMessengerEXT", liveHandles<VkDebugUtilsMessengerEXT>},
  };
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
