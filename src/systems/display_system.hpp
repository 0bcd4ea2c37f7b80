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
  int pass = 0;    // index into FramePlan::passes; their number stands for the main view
  PixelRect area;  // pixels
  TargetKind kind = TargetKind::color;
  double zoom = 0.0;                // pixels of the display a texel; 0: the image is fitted into the area
  glm::dvec2 origin{0.0};           // texel at the area's upper left corner; with a zoom
  double halfDistance = 1.0;        // metres from the eye that depth shows half bright
  std::optional<glm::ivec2> probe;  // texel to be read: see SceneRenderer::probed
};

// Draws into the display image: the picture, through exposure, tone curve and sRGB, and over it the target of a debug
// view.
class DisplaySystem {
 public:
  explicit DisplaySystem(Renderer& renderer);

  // One combined image, in set 0.
  VkDescriptorSetLayout layout() const { return layout_.get(); }

  // See SceneRenderer::setCover.
  void setCover(const Image8& picture);

  // Records the display pass, of the overlay image or of this radiance: `size` texels, a sum of so many pictures.
  RecordedPass record(Frame& frame, const MirrorImage& radiance, VkExtent2D size, const Settings& settings,
                      int pictures);
  // Record the target of debug.pass; nothing if no part of it lies in the area.
  std::optional<RecordedPass> recordColor(Frame& frame, const FramePlan& plan, const DebugView& debug,
                                          const MirrorImage& radiance, const Settings& settings);
  std::optional<RecordedPass> recordDepth(Frame& frame, const FramePlan& plan, const DebugView& debug,
                                          WatchedDepth& depth);
  // Gives back the pipelines that only debug views needed.
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
