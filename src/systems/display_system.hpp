#pragma once

#include <optional>

#include "image/color.hpp"
#include "image/image.hpp"
#include "systems/effect_ledger.hpp"
#include "systems/frame_data.hpp"
#include "systems/pipeline_variants.hpp"
#include "systems/recorded_pass.hpp"
#include "systems/watched_depth.hpp"

namespace speculum {

enum class TargetKind { color, depth };

// A pass's target, shown over the picture in an area of the display image.
struct DebugView {
  int pass = 0;    // index into FramePlan::passes; passes.size() is the main view
  PixelRect area;  // pixels
  TargetKind kind = TargetKind::color;
  double zoom = 0.0;                // display pixels for each texel; 0 fits the image into the area
  glm::dvec2 origin{0.0};           // texel at the area's upper left corner; only if zoom > 0
  double halfDistance = 1.0;        // metres from the eye that depth shows half bright
  std::optional<glm::ivec2> probe;  // texel to read: see SceneRenderer::probed
};

// Draws into the display image: the picture with exposure, tone curve and sRGB encoding, and over it the target of a
// debug view.
class DisplaySystem {
 public:
  explicit DisplaySystem(Renderer& renderer);

  // Layout of set 0: one combined image sampler.
  VkDescriptorSetLayout layout() const { return layout_.get(); }

  // See SceneRenderer::setCover.
  void setCover(const Image8& picture);

  // Records the display pass. It shows the image of setCover(), or else `radiance`, which has `size` texels and is the
  // sum of `pictures` pictures.
  RecordedPass record(Frame& frame, const MirrorImage& radiance, VkExtent2D size, const Settings& settings,
                      int pictures);
  // Record a pass that shows the target of debug.pass; nothing if no part of it lies in the area.
  std::optional<RecordedPass> recordColor(Frame& frame, const FramePlan& plan, const DebugView& debug,
                                          const MirrorImage& radiance, const Settings& settings);
  std::optional<RecordedPass> recordDepth(Frame& frame, const FramePlan& plan, const DebugView& debug,
                                          WatchedDepth& depth);
  // Drops the pipelines that only debug views need.
  void releaseView();

  size_t pipelineCount() const { return pipelines_.size(); }
  void countPipelines(EffectLedger& ledger) const;

 private:
  struct Variant {
    ToneMap toneMap;
    bool multisampled;  // of the image that is shown
    bool enlarged;
    VkFormat format;
    auto operator<=>(const Variant&) const = default;
  };
  const Pipeline& pipelineFor(const MirrorImage& radiance, const Settings& settings, bool enlarged = false);
  RecordedPass draw(Frame& frame, const PassDesc& desc, PassKind kind, const Pipeline& pipeline,
                    const VkDescriptorImageInfo& image, const auto& constants);

  Renderer& renderer_;
  DescriptorSetLayoutHandle layout_;
  PipelineVariants<Variant> pipelines_;
  SamplerHandle coverSampler_;
  Image cover_;  // empty: none
};

}  // namespace speculum
