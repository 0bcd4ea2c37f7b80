#include "core/image.hpp"

#include <algorithm>
#include <atomic>
#include <bit>

namespace speculum {

namespace {

uint64_t nextId() {
  static std::atomic<uint64_t> last{0};
  return ++last;
}

}  // namespace

uint32_t mipLevelCount(VkExtent2D extent) {
  return static_cast<uint32_t>(std::bit_width(std::max({extent.width, extent.height, 1u})));
}

Image::Image(Device& device, const ImageDesc& desc) : device_(&device), desc_(desc), id_(nextId()) {
  const VkImageCreateInfo info{.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                               .imageType = VK_IMAGE_TYPE_2D,
                               .format = desc.format,
                               .extent = {desc.extent.width, desc.extent.height, 1},
                               .mipLevels = desc.mipLevels,
                               .arrayLayers = 1,
                               .samples = desc.samples,
                               .tiling = VK_IMAGE_TILING_OPTIMAL,
                               .usage = desc.usage,
                               .sharingMode = VK_SHARING_MODE_EXCLUSIVE,
                               .initialLayout = VK_IMAGE_LAYOUT_UNDEFINED};
  VkImage image = VK_NULL_HANDLE;
  check(vkCreateImage(device.get(), &info, nullptr, &image), "create image " + desc.name);
  owned_ = {device.get(), image};
  image_ = image;
  device.setName(image, desc.name);
  VkMemoryRequirements requirements{};
  vkGetImageMemoryRequirements(device.get(), image, &requirements);
  memory_ = device.allocate(requirements, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, desc.name);
  check(vkBindImageMemory(device.get(), image, memory_.get(), 0), "bind the memory of " + desc.name);
  createView();
}

Image::Image(Device& device, VkImage borrowed, const ImageDesc& desc)
    : device_(&device), desc_(desc), id_(nextId()), image_(borrowed) {
  device.setName(borrowed, desc.name);
  createView();
}

Image::Image(Image&& other) noexcept {
  *this = std::move(other);
}

Image& Image::operator=(Image&& other) noexcept {
  if (this != &other) {
    release();
    device_ = other.device_;
    desc_ = std::move(other.desc_);
    id_ = std::exchange(other.id_, 0);
    view_ = std::move(other.view_);
    owned_ = std::move(other.owned_);
    memory_ = std::move(other.memory_);
    image_ = std::exchange(other.image_, static_cast<VkImage>(VK_NULL_HANDLE));
    layout_ = std::exchange(other.layout_, VK_IMAGE_LAYOUT_UNDEFINED);
  }
  return *this;
}

Image::~Image() {
  release();
}

void Image::release() {
  if (id_ != 0) {
    device_->imageDestroyed(std::exchange(id_, 0));
  }
  view_.reset();
  owned_.reset();
  image_ = VK_NULL_HANDLE;
}

VkImageAspectFlags Image::aspect() const {
  return desc_.format == depthFormat ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

void Image::createView() {
  const VkImageViewCreateInfo info{.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                   .image = image_,
                                   .viewType = VK_IMAGE_VIEW_TYPE_2D,
                                   .format = desc_.format,
                                   .subresourceRange = {aspect(), 0, desc_.mipLevels, 0, 1}};
  VkImageView view = VK_NULL_HANDLE;
  check(vkCreateImageView(device_->get(), &info, nullptr, &view), "create a view of image " + desc_.name);
  view_ = {device_->get(), view};
  device_->setName(view, desc_.name);
}

SamplerHandle createSampler(Device& device, const SamplerDesc& desc, const std::string& name) {
  const VkSamplerCreateInfo info{.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
                                 .magFilter = desc.filter,
                                 .minFilter = desc.filter,
                                 .mipmapMode = desc.mipmapMode,
                                 .addressModeU = desc.addressMode,
                                 .addressModeV = desc.addressMode,
                                 .addressModeW = desc.addressMode,
                                 .maxLod = desc.maxLod};
  VkSampler sampler = VK_NULL_HANDLE;
  check(vkCreateSampler(device.get(), &info, nullptr, &sampler), "create sampler " + name);
  device.setName(sampler, name);
  return {device.get(), sampler};
}

}  // namespace speculum
