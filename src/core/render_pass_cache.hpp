#pragma once

#include <map>
#include <vector>

#include "core/pass.hpp"

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

// Render passes by key and framebuffers by render pass and images; a framebuffer goes when one of its images does.
class RenderPassCache {
 public:
  explicit RenderPassCache(Device& device);
  ~RenderPassCache();
  RenderPassCache(const RenderPassCache&) = delete;
  RenderPassCache& operator=(const RenderPassCache&) = delete;

  VkRenderPass renderPass(const RenderPassKey& key);
  // `images` in the order of the render pass's attachments.
  VkFramebuffer framebuffer(VkRenderPass renderPass, const std::vector<Image*>& images, VkExtent2D extent);

 private:
  struct FramebufferKey {
    VkRenderPass renderPass;
    std::vector<uint64_t> images;
    auto operator<=>(const FramebufferKey&) const = default;
  };
  Device& device_;
  int observer_;
  std::map<RenderPassKey, RenderPassHandle> renderPasses_;
  std::map<FramebufferKey, FramebufferHandle> framebuffers_;
};

}  // namespace speculum
