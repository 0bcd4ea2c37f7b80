#pragma once

#include <vulkan/vulkan.h>

#include <optional>
#include <span>
#include <string_view>

namespace speculum {

class Image;

// Kinds of dependency, named so that a test can omit each in turn and expect a message from validation.
enum class BarrierKind {
  offscreenBeforeWrite,         // resolved or single-sample color: earlier samplings and writes -> attachment
  offscreenSamplesBeforeWrite,  // multisampled color: earlier resolves, samplings and writes -> attachment
  offscreenDepthBeforeWrite,    // late depth writes of the pass before -> clear
  offscreenToSample,            // attachment -> fragment shader
  mainBeforeWrite,              // the same four for the main view
  mainSamplesBeforeWrite,
  mainDepthBeforeWrite,
  mainToSample,
  depthToSample,           // depth that the Targets panel shows -> fragment shader
  targetToCheck,           // attachment -> compute shader, also where fragment shaders sample it
  checkToLookUp,           // results of a check -> the dispatch that looks up what was found
  checkToWrite,            // compute shader -> next write as attachment
  surfacesToShade,         // attachment -> compute shader, also where fragment shaders read what it wrote before
  shadedToDraw,            // radiance that compute shaders wrote -> fragment shader, and attachment that they read
  swapchainBeforeWrite,    // acquired image (or the last read back) -> attachment
  swapchainBeforeOverlay,  // attachment of the pass before -> attachment that loads it
  swapchainToPresent,
  readbackToCopy,    // attachment or sampled image -> transfer source
  readbackFromCopy,  // transfer source -> attachment or sampled image
  uploadToRead,      // transfer write -> shader, index and vertex reads
  mipmapToBlit,      // a level written -> source of the next level's blit
};
inline constexpr int barrierKindCount = static_cast<int>(BarrierKind::mipmapToBlit) + 1;

// Layout of the overlay's pass. Validation layer 1.3.239 treats color writes and loads of different render passes as
// ordered by rasterisation, and reports a missing dependency between them only at a change of layout.
inline constexpr VkImageLayout overlayLayout = VK_IMAGE_LAYOUT_GENERAL;

std::string_view barrierName(BarrierKind kind);  // the enumerator's name
std::optional<BarrierKind> barrierFromName(std::string_view name);
std::span<const BarrierKind> allBarrierKinds();

// Records barriers by kind: each is a dependency with a change of layout. Omitting a kind keeps the change of layout
// and drops the dependency.
class Barriers {
 public:
  void omit(std::optional<BarrierKind> kind) { omitted_ = kind; }

  // Records one command for several images of the same use, of one pass or of several that share no image. `layout` is
  // for kinds without a layout of their own: with VK_IMAGE_LAYOUT_UNDEFINED the images keep theirs.
  void record(VkCommandBuffer commands, BarrierKind kind, std::span<Image* const> images,
              VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED) const;
  void record(VkCommandBuffer commands, BarrierKind kind, Image& image,
              VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED) const;
  void record(VkCommandBuffer commands, BarrierKind kind, const VkDescriptorBufferInfo& buffer) const;
  // Records a barrier of one mip level. Call it for the levels in order; after the last the whole image is in the
  // kind's layout.
  void recordLevel(VkCommandBuffer commands, BarrierKind kind, Image& image, uint32_t level) const;

  // Barriers that cannot be omitted, because validation would not report them: nothing has used the image yet, the host
  // reads, or the layer 1.3.239 does not follow atomics and builds of acceleration structures.
  static void uploadToCopy(VkCommandBuffer commands, Image& fresh);
  static void computeToHost(VkCommandBuffer commands);
  static void copyToHost(VkCommandBuffer commands);
  static void buildToBuild(VkCommandBuffer commands);   // also to copies and queries of sizes
  static void buildToTrace(VkCommandBuffer commands);   // ray queries of compute shaders
  static void requestsToUse(VkCommandBuffer commands);  // between the uses of DeferredShading's requests

 private:
  std::optional<BarrierKind> omitted_;
};

}  // namespace speculum
