#include "core/image.hpp"

#include <algorithm>
#include <bit>

namespace speculum {

uint32_t mipLevelCount(VkExtent2D extent) {
  return static_cast<uint32_t>(std::bit_width(std::max({extent.width, extent.height, 1u})));
}

Image::Image(Device& device, const ImageDesc& desc) : desc_(desc) {
  desc_.format = desc.format == depthFormat ? device.caps().depthFormat : desc.format;
  const uint32_t largest = device.limits().maxImageDimension2D;
  if (std::max(desc.extent.width, desc.extent.height) > largest) {
    throw std::runtime_error(desc.name + " of " + std::to_string(desc.extent.width) + "x" +
                             std::to_string(desc.extent.height) + " pixels: the device takes at most " +
                             std::to_string(largest) + " a side (lower --size or reflection.scale)");
  }
  owned_ = device.create(vkCreateImage,
                         {.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                          .imageType = VK_IMAGE_TYPE_2D,
                          .format = desc_.format,
                          .extent = {desc.extent.width, desc.extent.height, 1},
                          .mipLevels = desc.mipLevels,
                          .arrayLayers = 1,
                          .samples = desc.samples,
                          .tiling = VK_IMAGE_TILING_OPTIMAL,
                          .usage = desc.usage,
                          .sharingMode = VK_SHARING_MODE_EXCLUSIVE,
                          .initialLayout = VK_IMAGE_LAYOUT_UNDEFINED},
                         desc.name);
  image_ = owned_.get();
  memory_ = Memory(device, image_, desc.name);
  createView(device);
}

Image::Image(Device& device, VkImage borrowed, const ImageDesc& desc) : desc_(desc), image_(borrowed) {
  device.setName(borrowed, desc.name);
  createView(device);
}

Image& Image::operator=(Image&& other) noexcept {
  if (this != &other) {
    std::destroy_at(this);
    std::construct_at(this, std::move(other));
  }
  return *this;
}

VkImageAspectFlags Image::aspect() const {
  return std::ranges::find(depthFormats, desc_.format) != depthFormats.end() ? VK_IMAGE_ASPECT_DEPTH_BIT
                                                                             : VK_IMAGE_ASPECT_COLOR_BIT;
}

void Image::createView(Device& device) {
  view_ = device.create(vkCreateImageView,
                        {.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                         .image = image_,
                         .viewType = VK_IMAGE_VIEW_TYPE_2D,
                         .format = desc_.format,
                         .subresourceRange = {aspect(), 0, desc_.mipLevels, 0, 1}},
                        desc_.name);
}

SamplerHandle createSampler(Device& device, const SamplerDesc& desc, const std::string& name) {
  return device.create(vkCreateSampler,
                       {.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
                        .magFilter = desc.filter,
                        .minFilter = desc.filter,
                        .mipmapMode = desc.mipmapMode,
                        .addressModeU = desc.addressMode,
                        .addressModeV = desc.addressMode,
                        .addressModeW = desc.addressMode,
                        .anisotropyEnable = desc.anisotropy > 1.0f,
                        .maxAnisotropy = desc.anisotropy,
                        .maxLod = desc.maxLod},
                       name);
}

}  // namespace speculum
