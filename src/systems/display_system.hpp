#pragma once

#include <optional>

#include "frame/debug_view.hpp"
#include "image/color.hpp"
#include "image/image.hpp"
#include "systems/effect_ledger.hpp"
#include "systems/frame_data.hpp"
#include "systems/pipeline_variants.hpp"
#include "systems/recorded_pass.hpp"
#include "systems/watched_depth.hpp"

namespace speculum {

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
  // Record a pass that shows a target of `size` texels; nothing if no part of it lies in the area.
  std::optional<RecordedPass> recordColor(Frame& frame, const glm::ivec2& size, const DebugView& debug,
                                          const MirrorImage& radiance, const Settings& settings);
  // `near`: metres from the eye to the near plane.
  std::optional<RecordedPass> recordDepth(Frame& frame, const glm::ivec2& size, const DebugView& debug,
                                          WatchedDepth& depth, double near);
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
