#pragma once

#include <map>

#include "core/device.hpp"

namespace speculum {

// Properties in which the project's one-subpass render passes differ. Attachments: color, resolve, depth.
struct RenderPassKey {
  VkFormat color = VK_FORMAT_UNDEFINED;
  VkFormat depth = VK_FORMAT_UNDEFINED;
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
  bool resolve = false;
  bool loadColor = false;
  bool storeColor = true;
  bool loadDepth = false;
  bool storeDepth = false;
  VkImageLayout colorLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;

  auto operator<=>(const RenderPassKey&) const = default;
};

// Render passes by key, each made on its first use.
class RenderPassCache {
 public:
  explicit RenderPassCache(Device& device) : device_(device) {}

  VkRenderPass renderPass(const RenderPassKey& key);

 private:
  Device& device_;
  std::map<RenderPassKey, RenderPassHandle> renderPasses_;
};

}  // namespace speculum
