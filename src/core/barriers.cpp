#include "core/barriers.hpp"

#include <algorithm>
#include <vector>

#include "core/image.hpp"

namespace speculum {

namespace {

constexpr std::array<std::string_view, barrierKindCount> names = {"offscreenBeforeWrite",
                                                                  "offscreenSamplesBeforeWrite",
                                                                  "offscreenDepthBeforeWrite",
                                                                  "offscreenToSample",
                                                                  "mainBeforeWrite",
                                                                  "mainSamplesBeforeWrite",
                                                                  "mainDepthBeforeWrite",
                                                                  "mainToSample",
                                                                  "depthToSample",
                                                                  "targetToCheck",
                                                                  "checkToLookUp",
                                                                  "checkToWrite",
                                                                  "swapchainBeforeWrite",
                                                                  "swapchainBeforeOverlay",
                                                                  "swapchainToPresent",
                                                                  "readbackToCopy",
                                                                  "readbackFromCopy",

                                                                  "uploadToRead",
                                                                  "mipmapToBlit"};

constexpr auto kinds = [] {
  std::array<BarrierKind, barrierKindCount> all{};
  for (int i = 0; i < barrierKindCount; ++i) {
    all[i] = static_cast<BarrierKind>(i);
  }
  return all;
}();

constexpr VkPipelineStageFlags colorStage = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
constexpr VkAccessFlags colorAccess = VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT;
constexpr VkPipelineStageFlags depthStages =
    VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT;
constexpr VkAccessFlags depthAccess =
    VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
constexpr VkPipelineStageFlags sampleStage = VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT;
constexpr VkPipelineStageFlags checkStage = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT;
constexpr VkPipelineStageFlags transferStage = VK_PIPELINE_STAGE_TRANSFER_BIT;
constexpr VkPipelineStageFlags readStages =
    VK_PIPELINE_STAGE_VERTEX_INPUT_BIT | VK_PIPELINE_STAGE_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT;
constexpr VkAccessFlags bufferReads = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_UNIFORM_READ_BIT |
                                      VK_ACCESS_INDEX_READ_BIT | VK_ACCESS_VERTEX_ATTRIBUTE_READ_BIT;

BarrierKind kindFor(TargetRole role, BarrierKind offscreen, BarrierKind main) {
  switch (role) {
    case TargetRole::offscreen:
      return offscreen;
    case TargetRole::main:
      return main;
    case TargetRole::swapchain:
      break;
  }
  return BarrierKind::swapchainBeforeWrite;
}

void discardUnless(bool keep, std::span<Image* const> images) {
  for (Image* image : images) {
    if (!keep) {
      image->setLayout(VK_IMAGE_LAYOUT_UNDEFINED);
    }
  }
}

// The stage at which shaders read any of the images before.
VkPipelineStageFlags readersOf(std::span<Image* const> images) {
  const bool sampled = std::any_of(images.begin(), images.end(), [](const Image* image) {
    return (image->desc().usage & VK_IMAGE_USAGE_SAMPLED_BIT) != 0;
  });
  return sampled ? sampleStage : 0;
}

}  // namespace

std::string_view barrierName(BarrierKind kind) {
  return names[static_cast<size_t>(kind)];
}

std::optional<BarrierKind> barrierFromName(std::string_view name) {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? std::nullopt : std::optional(kinds[found - names.begin()]);
}

std::span<const BarrierKind> allBarrierKinds() {
  return kinds;
}

void Barriers::record(VkCommandBuffer commands, BarrierKind kind, Image& image, Scope before, Scope after,
                      VkImageLayout layout) const {
  Image* const images[] = {&image};
  record(commands, kind, images, before, after, layout);
}

void Barriers::record(VkCommandBuffer commands, BarrierKind kind, std::span<Image* const> images, Scope before,
                      Scope after, VkImageLayout layout) const {
  const bool omit = omitted_ == kind;
  if (omit) {
    before = {VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, 0};
  }
  std::vector<VkImageMemoryBarrier> barriers;
  for (Image* image : images) {
    const VkImageLayout old = image->layout();
    image->setLayout(layout);
    if (omit && old == layout) {
      continue;
    }
    barriers.push_back({.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER,
                        .srcAccessMask = before.access,
                        .dstAccessMask = after.access,
                        .oldLayout = old,
                        .newLayout = layout,
                        .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                        .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                        .image = image->get(),
                        .subresourceRange = {image->aspect(), 0, image->desc().mipLevels, 0, 1}});
  }
  if (!barriers.empty()) {
    vkCmdPipelineBarrier(commands, before.stages, after.stages, 0, 0, nullptr, 0, nullptr,
                         static_cast<uint32_t>(barriers.size()), barriers.data());
  }
}

void Barriers::colorBeforeWrite(VkCommandBuffer commands, TargetRole role, std::span<Image* const> images,
                                bool keep) const {
  discardUnless(keep, images);
  // Earlier readers: fragment shaders that sample it and copies of a read-back. The acquire semaphore of a swapchain
  // image is waited for at the colour stage, which chains it to this barrier.
  const BarrierKind kind = kindFor(role, BarrierKind::offscreenBeforeWrite, BarrierKind::mainBeforeWrite);
  const VkPipelineStageFlags readers = role == TargetRole::swapchain ? 0 : sampleStage;
  record(commands, kind, images, {colorStage | readers, VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT},
         {colorStage, colorAccess}, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
}

void Barriers::samplesBeforeWrite(VkCommandBuffer commands, TargetRole role, std::span<Image* const> images,
                                  bool keep) const {
  discardUnless(keep, images);
  const BarrierKind kind = kindFor(role, BarrierKind::offscreenSamplesBeforeWrite, BarrierKind::mainSamplesBeforeWrite);
  record(commands, kind, images, {colorStage | readersOf(images), VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT},
         {colorStage, colorAccess}, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
}

void Barriers::depthBeforeWrite(VkCommandBuffer commands, TargetRole role, std::span<Image* const> images,
                                bool keep) const {
  discardUnless(keep, images);
  const BarrierKind kind = kindFor(role, BarrierKind::offscreenDepthBeforeWrite, BarrierKind::mainDepthBeforeWrite);
  record(commands, kind, images, {depthStages | readersOf(images), VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT},
         {depthStages, depthAccess}, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL);
}

void Barriers::colorToSample(VkCommandBuffer commands, TargetRole role, std::span<Image* const> images) const {
  const BarrierKind kind = kindFor(role, BarrierKind::offscreenToSample, BarrierKind::mainToSample);
  record(commands, kind, images, {colorStage, VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT},
         {sampleStage, VK_ACCESS_SHADER_READ_BIT}, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
}

void Barriers::depthToSample(VkCommandBuffer commands, Image& image) const {
  record(commands, BarrierKind::depthToSample, image, {depthStages, VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT},
         {sampleStage, VK_ACCESS_SHADER_READ_BIT}, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
}

void Barriers::targetToCheck(VkCommandBuffer commands, Image& image) const {
  // The stage at which colorToSample has left the image, and for samples, which it does not touch, the one that wrote.
  record(commands, BarrierKind::targetToCheck, image, {colorStage | sampleStage, VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT},
         {checkStage, VK_ACCESS_SHADER_READ_BIT}, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
}

void Barriers::checkToLookUp(VkCommandBuffer commands, const VkDescriptorBufferInfo& results) const {
  if (omitted_ == BarrierKind::checkToLookUp) {
    return;
  }
  const VkBufferMemoryBarrier barrier{.sType = VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER,
                                      .srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT,
                                      .dstAccessMask = VK_ACCESS_SHADER_READ_BIT,
                                      .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                      .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                      .buffer = results.buffer,
                                      .offset = results.offset,
                                      .size = results.range};
  vkCmdPipelineBarrier(commands, checkStage, checkStage, 0, 0, nullptr, 1, &barrier, 0, nullptr);
}

void Barriers::checkToWrite(VkCommandBuffer commands, Image& image) const {
  record(commands, BarrierKind::checkToWrite, image, {checkStage, 0}, {colorStage | sampleStage, 0}, image.layout());
}

void Barriers::checkToHost(VkCommandBuffer commands) const {
  const VkMemoryBarrier barrier{.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER,
                                .srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT,
                                .dstAccessMask = VK_ACCESS_HOST_READ_BIT};
  vkCmdPipelineBarrier(commands, checkStage, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &barrier, 0, nullptr, 0, nullptr);
}

void Barriers::swapchainBeforeOverlay(VkCommandBuffer commands, Image& image) const {
  record(commands, BarrierKind::swapchainBeforeOverlay, image, {colorStage, VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT},
         {colorStage, colorAccess}, overlayLayout);
}

void Barriers::swapchainToPresent(VkCommandBuffer commands, Image& image) const {
  record(commands, BarrierKind::swapchainToPresent, image, {colorStage, VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT},
         {VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, 0}, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR);
}

void Barriers::readbackToCopy(VkCommandBuffer commands, Image& image) const {
  record(commands, BarrierKind::readbackToCopy, image, {colorStage | sampleStage, VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT},
         {transferStage, VK_ACCESS_TRANSFER_READ_BIT}, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
}

void Barriers::readbackFromCopy(VkCommandBuffer commands, Image& image, VkImageLayout layout) const {
  record(commands, BarrierKind::readbackFromCopy, image, {transferStage, 0},
         {colorStage | sampleStage, colorAccess | VK_ACCESS_SHADER_READ_BIT}, layout);
}

void Barriers::readbackToHost(VkCommandBuffer commands) const {
  const VkMemoryBarrier barrier{.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER,
                                .srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT,
                                .dstAccessMask = VK_ACCESS_HOST_READ_BIT};
  vkCmdPipelineBarrier(commands, transferStage, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &barrier, 0, nullptr, 0, nullptr);
}

void Barriers::uploadToCopy(VkCommandBuffer commands, Image& fresh) const {
  const VkImageMemoryBarrier barrier{.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER,
                                     .dstAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT,
                                     .oldLayout = VK_IMAGE_LAYOUT_UNDEFINED,
                                     .newLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                                     .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                     .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                     .image = fresh.get(),
                                     .subresourceRange = {fresh.aspect(), 0, fresh.desc().mipLevels, 0, 1}};
  fresh.setLayout(VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, transferStage, 0, 0, nullptr, 0, nullptr, 1,
                       &barrier);
}

void Barriers::uploadToRead(VkCommandBuffer commands, Image& image) const {
  record(commands, BarrierKind::uploadToRead, image, {transferStage, VK_ACCESS_TRANSFER_WRITE_BIT},
         {readStages, VK_ACCESS_SHADER_READ_BIT}, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
}

void Barriers::uploadToRead(VkCommandBuffer commands, const Buffer& buffer) const {
  if (omitted_ == BarrierKind::uploadToRead) {
    return;
  }
  const VkBufferMemoryBarrier barrier{.sType = VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER,
                                      .srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT,
                                      .dstAccessMask = bufferReads,
                                      .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                      .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                      .buffer = buffer.get(),
                                      .offset = 0,
                                      .size = VK_WHOLE_SIZE};
  vkCmdPipelineBarrier(commands, transferStage, readStages, 0, 0, nullptr, 1, &barrier, 0, nullptr);
}

void Barriers::mipmapToBlit(VkCommandBuffer commands, Image& image, uint32_t level) const {
  const bool omit = omitted_ == BarrierKind::mipmapToBlit;
  const VkImageMemoryBarrier barrier{
      .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER,
      .srcAccessMask = omit ? VkAccessFlags{0} : VkAccessFlags{VK_ACCESS_TRANSFER_WRITE_BIT},
      .dstAccessMask = VK_ACCESS_TRANSFER_READ_BIT,
      .oldLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
      .newLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
      .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
      .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
      .image = image.get(),
      .subresourceRange = {image.aspect(), level, 1, 0, 1}};
  const VkPipelineStageFlags before = omit ? VkPipelineStageFlags{VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT} : transferStage;
  vkCmdPipelineBarrier(commands, before, transferStage, 0, 0, nullptr, 0, nullptr, 1, &barrier);
  // All levels are sources once the last one is: the whole image then moves on in one barrier.
  if (level + 1 == image.desc().mipLevels) {
    image.setLayout(VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
  }
}

}  // namespace speculum
