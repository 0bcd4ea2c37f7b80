#pragma once

#include <vulkan/vulkan.h>

#include <optional>
#include <span>
#include <string_view>

namespace speculum {

class Image;

// Every dependency of the project has a name, so that a test can leave each out in turn and see it missed.
enum class BarrierKind {
  offscreenBeforeWrite,         // resolved or single-sample colour: earlier samplings and writes -> attachment
  offscreenSamplesBeforeWrite,  // multisampled colour: earlier resolves, samplings and writes -> attachment
  offscreenDepthBeforeWrite,    // late depth writes of the pass before -> clear
  offscreenToSample,            // attachment -> fragment shader
  mainBeforeWrite,              // the same four for the main view
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
  readbackFromCopy,  // transfer source -> attachment or sampled image
  uploadToRead,      // transfer write -> shader, index and vertex reads
  mipmapToBlit,      // a level written -> source of the next level's blit
};
inline constexpr int barrierKindCount = static_cast<int>(BarrierKind::mipmapToBlit) + 1;

// Layout of the overlay's pass. Validation layer 1.3.239 takes colour writes and loads of different render passes for
// ordered by rasterisation and notices a missing dependency between them only at a change of layout.
inline constexpr VkImageLayout overlayLayout = VK_IMAGE_LAYOUT_GENERAL;

std::string_view barrierName(BarrierKind kind);  // the enumerator's name
std::optional<BarrierKind> barrierFromName(std::string_view name);
std::span<const BarrierKind> allBarrierKinds();

// Records the project's barriers: each waits and changes the layout as its kind says. Leaving a kind out keeps its
// change of layout and drops the dependency.
class Barriers {
 public:
  void omit(std::optional<BarrierKind> kind) { omitted_ = kind; }

  // Guards images that one pass, or several that share no image, use alike; in one command.
  void record(VkCommandBuffer commands, BarrierKind kind, std::span<Image* const> images) const;
  void record(VkCommandBuffer commands, BarrierKind kind, Image& image) const;
  // Brings the image back to `layout`, for kinds that do not say which.
  void record(VkCommandBuffer commands, BarrierKind kind, Image& image, VkImageLayout layout) const;
  void record(VkCommandBuffer commands, BarrierKind kind, const VkDescriptorBufferInfo& buffer) const;
  // Guards one level. Goes through the levels in order; after the last the whole image is in the kind's layout.
  void recordLevel(VkCommandBuffer commands, BarrierKind kind, Image& image, uint32_t level) const;

  // Barriers that no test can leave out: nothing has used the image yet, or the host reads.
  static void uploadToCopy(VkCommandBuffer commands, Image& fresh);
  static void computeToHost(VkCommandBuffer commands);
  static void copyToHost(VkCommandBuffer commands);

 private:
  std::optional<BarrierKind> omitted_;
};

}  // namespace speculum
