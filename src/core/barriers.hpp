#pragma once

#include <vulkan/vulkan.h>

#include <array>
#include <optional>
#include <span>
#include <string_view>

namespace speculum {

class Image;
class Buffer;

// Every dependency of the project has a name, so that a test can leave each out in turn and see it missed.
enum class BarrierKind {
  offscreenBeforeWrite,         // resolved or single-sample colour: earlier samplings and writes -> attachment
  offscreenSamplesBeforeWrite,  // multisampled colour: earlier resolves, samplings and writes -> attachment
  offscreenDepthBeforeWrite,    // late depth writes of the pass before -> clear
  offscreenToSample,            // attachment -> fragment shader
  mainBeforeWrite,
  mainSamplesBeforeWrite,
  mainDepthBeforeWrite,
  mainToSample,
  depthToSample,           // depth of a pass that is looked at -> fragment shader
  targetToCheck,           // attachment -> compute shader, also where fragment shaders sample it
  checkToLookUp,           // results of a check -> the dispatch that looks up what was found
  checkToWrite,            // compute shader -> what attachments wait for before they are written again
  swapchainBeforeWrite,    // acquired image (or the last read back) -> attachment
  swapchainBeforeOverlay,  // attachment of the pass before -> attachment that loads it
  swapchainToPresent,
  readbackToCopy,    // attachment or sampled image -> transfer source
  readbackFromCopy,  // transfer source -> what it was before
  uploadToRead,      // transfer write -> shader, index and vertex reads
  mipmapToBlit,      // a level written -> source of the next level's blit
};
// The layer of 2023 takes colour writes and loads of different render passes for ordered by rasterisation and notices a
// missing dependency between them only at a change of layout.
inline constexpr VkImageLayout overlayLayout = VK_IMAGE_LAYOUT_GENERAL;

inline constexpr int barrierKindCount = static_cast<int>(BarrierKind::mipmapToBlit) + 1;

std::string_view barrierName(BarrierKind kind);  // the enumerator's name
std::optional<BarrierKind> barrierFromName(std::string_view name);
std::span<const BarrierKind> allBarrierKinds();

// What a pass's targets are for; decides which kinds of barrier guard them.
enum class TargetRole { offscreen, main, swapchain };

// Records the project's barriers. Leaving a kind out keeps its layout transition and drops the dependency.
class Barriers {
 public:
  void omit(std::optional<BarrierKind> kind) { omitted_ = kind; }
  std::optional<BarrierKind> omitted() const { return omitted_; }

  // Of one pass or of several that share no image, in one command. With `keep` the content survives; otherwise all of
  // it becomes undefined, also outside a pass's render area.
  void colorBeforeWrite(VkCommandBuffer commands, TargetRole role, std::span<Image* const> images, bool keep) const;
  void samplesBeforeWrite(VkCommandBuffer commands, TargetRole role, std::span<Image* const> images, bool keep) const;
  void depthBeforeWrite(VkCommandBuffer commands, TargetRole role, std::span<Image* const> images, bool keep) const;
  void colorToSample(VkCommandBuffer commands, TargetRole role, std::span<Image* const> images) const;
  void depthToSample(VkCommandBuffer commands, Image& image) const;
  // Of a pass's output or its samples, which become readable in compute shaders.
  void targetToCheck(VkCommandBuffer commands, Image& image) const;
  void checkToLookUp(VkCommandBuffer commands, const VkDescriptorBufferInfo& results) const;
  void checkToWrite(VkCommandBuffer commands, Image& image) const;
  void checkToHost(VkCommandBuffer commands) const;
  // Into GENERAL, the layout of the overlay's pass: see overlayLayout.
  void swapchainBeforeOverlay(VkCommandBuffer commands, Image& image) const;
  void swapchainToPresent(VkCommandBuffer commands, Image& image) const;
  void readbackToCopy(VkCommandBuffer commands, Image& image) const;
  void readbackFromCopy(VkCommandBuffer commands, Image& image, VkImageLayout layout) const;
  void readbackToHost(VkCommandBuffer commands) const;
  void uploadToCopy(VkCommandBuffer commands, Image& fresh) const;  // nothing to wait for: no kind
  void uploadToRead(VkCommandBuffer commands, Image& image) const;
  void uploadToRead(VkCommandBuffer commands, const Buffer& buffer) const;
  // `level` becomes a transfer source. Goes through the levels in order; the last makes the whole image one.
  void mipmapToBlit(VkCommandBuffer commands, Image& image, uint32_t level) const;

 private:
  struct Scope {
    VkPipelineStageFlags stages;
    VkAccessFlags access;
  };
  void record(VkCommandBuffer commands, BarrierKind kind, Image& image, Scope before, Scope after,
              VkImageLayout layout) const;
  void record(VkCommandBuffer commands, BarrierKind kind, std::span<Image* const> images, Scope before, Scope after,
              VkImageLayout layout) const;

  std::optional<BarrierKind> omitted_;
};

}  // namespace speculum
