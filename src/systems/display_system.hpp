#pragma once

#include <optional>
#include <span>

#include "image/image.hpp"
#include "systems/frame_data.hpp"
#include "systems/pass_log.hpp"
#include "systems/pipeline_variants.hpp"
#include "systems/watched_target.hpp"

namespace speculum {

// A picture as the display pass shows it.
struct DisplayedPicture {
  VkDescriptorImageInfo image{};  // linear radiance
  VkExtent2D size{0, 0};          // texels
  DisplayCurve curve;             // its exposure is a factor on the texels
  bool stretches = true;          // interpolates where the display has another size
  bool filtered = false;          // the device's samplers can interpolate it
  std::optional<glm::vec3> flat;  // all pixels have this radiance; only the first texel of the image is read
  VkRect2D area{};                // pixels of the display; the whole picture is as large as the display
};

// Returns the color of the display that shows a radiance under a curve whose exposure is a factor on it. Nothing if a
// channel is so close to a tie that the shader's rounding may differ.
std::optional<VkClearColorValue> displayColor(const glm::vec3& radiance, const DisplayCurve& curve);

// Draws into the display image: the picture with exposure, tone curve and sRGB encoding, and over it the target that a
// TargetDisplay asks for.
class DisplaySystem {
 public:
  explicit DisplaySystem(Renderer& renderer);

  // Layout of set 0: one combined image sampler.
  VkDescriptorSetLayout layout() const { return layout_; }

  // Shows `picture` instead of the scene: see SceneRenderer::setCover.
  void setCover(const Image8& picture);

  // Returns the picture of setCover() or, without one, `picture`.
  DisplayedPicture covered(const DisplayedPicture& picture) const;
  // Records the display pass. The areas of the pictures cover the display.
  RecordedPass record(Frame& frame, std::span<const DisplayedPicture> pictures);
  // Records a pass that shows a target, with `curve` if it is not a depth. Returns nothing if no part of the target
  // lies in `debug.area`.
  std::optional<RecordedPass> recordTarget(Frame& frame, const WatchedTarget::Target& target,
                                           const TargetDisplay& debug, const MirrorImage& image,
                                           const DisplayCurve& curve);
  // Records the pass that draws the mean of the target's samples, which are stored, into its color; `picture` is the
  // index in a mean of pictures. A target without samples needs none.
  std::optional<RecordedPass> recordMean(Frame& frame, OffScreen& target, int picture);
  // Drops the pipelines that only target displays need.
  void releaseView();

  void countPipelines(EffectLedger& ledger) const;

 private:
  struct Variant {
    ToneMap toneMap = ToneMap::clamp;
    bool multisampled = false;              // the image has several samples a texel
    bool enlarged = false;                  // the image has fewer texels than the display has pixels
    bool sampled = false;                   // the sampler enlarges the image
    bool shrunk = false;                    // a pixel covers more than one texel
    bool depth = false;                     // shows depth, not radiance
    bool mean = false;                      // recordMean()
    VkFormat format = VK_FORMAT_UNDEFINED;  // of the display image
    auto operator<=>(const Variant&) const = default;
  };
  // Draws with the variant, for the present display image unless it is recordMean()'s.
  void draw(const Frame& frame, const PassScope& scope, Variant variant, const VkDescriptorImageInfo& image,
            const auto& constants);

  Renderer& renderer_;
  VkDescriptorSetLayout layout_ = VK_NULL_HANDLE;
  PipelineVariants<Variant> pipelines_;
  SamplerHandle linearSampler_;
  Image cover_;  // empty: none
};

}  // namespace speculum
