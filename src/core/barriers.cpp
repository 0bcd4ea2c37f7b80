#include "core/barriers.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "core/image.hpp"

namespace speculum {

namespace {

struct Scope {
  VkPipelineStageFlags stages;
  VkAccessFlags access;
};

struct Rule {
  std::string_view name;
  Scope before;
  Scope after;
  VkImageLayout layout;  // VK_IMAGE_LAYOUT_UNDEFINED: the image keeps its own, or the caller says which
};

constexpr VkPipelineStageFlags colorStage = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
constexpr VkPipelineStageFlags depthStages =
    VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT;
constexpr VkPipelineStageFlags sampleStage = VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT;
constexpr VkPipelineStageFlags computeStage = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT;
constexpr VkPipelineStageFlags transferStage = VK_PIPELINE_STAGE_TRANSFER_BIT;
constexpr VkAccessFlags colorAccess = VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT;

constexpr Scope colorWrites{colorStage, VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT};
constexpr Scope colorUses{colorStage, colorAccess};
// Also waits for shaders that sampled a color before it is copied or checked.
constexpr Scope colorWritesAndSamplings{colorStage | sampleStage, VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT};
constexpr Scope depthWrites{depthStages, VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT};
constexpr Scope depthUses{depthStages, VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT | depthWrites.access};
constexpr Scope samplings{sampleStage, VK_ACCESS_SHADER_READ_BIT};
constexpr Scope allSamplings{sampleStage | computeStage, VK_ACCESS_SHADER_READ_BIT};
constexpr Scope computeReads{computeStage, VK_ACCESS_SHADER_READ_BIT};
constexpr Scope computeWrites{computeStage, VK_ACCESS_SHADER_WRITE_BIT};
constexpr Scope copyReads{transferStage, VK_ACCESS_TRANSFER_READ_BIT};
constexpr Scope copyWrites{transferStage, VK_ACCESS_TRANSFER_WRITE_BIT};
constexpr Scope colorAndCopyWrites{colorStage | transferStage, colorWrites.access | copyWrites.access};
constexpr Scope drawReads{
    VK_PIPELINE_STAGE_VERTEX_INPUT_BIT | VK_PIPELINE_STAGE_VERTEX_SHADER_BIT | sampleStage | computeStage,
    VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_UNIFORM_READ_BIT | VK_ACCESS_INDEX_READ_BIT |
        VK_ACCESS_VERTEX_ATTRIBUTE_READ_BIT};
constexpr Scope hostReads{VK_PIPELINE_STAGE_HOST_BIT, VK_ACCESS_HOST_READ_BIT};
// Also waits for copies into the buffers that a build reads.
constexpr Scope builds{VK_PIPELINE_STAGE_ACCELERATION_STRUCTURE_BUILD_BIT_KHR | transferStage,
                       VK_ACCESS_ACCELERATION_STRUCTURE_READ_BIT_KHR | VK_ACCESS_ACCELERATION_STRUCTURE_WRITE_BIT_KHR |
                           VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_TRANSFER_WRITE_BIT};
constexpr Scope nothing{VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, 0};

constexpr VkImageLayout attachment = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
constexpr VkImageLayout depthAttachment = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
constexpr VkImageLayout sampled = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
constexpr VkImageLayout unsaid = VK_IMAGE_LAYOUT_UNDEFINED;

// Rules by kind. A submission waits for the acquire semaphore of a swapchain image at the color stage, which chains the
// semaphore to the image's barrier.
constexpr std::array<Rule, barrierKindCount> rules = {{
    {"offscreenBeforeWrite", colorWrites, colorUses, attachment},
    {"offscreenSamplesBeforeWrite", colorWrites, colorUses, attachment},
    {"offscreenDepthBeforeWrite", depthWrites, depthUses, depthAttachment},
    {"offscreenToSample", colorWrites, allSamplings, sampled},
    {"mainBeforeWrite", colorWrites, colorUses, attachment},
    {"mainSamplesBeforeWrite", colorWrites, colorUses, attachment},
    {"mainDepthBeforeWrite", depthWrites, depthUses, depthAttachment},
    {"mainToSample", colorWrites, samplings, sampled},
    {"depthToSample", depthWrites, samplings, sampled},
    {"targetToCheck", colorWritesAndSamplings, computeReads, sampled},
    {"checkToLookUp", computeWrites, computeReads, unsaid},
    {"checkToWrite", {computeStage, 0}, {colorStage | sampleStage, 0}, unsaid},
    {"surfacesToShade", colorWritesAndSamplings, computeReads, sampled},
    {"shadedToDraw", computeWrites, {sampleStage | colorStage, VK_ACCESS_SHADER_READ_BIT}, unsaid},
    {"swapchainBeforeWrite", colorWrites, colorUses, attachment},
    {"swapchainBeforeOverlay", colorWrites, colorUses, overlayLayout},
    {"swapchainToPresent",
     colorAndCopyWrites,
     {VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, 0},
     VK_IMAGE_LAYOUT_PRESENT_SRC_KHR},
    {"readbackToCopy", colorWritesAndSamplings, copyReads, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL},
    {"readbackFromCopy",
     {transferStage, 0},
     {colorStage | sampleStage, colorAccess | VK_ACCESS_SHADER_READ_BIT},
     unsaid},
    {"uploadToRead", copyWrites, drawReads, sampled},
}};

constexpr auto kinds = [] {
  std::array<BarrierKind, barrierKindCount> all{};
  for (int i = 0; i < barrierKindCount; ++i) {
    all[i] = static_cast<BarrierKind>(i);
  }
  return all;
}();

const Rule& ruleOf(BarrierKind kind) {
  return rules[static_cast<size_t>(kind)];
}

// Returns the earlier uses that a barrier waits for: those of the rule and, before an attachment is written, shaders
// that sample it, if any of the images can be sampled.
Scope before(const Rule& rule, std::span<Image* const> images) {
  const bool writes = rule.layout == attachment || rule.layout == depthAttachment;
  const bool read = std::ranges::any_of(
      images, [](const Image* image) { return (image->desc().usage & VK_IMAGE_USAGE_SAMPLED_BIT) != 0; });
  return {rule.before.stages | (writes && read ? sampleStage : 0), rule.before.access};
}

VkImageMemoryBarrier imageBarrier(const Image& image, const Scope& before, const Scope& after, VkImageLayout layout) {
  // Depth and stencil change their layouts together.
  const bool stencil = image.format() == VK_FORMAT_D32_SFLOAT_S8_UINT;
  const VkImageAspectFlags aspects = image.aspect() | (stencil ? VkImageAspectFlags{VK_IMAGE_ASPECT_STENCIL_BIT} : 0u);
  return {.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER,
          .srcAccessMask = before.access,
          .dstAccessMask = after.access,
          .oldLayout = image.layout(),
          .newLayout = layout,
          .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
          .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
          .image = image.get(),
          .subresourceRange = {aspects, 0, image.desc().mipLevels, 0, 1}};
}

void recordImages(VkCommandBuffer commands, const Scope& before, const Scope& after,
                  std::span<const VkImageMemoryBarrier> barriers) {
  if (!barriers.empty()) {
    vkCmdPipelineBarrier(commands, before.stages, after.stages, 0, 0, nullptr, 0, nullptr,
                         static_cast<uint32_t>(barriers.size()), barriers.data());
  }
}

void recordMemory(VkCommandBuffer commands, const Scope& before, const Scope& after) {
  const VkMemoryBarrier barrier{
      .sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER, .srcAccessMask = before.access, .dstAccessMask = after.access};
  vkCmdPipelineBarrier(commands, before.stages, after.stages, 0, 1, &barrier, 0, nullptr, 0, nullptr);
}

}  // namespace

std::string_view barrierName(BarrierKind kind) {
  return ruleOf(kind).name;
}

std::optional<BarrierKind> barrierFromName(std::string_view name) {
  const auto found = std::ranges::find(kinds, name, barrierName);
  return found == kinds.end() ? std::nullopt : std::optional(*found);
}

std::span<const BarrierKind> allBarrierKinds() {
  return kinds;
}

void Barriers::record(VkCommandBuffer commands, BarrierKind kind, std::span<Image* const> images,
                      VkImageLayout layout) const {
  const Rule& rule = ruleOf(kind);
  const VkImageLayout wanted = rule.layout == unsaid ? layout : rule.layout;
  const bool omit = omitted_ == kind;
  const Scope waited = omit ? nothing : before(rule, images);
  std::vector<VkImageMemoryBarrier> barriers;
  for (Image* image : images) {
    const VkImageLayout next = wanted == unsaid ? image->layout() : wanted;
    if (!omit || image->layout() != next) {
      barriers.push_back(imageBarrier(*image, waited, rule.after, next));
    }
    image->setLayout(next);
  }
  recordImages(commands, waited, rule.after, barriers);
}

void Barriers::record(VkCommandBuffer commands, BarrierKind kind, Image& image, VkImageLayout layout) const {
  Image* const images[] = {&image};
  record(commands, kind, images, layout);
}

void Barriers::record(VkCommandBuffer commands, BarrierKind kind, const VkDescriptorBufferInfo& buffer) const {
  if (omitted_ == kind) {
    return;
  }
  const Rule& rule = ruleOf(kind);
  const VkBufferMemoryBarrier barrier{.sType = VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER,
                                      .srcAccessMask = rule.before.access,
                                      .dstAccessMask = rule.after.access,
                                      .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                      .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                      .buffer = buffer.buffer,
                                      .offset = buffer.offset,
                                      .size = buffer.range};
  vkCmdPipelineBarrier(commands, rule.before.stages, rule.after.stages, 0, 0, nullptr, 1, &barrier, 0, nullptr);
}

void Barriers::uploadToCopy(VkCommandBuffer commands, Image& fresh) {
  const VkImageMemoryBarrier barrier = imageBarrier(fresh, nothing, copyWrites, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
  recordImages(commands, nothing, copyWrites, {&barrier, 1});
  fresh.setLayout(VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
}

void Barriers::acquiredToCopy(VkCommandBuffer commands, Image& acquired) {
  constexpr Scope acquire{colorStage, 0};  // where the submission waits for the semaphore
  acquired.setLayout(VK_IMAGE_LAYOUT_UNDEFINED);
  const VkImageMemoryBarrier barrier =
      imageBarrier(acquired, acquire, copyWrites, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
  recordImages(commands, acquire, copyWrites, {&barrier, 1});
  acquired.setLayout(VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
}

void Barriers::computeToHost(VkCommandBuffer commands) {
  recordMemory(commands, computeWrites, hostReads);
}

void Barriers::copyToHost(VkCommandBuffer commands) {
  recordMemory(commands, copyWrites, hostReads);
}

void Barriers::buildToBuild(VkCommandBuffer commands) {
  recordMemory(commands, builds, builds);
}

void Barriers::requestsToUse(VkCommandBuffer commands) {
  constexpr VkPipelineStageFlags stages = computeStage | transferStage | VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT;
  recordMemory(commands, {stages, VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT},
               {stages, VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT |
                            VK_ACCESS_INDIRECT_COMMAND_READ_BIT});
}

void Barriers::buildToTrace(VkCommandBuffer commands) {
  recordMemory(commands, builds, {computeStage, VK_ACCESS_ACCELERATION_STRUCTURE_READ_BIT_KHR});
}

}  // namespace speculum
