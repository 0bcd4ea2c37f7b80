#pragma once

#include "systems/frame_data.hpp"
#include "systems/pipeline_variants.hpp"

namespace speculum {

// Draws the mirrors of a pass: fronts look up the images that other passes rendered for them, fronts without an image
// show the background, backs show their color. An image with the pass's samples and pixels is read sample by sample;
// the base under the reflection, whose loop over the lights costs much more, is then a draw of its own with
// one invocation per pixel. Rippled and rough mirrors look up their image beside their own pixels, or are shown by
// rays. A mirror that rays show, or whose base is lit by rays, is drawn as an identifier; in the second case the image
// is added to the base after deferred shading. A cached image is read like a new one as long as nothing moved,
// otherwise it is reprojected.
class MirrorSystem {
 public:
  MirrorSystem(Device& device, Uploader& uploader, PipelineFactory& factory, VkDescriptorSetLayout frameLayout);

  // Draws the mirrors of a pass. Returns the number of draws, as recordReflections() does.
  uint32_t record(const PassScope& scope, const FrameInfo& info, const DrawList& pass);
  // Says whether record() draws identifiers in a pass.
  static bool defers(const FrameInfo& info, const DrawList& pass);
  // Adds reflections to the bases under them, after deferred shading.
  uint32_t recordReflections(const PassScope& scope, const FrameInfo& info, const DrawList& pass);
  void countPipelines(EffectLedger& ledger) const;
  // Drops pipelines that have not been used for idleFramesKept frames: those of identifiers and, unless `shadowMaps`
  // or `textured`, those that look up shadows or maps. While cached images are shown, the pipelines for `trace` stay.
  void endFrame(const TraceVariant& trace, bool shadowMaps, bool imagesShown, bool textured);

 private:
  // What a draw shades: from an image with one sample or without an image, from the mean of an image's samples, the
  // base alone, from the image's sample of the same index, or nothing, for deferred shading.
  enum class Shading { single, average, base, ownSample, identifier };
  struct Variant {
    Shading shading = Shading::single;
    bool added = false;      // only the reflection, added to a base that is there
    bool byRays = false;     // the identifier stands for base and reflection, else for the base alone
    bool perSample = false;  // looks up its image at each sample
    PassFormat format;
    bool clampDepth = true;
    bool reprojected = false;
    bool blurs = false;
    bool ripples = false;
    uint32_t shows = gpu::showsImage;
    uint32_t lookup = gpu::lookupFetch;
    bool colored = false;
    bool mapped = false;
    uint32_t lightCount = gpu::manyLights;
    TraceVariant trace;
    bool shadowed = false;        // looks shadows up in maps
    uint32_t shadowedLights = 0;  // constants of shadow_map.glsl
    uint32_t onlyShadowFace = gpu::anyShadowFace;
    auto operator<=>(const Variant&) const = default;
  };
  static bool defers(const FrameInfo& info, const MirrorRange& mirror);
  static Variant variantOf(const MirrorRange& mirror, Shading shading, bool added);
  GraphicsPipelineDesc describe(const Variant& variant, const FrameInfo& info) const;
  // Returns how a mirror is drawn if not as an identifier.
  Shading shadingOf(const PassScope& scope, const MirrorRange& mirror, const MirrorImage* image) const;
  void draw(const PassScope& scope, const FrameInfo& info, const DrawList& pass, const MirrorRange& mirror,
            Variant variant);

  Device& device_;
  VkDescriptorSetLayout frameLayout_;
  VkDescriptorSetLayout imageLayout_ = VK_NULL_HANDLE;
  SamplerHandle sampler_;
  Image noImage_;  // bound for a mirror without an image: every set that a shader names must be bound
  PipelineVariants<Variant> pipelines_;
  std::map<std::pair<VkImageView, int>, VkDescriptorSet> sets_;  // of frame `setsFrame_`, by image and reflectance map
  uint64_t setsFrame_ = 0;
};

// Keeps a pass from shading pixels that nothing reads. A mirror pass with a mask clears its depth to the nearest value,
// so that nothing passes the depth test; the mask, drawn first, opens its polygon with the farthest depth. Then it
// closes what has converged, with the nearest depth again.
class MaskSystem {
 public:
  MaskSystem(PipelineFactory& factory, VkDescriptorSetLayout frameLayout)
      : frameLayout_(frameLayout), pipelines_(factory), marking_(factory) {}

  // Value that a pass clears its depth to.
  static float clearDepth(const DrawList& pass) { return pass.maskOpens ? 1.0f : 0.0f; }
  uint32_t record(const PassScope& scope, const FrameInfo& info, const DrawList& pass);
  // Call it after all draws of the pass: makes the disparity of texels outside the mirror negative, so that lookups
  // which mix texels leave them out. Otherwise what lies behind a wall or another mirror would show along the edge
  // where it meets this one.
  uint32_t markOutside(const PassScope& scope, const FrameInfo& info, const DrawList& pass);

 private:
  VkDescriptorSetLayout frameLayout_;
  PipelineVariants<VkSampleCountFlagBits> pipelines_;
  PipelineVariants<PassFormat> marking_;
};

}  // namespace speculum
