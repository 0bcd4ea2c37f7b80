#pragma once

#include <stdexcept>
#include <string>

#include "core/buffer.hpp"

namespace speculum {

struct ImageDesc {
  VkExtent2D extent{1, 1};
  VkFormat format = VK_FORMAT_R16G16B16A16_SFLOAT;
  VkImageUsageFlags usage = 0;
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
  uint32_t mipLevels = 1;
  std::string name;
};

inline constexpr VkFormat colorFormat = VK_FORMAT_R16G16B16A16_SFLOAT;  // linear radiance
inline constexpr VkFormat depthFormat = VK_FORMAT_D32_SFLOAT;  // reversed Z: 0 is infinitely far. Images and pipelines
                                                               // get DeviceCaps::depthFormat in its place

// Bytes of a texel, without stencil. Throws std::logic_error for a format that the program does not use.
constexpr VkDeviceSize bytesOfTexel(VkFormat format) {
  switch (format) {
    case VK_FORMAT_R8G8B8A8_UNORM:
    case VK_FORMAT_B8G8R8A8_UNORM:
    case VK_FORMAT_R8G8B8A8_SRGB:
    case VK_FORMAT_D32_SFLOAT:
    case VK_FORMAT_D32_SFLOAT_S8_UINT:
    case VK_FORMAT_X8_D24_UNORM_PACK32:
    case VK_FORMAT_R32_SFLOAT:
      return 4;
    case VK_FORMAT_R16G16B16A16_SFLOAT:
    case VK_FORMAT_R32G32_UINT:
      return 8;
    case VK_FORMAT_R32G32B32A32_SFLOAT:
      return 16;
    default:
      throw std::logic_error("the size of format " + std::to_string(format) + " is not known");
  }
}

uint32_t mipLevelCount(VkExtent2D extent);  // down to 1x1

inline VkExtent2D extentOf(int width, int height) {
  return {static_cast<uint32_t>(width), static_cast<uint32_t>(height)};
}
inline bool sameExtent(VkExtent2D a, VkExtent2D b) {
  return a.width == b.width && a.height == b.height;
}
inline uint64_t areaOf(VkExtent2D extent) {
  return uint64_t{extent.width} * extent.height;
}

// A 2D image with a view of all its levels. Owns its memory, or borrows the image of a swapchain.
class Image {
 public:
  Image() = default;
  Image(Device& device, const ImageDesc& desc);
  Image(Device& device, VkImage borrowed, const ImageDesc& desc);
  Image(Image&&) noexcept = default;
  Image& operator=(Image&& other) noexcept;

  VkImage get() const { return image_; }
  VkImageView view() const { return view_.get(); }
  const ImageDesc& desc() const { return desc_; }
  VkExtent2D extent() const { return desc_.extent; }
  VkFormat format() const { return desc_.format; }
  VkSampleCountFlagBits samples() const { return desc_.samples; }
  VkImageAspectFlags aspect() const;  // color or depth
  uint64_t bytes() const { return memory_.bytes(); }
  explicit operator bool() const { return static_cast<bool>(view_); }

  // Layout after the commands recorded so far, which run in the order of recording on the one queue.
  VkImageLayout layout() const { return layout_; }
  void setLayout(VkImageLayout layout) { layout_ = layout; }

  VkDescriptorImageInfo descriptor(VkSampler sampler) const {
    return {sampler, view_.get(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
  }

 private:
  void createView(Device& device);

  ImageDesc desc_;
  Memory memory_;
  ImageHandle owned_;
  VkImage image_ = VK_NULL_HANDLE;
  ImageViewHandle view_;
  VkImageLayout layout_ = VK_IMAGE_LAYOUT_UNDEFINED;
};

struct SamplerDesc {
  VkFilter filter = VK_FILTER_LINEAR;
  VkSamplerMipmapMode mipmapMode = VK_SAMPLER_MIPMAP_MODE_LINEAR;
  VkSamplerAddressMode addressMode = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  float maxLod = VK_LOD_CLAMP_NONE;  // 0: level 0 only
  float anisotropy = 1.0f;           // most lookups along a pixel's footprint, at most Device::anisotropy()
};
inline constexpr SamplerDesc nearestSampler{
    .filter = VK_FILTER_NEAREST, .mipmapMode = VK_SAMPLER_MIPMAP_MODE_NEAREST, .maxLod = 0.0f};
SamplerHandle createSampler(Device& device, const SamplerDesc& desc, const std::string& name);

}  // namespace speculum
