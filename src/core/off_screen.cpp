#include "core/off_screen.hpp"

#include <algorithm>

namespace speculum {

namespace {

enum class Use { output, resolved };

Image makeColor(Device& device, const OffScreenDesc& desc, Use use) {
  const bool output = use == Use::output;
  const VkSampleCountFlagBits samples = output && !desc.multisampledOutput ? VK_SAMPLE_COUNT_1_BIT : desc.samples;
  VkImageUsageFlags usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
  usage |= output || desc.readSamples ? VK_IMAGE_USAGE_SAMPLED_BIT : 0;
  usage |= samples == VK_SAMPLE_COUNT_1_BIT ? VK_IMAGE_USAGE_TRANSFER_SRC_BIT : 0;
  return Image(device, {.extent = desc.extent,
                        .format = desc.format,
                        .usage = usage,
                        .samples = samples,
                        .name = output ? desc.name : desc.name + " samples"});
}

Image makeDepth(Device& device, VkExtent2D extent, VkSampleCountFlagBits samples, std::string name) {
  return Image(device, {.extent = extent,
                        .format = depthFormat,
                        .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
                        .samples = samples,
                        .name = std::move(name)});
}

}  // namespace

void SharedDepth::require(VkExtent2D extent, RetireQueue& retired) {
  trim({std::max(extent.width, extent_.width), std::max(extent.height, extent_.height)}, retired);
}

void SharedDepth::trim(VkExtent2D extent, RetireQueue& retired) {
  if (sameExtent(extent, extent_)) {
    return;
  }
  retired.take(image_);
  extent_ = extent;
  if (extent.width > 0 && extent.height > 0) {
    image_ = makeDepth(*device_, extent, samples_, name_ + " depth");
  }
}

OffScreen::OffScreen(Device& device, const OffScreenDesc& desc, RetireQueue& retired) : device_(&device), desc_(desc) {
  if (desc_.shared) {
    desc_.samples = desc_.shared->samples();
  }
  create(retired);
}

void OffScreen::resize(VkExtent2D extent, RetireQueue& retired) {
  if (desc_.shared) {
    desc_.shared->require(extent, retired);
  }
  if (!sameExtent(extent, desc_.extent) || (!color_ && desc_.color)) {
    desc_.extent = extent;
    retire(retired);
    create(retired);
  }
}

void OffScreen::retire(RetireQueue& retired) {
  retired.take(sampler_);
  for (Image* image : {&color_, &samples_, &depth_}) {
    retired.take(*image);
  }
}

void OffScreen::create(RetireQueue& retired) {
  if (desc_.color) {
    sampler_ = createSampler(*device_, {.maxLod = 0.0f}, desc_.name);
    color_ = makeColor(*device_, desc_, Use::output);
    if (color_.samples() != desc_.samples) {
      samples_ = makeColor(*device_, desc_, Use::resolved);
    }
  }
  if (desc_.shared) {
    desc_.shared->require(desc_.extent, retired);
  } else if (desc_.depth) {
    depth_ = makeDepth(*device_, desc_.extent, desc_.samples, desc_.name + " depth");
  }
}

PassTargets OffScreen::targets() {
  Image* depth = desc_.shared ? desc_.shared->image() : &depth_;
  return {.color = samples_ ? &samples_ : &color_,
          .resolve = samples_ ? &color_ : nullptr,
          .depth = desc_.depth ? depth : nullptr,
          .role = desc_.role};
}

PassTargets OffScreen::targets(SharedDepth& depth, RetireQueue& retired) {
  depth.require(desc_.extent, retired);
  PassTargets with = targets();
  with.depth = depth.image();
  return with;
}

}  // namespace speculum
