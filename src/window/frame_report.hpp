#pragma once

#include <deque>

#include "core/renderer.hpp"
#include "systems/pass_log.hpp"
#include "systems/scene_renderer.hpp"
#include "ui/shown.hpp"

namespace speculum {

// A frame that was recorded.
struct RecordedFrame {
  const Scene& scene;
  const SceneState& state;
  const Settings& settings;  // that the frame was planned with
  const FramePlan& plan;
  uint64_t number = 0;
  double cpuMs = 0.0;
  double sinceLastMs = 0.0;  // NaN after the window was idle
  bool lowered = false;      // the pace has lowered the quality
  bool compiles = false;     // this frame or the one before made pipelines, which takes long
  bool repeats = false;      // the frame draws the last picture again, for the panels
  Settings chosen = {};      // by the user; `settings` may be lowered
  bool panels = true;        // they are shown, so the rows of skipped mirrors are needed
};

// Collects the figures of frames for the panels.
class FrameReport {
 public:
  void clear();  // call when another scene is shown
  // `timings`: of a frame that has finished. `hoveredPath`: path of the mirror to outline; empty: none.
  void update(const RecordedFrame& frame, const FrameTimings& timings, Device& device, SceneRenderer& sceneRenderer,
              const MirrorPath& hoveredPath);
  // Describes the requested target, and returns how to draw it over the picture; nothing if the plan lacks the target's
  // pass or the request does not want the target drawn.
  std::optional<TargetDisplay> target(const TargetRequest& request, const FramePlan& plan, const Settings& settings,
                                      bool standardSampleLocations);

  // Parts of update() that need no device. `timed` are the passes of the frame that `timings` belong to, `passes` those
  // of `frame`.
  void updateTimes(const RecordedFrame& frame, const FrameTimings& timings, std::span<const RecordedPass> timed = {});
  void updatePasses(const RecordedFrame& frame, std::span<const RecordedPass> passes);
  void updateOutline(const RecordedFrame& frame, const MirrorPath& hovered);
  void updateEffects(const RecordedFrame& frame, const EffectLedger& ledger);
  void updateSkipped(const RecordedFrame& frame);

  FrameHistory& history() { return shown_.history; }
  std::span<const SkippedMirror> skipped() const { return skipped_; }  // of the last plan
  const ShownFrame& shown() const { return shown_; }

 private:
  void addFrame(const RecordedFrame& frame, const FrameTimings& timings, std::span<const RecordedPass> timed);

  // A picture, with sums over the frames that have drawn it: one, or several that draw tiles.
  struct Picture {
    bool whole = true;
    Settings settings;
    Settings chosen;
    bool lowered = false;
    bool repeats = false;
    bool compiles = false;
    uint64_t number = 0;  // of the last frame that drew it
    double sinceLastMs = 0.0;
    double cpuMs = 0.0;
    double gpuMs = 0.0;  // without the last frame
    PictureSums passes;  // without the last frame
    bool timed = true;   // the passes of all these frames were timed

    void addPasses(const FrameTimings& timings, std::span<const RecordedPass> recorded) {
      timed = timed && !timings.passes.empty();
      passes.add(recorded, timings);
    }
  };
  void setTimes(const Picture& picture, double gpuMs);

  ShownFrame shown_;
  std::deque<Picture> drawn_;  // latest pictures of the scene, newest first
  Picture picture_;            // that the last frame drew
  bool panelsOnly_ = false;    // the last frame drew no part of the scene
  // About the picture that the listed times of passes belong to:
  bool tilesTimed_ = false;  // several frames drew it
  Settings timedSettings_;
  bool timedLowered_ = false;
  Settings historySettings_;  // chosen for the frames of the history
  bool averages_ = false;     // ShownFrame::frameMs is a mean over frames that followed each other
  RecycledVector<SkippedMirror> skipped_;
  TargetKind targetKind_ = TargetKind::color;  // of ShownFrame::target
};

// Describes the renderer's device for the device panel.
ShownDevice shownDevice(const Renderer& renderer, const Device& device);

}  // namespace speculum
