#include "core/uploader.hpp"

#include <algorithm>
#include <cstring>
#include <glm/gtc/packing.hpp>
#include <stdexcept>

namespace speculum {

Uploader::Uploader(Device& device)
    : device_(device),
      pool_(device, "uploads"),
      fence_(device.create(vkCreateFence, {.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO}, "uploads")) {}

void Uploader::run(const std::function<void(VkCommandBuffer)>& record) {
  const VkCommandBuffer commands = pool_.begin();
  record(commands);
  check(vkEndCommandBuffer(commands), "end an upload");
  const VkSubmitInfo submit{
      .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO, .commandBufferCount = 1, .pCommandBuffers = &commands};
  check(vkQueueSubmit(device_.queue(), 1, &submit, fence_.get()), "submit an upload");
  try {
    device_.await(fence_.get(), "wait for an upload");
  } catch (...) {
    device_.settle();  // after this, the caller may destroy the objects that `record` used
    throw;
  }
}

Buffer Uploader::buffer(std::span<const std::byte> data, VkBufferUsageFlags usage, const std::string& name) {
  BufferWriter writer(*this, data.size(), usage, name);
  writer.write(data);
  return writer.finish();
}

Image Uploader::image(std::span<const std::byte> texels, VkExtent2D extent, VkFormat format, bool mipmaps,
                      const std::string& name) {
  Image target(device_,
               {.extent = extent,
                .format = format,
                .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                .mipLevels = mipmaps ? mipLevelCount(extent) : 1,
                .name = name});
  std::vector<VkBufferImageCopy> levels;
  VkDeviceSize expected = 0;
  for (uint32_t level = 0; level < target.desc().mipLevels; ++level) {
    const VkExtent2D size{std::max(extent.width >> level, 1u), std::max(extent.height >> level, 1u)};
    levels.push_back({.bufferOffset = expected,
                      .imageSubresource = {target.aspect(), level, 0, 1},
                      .imageExtent = {size.width, size.height, 1}});
    expected += areaOf(size) * bytesOfTexel(format);
  }
  if (texels.size() != expected) {
    throw std::logic_error("image " + name + " needs " + std::to_string(expected) + " bytes of texels, not " +
                           std::to_string(texels.size()));
  }
  const Buffer staging(device_, texels.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT, BufferMemory::host,
                       "staging of " + name);
  staging.write(texels);
  run([&](VkCommandBuffer commands) {
    Barriers::uploadToCopy(commands, target);
    vkCmdCopyBufferToImage(commands, staging.get(), target.get(), target.layout(), static_cast<uint32_t>(levels.size()),
                           levels.data());
    device_.barriers().record(commands, BarrierKind::uploadToRead, target);
  });
  return target;
}

BufferWriter::BufferWriter(Uploader& uploader, VkDeviceSize bytes, VkBufferUsageFlags usage, const std::string& name)
    : uploader_(uploader),
      bytes_(bytes),
      target_(uploader.device(), bytes, usage | VK_BUFFER_USAGE_TRANSFER_DST_BIT, BufferMemory::device, name) {
  if (bytes > 0) {
    staging_ = Buffer(uploader.device(), std::min(bytes, pieceBytes), VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                      BufferMemory::host, "staging of " + name);
  }
}

void BufferWriter::write(std::span<const std::byte> data) {
  if (data.size() > bytes_ - flushed_ - staged_) {
    throw std::out_of_range("more bytes than the buffer has");
  }
  while (!data.empty()) {
    const auto count = static_cast<size_t>(std::min<VkDeviceSize>(data.size(), staging_.bytes() - staged_));
    std::memcpy(staging_.mapped() + staged_, data.data(), count);
    staged_ += count;
    data = data.subspan(count);
    if (staged_ == staging_.bytes()) {
      flush();
    }
  }
}

void BufferWriter::flush() {
  uploader_.run([&](VkCommandBuffer commands) {
    const VkBufferCopy region{.dstOffset = flushed_, .size = staged_};
    vkCmdCopyBuffer(commands, staging_.get(), target_.get(), 1, &region);
    uploader_.device().barriers().record(commands, BarrierKind::uploadToRead, target_.descriptor());
  });
  flushed_ += staged_;
  staged_ = 0;
}

Buffer BufferWriter::finish() {
  if (flushed_ + staged_ != bytes_) {
    throw std::logic_error("a buffer of " + std::to_string(bytes_) + " bytes got " +
                           std::to_string(flushed_ + staged_));
  }
  if (staged_ > 0) {
    flush();
  }
  return std::move(target_);
}

std::array<float, 256> Uploader::decodedSrgb() {
  std::array<uint32_t, 256> codes;
  for (uint32_t i = 0; i < codes.size(); ++i) {
    codes[i] = 0x010101u * i;
  }
  const VkExtent2D extent{codes.size(), 1};
  Image source = image(std::as_bytes(std::span(codes)), extent, VK_FORMAT_R8G8B8A8_SRGB, false, "sRGB codes");
  Image target(device_,
               {.extent = extent,
                .format = VK_FORMAT_R32G32B32A32_SFLOAT,
                .usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
                .name = "decoded sRGB"});
  run([&](VkCommandBuffer commands) {
    device_.barriers().record(commands, BarrierKind::readbackToCopy, source);
    Barriers::uploadToCopy(commands, target);
    const VkOffset3D end{static_cast<int32_t>(codes.size()), 1, 1};
    const VkImageBlit region{.srcSubresource = {source.aspect(), 0, 0, 1},
                             .srcOffsets = {{}, end},
                             .dstSubresource = {target.aspect(), 0, 0, 1},
                             .dstOffsets = {{}, end}};
    vkCmdBlitImage(commands, source.get(), source.layout(), target.get(), target.layout(), 1, &region,
                   VK_FILTER_NEAREST);
    device_.barriers().record(commands, BarrierKind::uploadToRead, target);
  });
  const std::vector<float> texels = readFloats(target);
  std::array<float, 256> decoded;
  for (size_t i = 0; i < decoded.size(); ++i) {
    decoded[i] = texels[4 * i];
  }
  return decoded;
}

std::vector<std::byte> Uploader::read(Image& image) {
  const VkDeviceSize bytes = areaOf(image.extent()) * bytesOfTexel(image.format());
  const Buffer staging(device_, bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT, BufferMemory::host,
                       "read-back of " + image.desc().name);
  run([&](VkCommandBuffer commands) {
    const VkImageLayout layout = image.layout();
    device_.barriers().record(commands, BarrierKind::readbackToCopy, image);
    const VkBufferImageCopy region{.imageSubresource = {image.aspect(), 0, 0, 1},
                                   .imageExtent = {image.extent().width, image.extent().height, 1}};
    vkCmdCopyImageToBuffer(commands, image.get(), image.layout(), staging.get(), 1, &region);
    device_.barriers().record(commands, BarrierKind::readbackFromCopy, image, layout);
    Barriers::copyToHost(commands);
  });
  return {staging.mapped(), staging.mapped() + bytes};
}

std::vector<float> Uploader::readFloats(Image& image) {
  const bool whole = image.format() == VK_FORMAT_R32G32B32A32_SFLOAT;
  if (!whole && image.format() != VK_FORMAT_R16G16B16A16_SFLOAT) {
    throw std::logic_error("readFloats takes RGBA16F and RGBA32F images, which " + image.desc().name + " is not");
  }
  const std::vector<std::byte> raw = read(image);
  if (whole) {
    std::vector<float> values(raw.size() / sizeof(float));
    std::memcpy(values.data(), raw.data(), raw.size());
    return values;
  }
  std::vector<uint16_t> halves(raw.size() / sizeof(uint16_t));
  std::memcpy(halves.data(), raw.data(), raw.size());
  std::vector<float> values(halves.size());
  std::ranges::transform(halves, values.begin(), [](uint16_t half) { return glm::unpackHalf1x16(half); });
  return values;
}

CommandPool::CommandPool(Device& device, const std::string& name)
    : device_(device),
      pool_(device.create(vkCreateCommandPool,
                          {.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                           .flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT,
                           .queueFamilyIndex = device.queueFamily()},
                          name)) {
  const VkCommandBufferAllocateInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                         .commandPool = pool_.get(),
                                         .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                         .commandBufferCount = 1};
  check(vkAllocateCommandBuffers(device.get(), &info, &commands_), "allocate the command buffer of " + name);
  device.setName(commands_, name);
}

VkCommandBuffer CommandPool::begin() {
  check(vkResetCommandPool(device_.get(), pool_.get(), 0), "reset a command pool");
  const VkCommandBufferBeginInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                      .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
  check(vkBeginCommandBuffer(commands_, &info), "begin to record commands");
  return commands_;
}

}  // namespace speculum
