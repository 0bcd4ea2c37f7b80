#include "core/off_screen.hpp"

#include <algorithm>

namespace speculum {

namespace {

Image makeColor(Device& device, VkExtent2D extent, VkFormat format, VkSampleCountFlagBits samples, std::string name) {
  const bool multisampled = samples != VK_SAMPLE_COUNT_1_BIT;
  const VkImageUsageFlags reads = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
  return Image(device, {.extent = extent,
                        .format = format,
                        .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | (multisampled ? 0 : reads),
                        .samples = samples,
                        .name = std::move(name)});
}

Image makeDepth(Device& device, VkExtent2D extent, VkSampleCountFlagBits samples, std::string name) {
  return Image(device, {.extent = extent,
                        .format = depthFormat,
                        .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
                        .samples = samples,
                        .name = std::move(name)});
}

bool equal(VkExtent2D a, VkExtent2D b) {
  return a.width == b.width && a.height == b.height;
}

}  // namespace

SharedAttachments::SharedAttachments(Device& device, VkSampleCountFlagBits samples, const std::string& name)
    : device_(&device), samples_(samples), name_(name) {}

void SharedAttachments::require(VkExtent2D extent, RetireQueue& retired) {
  trim({std::max(extent.width, extent_.width), std::max(extent.height, extent_.height)}, retired);
}

void SharedAttachments::trim(VkExtent2D extent, RetireQueue& retired) {
  if (equal(extent, extent_)) {
    return;
  }
  if (depth_) {
    retired.retire(std::exchange(color_, Image()));
    retired.retire(std::exchange(depth_, Image()));
  }
  extent_ = extent;
  if (extent.width == 0 || extent.height == 0) {
    return;
  }
  if (samples_ != VK_SAMPLE_COUNT_1_BIT) {
    color_ = makeColor(*device_, extent, colorFormat, samples_, name_ + " samples");
  }
  depth_ = makeDepth(*device_, extent, samples_, name_ + " depth");
}

OffScreen::OffScreen(Device& device, const OffScreenDesc& desc, RetireQueue& retired) : device_(&device), desc_(desc) {
  if (desc_.shared) {
    desc_.samples = desc_.shared->samples();
  }
  sampler_ = createSampler(device, {.filter = desc_.filter, .maxLod = 0.0f}, desc_.name);
  createImages(retired);
}

void OffScreen::resize(VkExtent2D extent, RetireQueue& retired) {
  if (desc_.shared) {
    desc_.shared->require(extent, retired);
  }
  if (!equal(extent, desc_.extent) || !color_) {
    desc_.extent = extent;
    retire(retired);
    createImages(retired);
  }
}

void OffScreen::retire(RetireQueue& retired) {
  retired.retire(std::exchange(sampler_, SamplerHandle()));
  for (Image* image : {&color_, &samples_, &depth_}) {
    if (*image) {
      retired.retire(std::exchange(*image, Image()));
    }
  }
}

void OffScreen::createImages(RetireQueue& retired) {
  color_ = makeColor(*device_, desc_.extent, desc_.format, VK_SAMPLE_COUNT_1_BIT, desc_.name);
  if (desc_.shared) {
    desc_.shared->require(desc_.extent, retired);
    return;
  }
  if (desc_.samples != VK_SAMPLE_COUNT_1_BIT) {
    samples_ = makeColor(*device_, desc_.extent, desc_.format, desc_.samples, desc_.name + " samples");
  }
  if (desc_.depth) {
    depth_ = makeDepth(*device_, desc_.extent, desc_.samples, desc_.name + " depth");
  }
}

uint64_t OffScreen::bytes() const {
  return color_.bytes() + samples_.bytes() + depth_.bytes();
}

PassTargets OffScreen::targets() {
  Image* samples = desc_.shared ? desc_.shared->color() : samples_ ? &samples_ : nullptr;
  Image* depth = desc_.shared ? desc_.shared->depth() : depth_ ? &depth_ : nullptr;
  return {.color = samples ? samples : &color_,
          .resolve = samples ? &color_ : nullptr,
          .depth = desc_.depth ? depth : nullptr,
          .role = desc_.role};
}

}  // namespace speculum
