#pragma once

#include <memory>
#include <string>
#include <vector>

#include "image/image.hpp"
#include "systems/display_system.hpp"
#include "systems/environment_targets.hpp"
#include "systems/finite_watch.hpp"
#include "systems/frame_info.hpp"
#include "systems/kept_depth.hpp"
#include "systems/mask_system.hpp"
#include "systems/mirror_system.hpp"
#include "systems/mirror_targets.hpp"
#include "systems/point_light_system.hpp"
#include "systems/recorded_pass.hpp"
#include "systems/render_system.hpp"
#include "systems/texel_probe.hpp"

namespace speculum {

// Draws one scene: mirror passes, main view, display pass. Owns the systems, the targets and the scene's resources.
class SceneRenderer {
 public:
  SceneRenderer(Renderer& renderer, const Scene& scene);
  ~SceneRenderer();
  SceneRenderer(const SceneRenderer&) = delete;
  SceneRenderer& operator=(const SceneRenderer&) = delete;

  // The images that this frame can be planned with: of the plan recorded last; none if a shader is new since then.
  FrameCache cache() const;
  // Forgets them and every target of mirror images, so that what is drawn from now on does not depend on what was.
  void restart();

  // What of record() takes memory for the scene's textures and materials, before anything is recorded: after an
  // OutOfMemoryError the frame can be planned again without effects.textures.
  void uploadTextures(Frame& frame, const SceneState& state, const Settings& settings, const FramePlan& plan);
  // Records everything up to and with the display pass. `plan` was made with cache().
  void record(Frame& frame, const SceneState& state, const Settings& settings, const FramePlan& plan,
              const std::optional<DebugView>& debug = std::nullopt);

  // From the next frame on this picture is shown in the place of the scene's, stretched over the display image; one
  // without pixels ends that. Display sRGB.
  void setCover(const Image8& picture) { display_.setCover(picture); }

  const std::vector<RecordedPass>& passes() const { return recorded_; }
  // What debug.check_finite found in the frames that have finished.
  const FiniteWatch& finiteWatch();
  // What DebugView::probe asked for, of the last frame that asked and has finished; nothing while none asks.
  const std::optional<TexelValue>& probed() { return probe_.value(); }
  size_t pipelineCount() const;
  // What each effect took part in, of the last recorded frame that drew the main view.
  const EffectLedger& ledger() const { return ledger_; }
  // Linear radiance of the main view, of the last recorded frame; waits for the GPU.
  LinearImage radiance();

 private:
  void prepareMain(const Settings& settings, const FramePlan& plan, RetireQueue& retired);
  void prepareMaps(Frame& frame, const FramePlan& plan);
  void recordPasses(Frame& frame, const FrameInfo& info);
  void endRecord(const Settings& settings, const FramePlan& plan, RetireQueue& retired);
  void recordMap(Frame& frame, const FrameInfo& info, size_t map, size_t firstPass);
  PassDesc mirrorPass(const FrameInfo& info, size_t index, const PassTargets& targets) const;
  void recordMirrorPasses(Frame& frame, const FrameInfo& info, const PassRange& range);
  RecordedPass recordMirrorPass(Frame& frame, const FrameInfo& info, size_t index, const PassDesc& desc);
  void recordMainPass(Frame& frame, const FrameInfo& info);
  bool keepsDepth(size_t pass) const { return depthPass_ == static_cast<int>(pass); }
  void releaseViews(const std::optional<DebugView>& debug, RetireQueue& retired);
  void recordDebugView(Frame& frame, const Settings& settings, const FramePlan& plan, const DebugView& debug);
  void recordProbe(Frame& frame, const FramePlan& plan, const DebugView& debug);
  void checkTarget(Frame& frame, const FrameInfo& info, const RecordedPass& pass, OffScreen& target, VkExtent2D used);
  uint32_t recordSystems(const PassScope& scope, const FrameInfo& info, size_t pass, const PassFormat& format);
  void finishLedger(const Settings& settings, const FramePlan& plan);

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
  DisplaySystem display_;
  std::unique_ptr<KeptDepth> watchedDepth_;
  TexelProbe probe_;
  std::unique_ptr<OffScreen> main_;
  MirrorTargets mirrorTargets_;
  uint64_t cacheRevision_ = 0;  // of the pipelines that rendered the cached images
  MainImage mainImage_;         // its content is empty if it is not to be shown again
  EnvironmentTargets environmentTargets_;
  std::vector<VkDescriptorSet> mapSets_;  // of the present plan's maps
  std::vector<RecordedPass> recorded_;
  EffectLedger ledger_;
  std::optional<int> depthPass_;  // whose depth is looked at; the number of mirror passes stands for the main view
};

}  // namespace speculum
