#pragma once

#include <optional>
#include <span>
#include <vector>

#include "plan/scene_changes.hpp"
#include "systems/finite_watch.hpp"
#include "systems/main_picture.hpp"
#include "systems/mirror_targets.hpp"
#include "systems/pass_recorder.hpp"
#include "systems/scene_targets.hpp"
#include "systems/watched_target.hpp"

namespace speculum {

class SceneRenderer;

// Says where the display shows a picture: to one side of a divider. To the other side it shows the picture that another
// renderer of the same scene drew last, or this picture too until there is one.
struct SplitDisplay {
  SceneRenderer& other;
  bool right = false;    // this picture is to the right
  uint32_t divider = 0;  // first column of pixels to the right of the divider
};

// Draws one scene: the passes of a plan, and the display pass. Owns the scene's resources and the targets, which it
// gives to the passes that PassRecorder records.
class SceneRenderer {
 public:
  SceneRenderer(Renderer& renderer, const Scene& scene);
  ~SceneRenderer();
  SceneRenderer(const SceneRenderer&) = delete;
  SceneRenderer& operator=(const SceneRenderer&) = delete;

  // Images of the last plan that the plan of the next frame, in `state`, may reuse. None after a shader reload.
  FrameCache cache(const SceneState& state);
  // Drops all cached images and their targets. The next frame renders everything.
  void restart();

  // Uploads the textures and materials that record() needs. Call it first: if it throws OutOfMemoryError, plan the
  // frame again without effects.textures.
  void uploadTextures(Frame& frame, const SceneState& state, const Settings& settings, const FramePlan& plan);
  // Records the passes of the plan and, if `shown` and the plan does not encode the main view, the display pass. `plan`
  // was made with cache(), `settings` are those of FittedPlan. With view.accumulate above 1, adds the picture to the
  // mean (see Accumulation), which is displayed. `debug` shows a target of the last complete picture, if keepsTarget().
  // The last picture of a mean can be drawn again, for another target: it is not added twice. Throws
  // std::runtime_error, before anything is made, if the plan draws more instances than the device takes.
  void record(Frame& frame, const SceneState& state, const Settings& settings, const FramePlan& plan,
              const std::optional<TargetDisplay>& debug = std::nullopt, bool shown = true,
              const std::optional<SplitDisplay>& split = std::nullopt);
  // Shows a target of the last complete picture, as record() does, in a frame that another renderer records. `plan` is
  // that of the last record(). Returns nothing if the target was not kept or no part of it is in sight.
  std::optional<RecordedPass> showTarget(Frame& frame, const FramePlan& plan, const TargetDisplay& debug);
  // Pictures in the mean that the last recorded frame shows; 0 without one. Until plan.tiles reach the end of a
  // picture, its frames show what was there before, the mean of the pictures before it or else the main view.
  int accumulated() const { return main_.mean().pictures(); }

  // Says whether the last frame kept that target of the last complete picture, for TargetDisplay.
  bool keepsTarget(const MirrorPath& path, TargetKind kind) const { return watched_.keeps(path, kind); }

  // Says whether the last picture was drawn in FramePlan::refined only, shows nothing, or was encoded, so that its
  // targets have gaps.
  bool hasGaps() const { return main_.hasGaps(); }

  // Shows `picture` (display sRGB) instead of the scene, stretched to the display, from the next frame on. A picture
  // without pixels shows the scene again.
  void setCover(const Image8& picture) { display_.setCover(picture); }

  // Passes of the picture that the last frame drew, or continued to draw, in order.
  const std::vector<RecordedPass>& passes() const { return log_.passes(); }
  // Passes of frame number `frame`, if it is one of the last three recorded. The GPU's timings arrive that late.
  std::span<const RecordedPass> passesOf(uint64_t frame) const { return log_.passesOf(frame); }
  // Findings of debug.check_finite in the frames that have finished.
  const FiniteWatch& finiteWatch();
  // Value at TargetDisplay::probe in the last frame that had a probe and has finished.
  std::optional<TexelValue> probed();
  // Cost of each effect in the last recorded frame that drew the main view.
  const EffectLedger& ledger() const { return ledger_; }
  // Linear radiance of the main view, or of the mean, in the last recorded frame, enlarged to the picture. Waits for
  // the GPU. Throws std::logic_error if the picture was encoded, because there is no radiance then.
  LinearImage radiance() { return main_.radiance(); }

 private:
  void releaseUnused(const std::optional<TargetDisplay>& debug);
  void prepareTargets(Frame& frame, const Settings& settings, const FramePlan& plan, bool shown);
  FrameInfo infoOf(Frame& frame, const SceneState& state, const Settings& settings, const FramePlan& plan);
  void beginPicture(const FrameInfo& info);
  // Records the passes of the plan. The functions below record one pass, by its index in the plan, or a range.
  void recordPasses(const FrameInfo& info);
  void recordEnvironment(const FrameInfo& info, size_t index);
  void recordMirrors(const FrameInfo& info, const ConcurrentPasses& range);
  void recordMain(const FrameInfo& info, size_t index);
  void endPicture(const FrameInfo& info);
  void recordDisplay(const FrameInfo& info, const std::optional<TargetDisplay>& debug,
                     const std::optional<SplitDisplay>& split);
  void keepImages(const FrameInfo& info);
  // Returns the image of the watched pass in the last complete picture; null if there is none.
  OffScreen* watchedImage(const FramePlan& plan, int pass);

  Renderer& renderer_;
  Device& device_;
  const Scene& scene_;
  SceneResources resources_;
  FrameData data_;
  TraceFrame trace_;
  PassRecorder recorder_;
  FiniteWatch watch_;
  DisplaySystem display_;
  WatchedTarget watched_;
  TexelProbe probe_;
  MainPicture main_;
  MirrorTargets mirrorTargets_;
  EnvironmentTargets environmentTargets_;
  std::vector<PassTargets> passTargets_;  // of the mirror passes drawn last; their next tiles may follow
  SceneChanges changes_;
  uint64_t cacheRevision_ = 0;  // of the pipelines that rendered the cached images
  RecycledVector<Cube> cubes_;  // that the next plan may reuse; none before all faces of a picture are drawn
  PassLog log_;
  EffectLedger ledger_;
  IdleGuard idle_;
};

}  // namespace speculum
