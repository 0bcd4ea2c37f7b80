#pragma once

#include <memory>
#include <string>
#include <vector>

#include "image/image.hpp"
#include "systems/environment_targets.hpp"
#include "systems/finite_watch.hpp"
#include "systems/frame_info.hpp"
#include "systems/image_pool.hpp"
#include "systems/kept_depth.hpp"
#include "systems/mask_system.hpp"
#include "systems/mirror_system.hpp"
#include "systems/point_light_system.hpp"
#include "systems/render_system.hpp"
#include "systems/texel_probe.hpp"

namespace speculum {

// What was recorded for one pass; its GPU figures follow under the same index in FrameTimings::passes.
struct RecordedPass {
  std::string name;
  std::vector<int> path;  // mirrors from the eye, indices into Scene::mirrors; empty for other passes
  int depth = -1;         // -1: the main view or the display pass
  uint32_t draws = 0;
  double areaPx = 0.0;
};

// The name of a mirror as people see it: its `name`, or its index.
std::string mirrorName(const Scene& scene, int mirror);
// The mirrors of a path from the eye, as "floor > wall".
std::string mirrorPathName(const Scene& scene, std::span<const int> path);

enum class TargetKind { color, depth };

// What a pass drew, shown over the picture in an area of the display image.
struct DebugView {
  int pass = 0;    // index into FramePlan::passes; their number stands for the main view
  PixelRect area;  // pixels
  TargetKind kind = TargetKind::color;
  double zoom = 0.0;                // pixels of the display a texel; 0: the image is fitted into the area
  glm::dvec2 origin{0.0};           // texel at the area's upper left corner; with a zoom
  double halfDistance = 1.0;        // metres from the eye that depth shows half bright
  std::optional<glm::ivec2> probe;  // texel to be read: see SceneRenderer::probed
};

// Draws one scene: mirror passes, main view, display pass. Owns the systems, the targets and the scene's resources.
class SceneRenderer {
 public:
  SceneRenderer(Renderer& renderer, const Scene& scene);
  ~SceneRenderer();
  SceneRenderer(const SceneRenderer&) = delete;
  SceneRenderer& operator=(const SceneRenderer&) = delete;

  // The images that this frame can be planned with: of the plan recorded last; none if a shader is new since then.
  std::span<const HeldImage> heldImages() const;
  std::span<const EnvironmentMap> environmentMaps() const;
  // Forgets them and every target of mirror images, so that what is drawn from now on does not depend on what was.
  void restart();

  // Records everything up to and with the display pass. `plan` was made with heldImages().
  void record(Frame& frame, const SceneState& state, const Settings& settings, const FramePlan& plan,
              const std::optional<DebugView>& debug = std::nullopt);

  // From the next frame on this picture is shown in the place of the scene's, stretched over the display image; one
  // without pixels ends that. Display sRGB.
  void setCover(const Image8& picture);

  const std::vector<RecordedPass>& passes() const { return recorded_; }
  // What debug.check_finite found in the frames that have finished.
  const FiniteWatch& finiteWatch();
  // What DebugView::probe asked for, of the last frame that asked and has finished; nothing while none asks.
  const std::optional<TexelValue>& probed() { return probe_.value(); }
  size_t pipelineCount() const;
  // What each effect took part in, of the last recorded frame.
  const EffectLedger& ledger() const { return ledger_; }
  // Linear radiance of the main view, of the last recorded frame; waits for the GPU.
  LinearImage radiance();

 private:
  struct DisplayVariant {
    ToneMap toneMap;
    bool multisampled;  // of the image that is shown
    VkFormat format;
    auto operator<=>(const DisplayVariant&) const = default;
  };
  void takeHeldImages(const FramePlan& plan);
  void keepHeldImages(const FramePlan& plan);
  void prepareTargets(const Settings& settings, const FramePlan& plan, RetireQueue& retired);
  void prepareMaps(Frame& frame, const FramePlan& plan);
  void recordMap(Frame& frame, const FrameInfo& info, size_t map, size_t firstPass);
  void recordMirrorPass(Frame& frame, const FrameInfo& info, size_t index);
  void recordMainPass(Frame& frame, const FrameInfo& info);
  bool keepsDepth(size_t pass) const { return depthPass_ == static_cast<int>(pass); }
  void releaseViews(const std::optional<DebugView>& debug, RetireQueue& retired);
  void recordDisplayPass(Frame& frame, const Settings& settings);
  void recordDebugView(Frame& frame, const Settings& settings, const FramePlan& plan, const DebugView& debug);
  void recordProbe(Frame& frame, const FramePlan& plan, const DebugView& debug);
  void recordDisplay(Frame& frame, const PassDesc& desc, const MirrorImage& radiance, const glm::vec4& lookup,
                     const Settings& settings);
  void recordFullScreen(Frame& frame, const PassDesc& desc, const Pipeline& pipeline,
                        const VkDescriptorImageInfo& image, const DisplayConstants& constants);
  void checkTarget(Frame& frame, const FrameInfo& info, OffScreen& target, VkExtent2D used);
  void releaseImages(const FramePlan& plan, const PlannedPass& pass);
  uint32_t recordSystems(const PassScope& scope, const FrameInfo& info, size_t pass, const PassFormat& format);
  const Pipeline& displayPipeline(const DisplayVariant& variant);
  void recordCover(Frame& frame);
  void finishLedger(const Settings& settings, const FramePlan& plan, const TracedEffects& effects);

  Renderer& renderer_;
  Device& device_;
  const Scene& scene_;
  SceneResources resources_;
  FrameData data_;
  TraceFrame trace_;
  MaskSystem maskSystem_;
  RenderSystem renderSystem_;
  PointLightSystem pointLightSystem_;
  MirrorSystem mirrorSystem_;
  FiniteWatch watch_;
  DescriptorSetLayoutHandle displayLayout_;
  std::map<DisplayVariant, std::unique_ptr<Pipeline>> displayPipelines_;
  std::unique_ptr<KeptDepth> watchedDepth_;
  TexelProbe probe_;
  std::unique_ptr<SharedDepth> depth_;
  std::unique_ptr<ImagePool> pool_;
  std::unique_ptr<OffScreen> main_;
  std::vector<OffScreen*> targets_;  // of the plan's passes while they are alive
  std::vector<MirrorImage> images_;  // likewise
  std::vector<HeldImage> held_;
  std::vector<OffScreen*> heldTargets_;  // of held_, taken from the pool
  std::vector<MirrorImage> heldImages_;  // of the present plan's held images
  uint64_t heldRevision_ = 0;            // of the pipelines that rendered them
  bool restart_ = false;                 // before the next frame
  EnvironmentTargets environmentTargets_;
  std::vector<VkDescriptorSet> mapSets_;  // of the present plan's maps
  SamplerHandle coverSampler_;
  Image cover_;  // empty: none
  std::vector<RecordedPass> recorded_;
  EffectLedger ledger_;
  std::optional<int> depthPass_;  // whose depth is looked at; the number of mirror passes stands for the main view
  std::optional<int> keptPass_;   // its image is not given back before the frame ends
};

}  // namespace speculum
