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
  offscreenDepthBeforeWrite,    // depth: late writes of the pass before -> clear
  offscreenToSample,            // attachment -> fragment shader
  mainBeforeWrite,              // offscreenBeforeWrite for the main view
  mainSamplesBeforeWrite,       // offscreenSamplesBeforeWrite for the main view
  mainDepthBeforeWrite,         // offscreenDepthBeforeWrite for the main view
  mainToSample,                 // offscreenToSample for the main view
  depthToSample,                // depth that the Targets panel shows: attachment -> fragment shader
  targetToCheck,                // color writes and samplings -> compute shader that checks or probes the target
  checkToLookUp,                // position of a value found by a check -> compute shader that looks the value up
  checkToWrite,                 // compute shader that checked or probed the target -> next write as attachment
  surfacesToShade,              // identifiers drawn, radiance read by earlier fragment shaders -> compute shader
  shadedToDraw,                 // radiance from compute shaders -> fragment shader; identifiers -> attachment
  swapchainBeforeWrite,         // image that was acquired, or read back before -> attachment
  swapchainBeforeOverlay,       // color writes of the pass before -> attachment that the overlay loads
  swapchainToPresent,           // attachment, or transfer destination -> presentation
  readbackToCopy,               // attachment or sampled image -> transfer source
  readbackFromCopy,             // transfer source -> attachment or sampled image
  uploadToRead,                 // transfer write -> shader, index and vertex reads
};
inline constexpr int barrierKindCount = static_cast<int>(BarrierKind::uploadToRead) + 1;

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
  // Omits the dependency of a kind from now on; nothing: omits none.
  void omit(std::optional<BarrierKind> kind) { omitted_ = kind; }

  // Records one command for several images that are used alike, of one pass or of several passes that share no image.
  // `layout` is the new layout, for kinds that set none; with VK_IMAGE_LAYOUT_UNDEFINED each image keeps its own.
  void record(VkCommandBuffer commands, BarrierKind kind, std::span<Image* const> images,
              VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED) const;
  void record(VkCommandBuffer commands, BarrierKind kind, Image& image,
              VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED) const;
  void record(VkCommandBuffer commands, BarrierKind kind, const VkDescriptorBufferInfo& buffer) const;

  // Barriers that cannot be omitted, because validation would not report them: nothing has used the image yet, the host
  // reads, or the layer 1.3.239 does not follow atomics and builds of acceleration structures.
  static void uploadToCopy(VkCommandBuffer commands, Image& fresh);
  static void acquiredToCopy(VkCommandBuffer commands, Image& acquired);  // a swapchain image -> transfer destination
  static void computeToHost(VkCommandBuffer commands);
  static void copyToHost(VkCommandBuffer commands);
  static void buildToBuild(VkCommandBuffer commands);   // a build -> next build, copy or query of sizes
  static void buildToTrace(VkCommandBuffer commands);   // a build -> ray queries of compute shaders
  static void requestsToUse(VkCommandBuffer commands);  // between two uses of DeferredShading's buffer of requests

 private:
  std::optional<BarrierKind> omitted_;
};

}  // namespace speculum
