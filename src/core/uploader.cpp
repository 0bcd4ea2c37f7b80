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
  together([&] {
    record(commands());
    submit();
  });
}

void Uploader::together(const std::function<void()>& work) {
  ++nested_;
  try {
    work();
    if (nested_ == 1) {
      submit();
    }
  } catch (...) {
    commands_ = VK_NULL_HANDLE;  // what they use may be gone: pool_.begin() empties them
    staged_ = 0;
    --nested_;
    throw;
  }
  --nested_;
}

VkCommandBuffer Uploader::commands() {
  commands_ = commands_ ? commands_ : pool_.begin();
  return commands_;
}

void Uploader::submit() {
  const VkCommandBuffer commands = std::exchange(commands_, VK_NULL_HANDLE);
  staged_ = 0;
  if (!commands) {
    return;
  }
  check(vkEndCommandBuffer(commands), "end an upload");
  const VkSubmitInfo submit{
      .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO, .commandBufferCount = 1, .pCommandBuffers = &commands};
  device_.submit(submit, fence_.get(), "submit an upload");
  try {
    device_.await(fence_.get(), "wait for an upload");
  } catch (...) {
    device_.settle();  // after this, the caller may destroy the objects that the commands used
    throw;
  }
}

Uploader::Staged Uploader::stage(VkDeviceSize bytes, VkDeviceSize unit) {
  constexpr VkDeviceSize alignment = 16;  // of texels of any format
  if (!staging_) {
    staging_ = Buffer(device_, stagingBytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, BufferMemory::host, "staging");
  }
  if (stagingBytes - staged_ < std::min(bytes, unit)) {
    submit();
  }
  const VkDeviceSize count = std::min(bytes, (stagingBytes - staged_) / unit * unit);
  const Staged piece{{staging_.mapped() + staged_, static_cast<size_t>(count)}, staged_};
  staged_ = std::min((staged_ + count + alignment - 1) / alignment * alignment, stagingBytes);
  return piece;
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
  const auto sizeOf = [&](uint32_t level) {
    return VkExtent2D{std::max(extent.width >> level, 1u), std::max(extent.height >> level, 1u)};
  };
  VkDeviceSize expected = 0;
  for (uint32_t level = 0; level < target.desc().mipLevels; ++level) {
    expected += areaOf(sizeOf(level)) * bytesOfTexel(format);
  }
  if (texels.size() != expected) {
    throw std::logic_error("image " + name + " needs " + std::to_string(expected) + " bytes of texels, not " +
                           std::to_string(texels.size()));
  }
  together([&] {
    Barriers::uploadToCopy(commands(), target);
    for (uint32_t level = 0; level < target.desc().mipLevels; ++level) {
      const VkExtent2D size = sizeOf(level);
      const VkDeviceSize rowBytes = size.width * bytesOfTexel(format);
      for (uint32_t row = 0; row < size.height;) {
        const Staged piece = stage((size.height - row) * rowBytes, rowBytes);
        std::memcpy(piece.bytes.data(), texels.data(), piece.bytes.size());
        texels = texels.subspan(piece.bytes.size());
        const auto rows = static_cast<uint32_t>(piece.bytes.size() / rowBytes);
        const VkBufferImageCopy region{.bufferOffset = piece.offset,
                                       .imageSubresource = {target.aspect(), level, 0, 1},
                                       .imageOffset = {0, static_cast<int32_t>(row), 0},
                                       .imageExtent = {size.width, rows, 1}};
        vkCmdCopyBufferToImage(commands(), staging_.get(), target.get(), target.layout(), 1, &region);
        row += rows;
      }
    }
    device_.barriers().record(commands(), BarrierKind::uploadToRead, target);
  });
  return target;
}

BufferWriter::BufferWriter(Uploader& uploader, VkDeviceSize bytes, VkBufferUsageFlags usage, const std::string& name)
    : uploader_(uploader),
      bytes_(bytes),
      target_(uploader.device(), bytes, usage | VK_BUFFER_USAGE_TRANSFER_DST_BIT, BufferMemory::device, name) {}

void BufferWriter::write(std::span<const std::byte> data) {
  if (data.size() > bytes_ - flushed_ - filled_) {
    throw std::out_of_range("more bytes than the buffer has");
  }
  while (!data.empty()) {
    if (filled_ == piece_.bytes.size()) {
      flush();
      piece_ = uploader_.stage(bytes_ - flushed_, 1);
    }
    const size_t count = std::min(data.size(), piece_.bytes.size() - filled_);
    std::memcpy(piece_.bytes.data() + filled_, data.data(), count);
    filled_ += count;
    data = data.subspan(count);
  }
}

void BufferWriter::flush() {
  if (filled_ == 0) {
    return;
  }
  uploader_.together([&] {
    const VkCommandBuffer commands = uploader_.commands();
    const VkBufferCopy region{.srcOffset = piece_.offset, .dstOffset = flushed_, .size = filled_};
    vkCmdCopyBuffer(commands, uploader_.staging_.get(), target_.get(), 1, &region);
    uploader_.device().barriers().record(commands, BarrierKind::uploadToRead, target_.descriptor());
  });
  flushed_ += filled_;
  filled_ = 0;
  piece_ = {};
}

Buffer BufferWriter::finish() {
  if (flushed_ + filled_ != bytes_) {
    throw std::logic_error("a buffer of " + std::to_string(bytes_) + " bytes got " +
                           std::to_string(flushed_ + filled_));
  }
  flush();
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
