#include "core/render_pass_cache.hpp"

#include <string>
#include <vector>

namespace speculum {

namespace {

VkAttachmentDescription attachmentOf(VkFormat format, VkSampleCountFlagBits samples, bool load, bool store,
                                     VkImageLayout layout) {
  // Render passes keep the layout: barriers change layouts.
  return {.format = format,
          .samples = samples,
          .loadOp = load ? VK_ATTACHMENT_LOAD_OP_LOAD : VK_ATTACHMENT_LOAD_OP_CLEAR,
          .storeOp = store ? VK_ATTACHMENT_STORE_OP_STORE : VK_ATTACHMENT_STORE_OP_DONT_CARE,
          .stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
          .stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
          .initialLayout = layout,
          .finalLayout = layout};
}

constexpr VkImageLayout resolveLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
constexpr VkImageLayout depthLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;

RenderPassHandle create(Device& device, const RenderPassKey& key) {
  std::vector<VkAttachmentDescription> attachments = {
      attachmentOf(key.color, key.samples, key.loadColor, key.storeColor, key.colorLayout)};
  const VkAttachmentReference color{0, key.colorLayout};
  const VkAttachmentReference resolve{1, resolveLayout};
  const VkAttachmentReference depth{key.resolve ? 2u : 1u, depthLayout};
  if (key.resolve) {
    attachments.push_back(attachmentOf(key.color, VK_SAMPLE_COUNT_1_BIT, false, true, resolveLayout));
    attachments.back().loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
  }
  if (key.depth != VK_FORMAT_UNDEFINED) {
    attachments.push_back(attachmentOf(key.depth, key.samples, key.loadDepth, key.storeDepth, depthLayout));
  }
  const VkSubpassDescription subpass{.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS,
                                     .colorAttachmentCount = 1,
                                     .pColorAttachments = &color,
                                     .pResolveAttachments = key.resolve ? &resolve : nullptr,
                                     .pDepthStencilAttachment = key.depth != VK_FORMAT_UNDEFINED ? &depth : nullptr};
  return device.create(vkCreateRenderPass,
                       {.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO,
                        .attachmentCount = static_cast<uint32_t>(attachments.size()),
                        .pAttachments = attachments.data(),
                        .subpassCount = 1,
                        .pSubpasses = &subpass},
                       "samples " + std::to_string(key.samples));
}

}  // namespace

VkRenderPass RenderPassCache::renderPass(const RenderPassKey& key) {
  RenderPassHandle& handle = renderPasses_[key];
  if (!handle) {
    handle = create(device_, key);
  }
  return handle.get();
}

}  // namespace speculum
