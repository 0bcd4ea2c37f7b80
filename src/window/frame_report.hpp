#pragma once

#include <deque>

#include "session/picture_sums.hpp"
#include "systems/scene_renderer.hpp"
#include "ui/shown.hpp"

namespace speculum {

// A frame that was recorded.
struct RecordedFrame {
  const Scene& scene;
  const SceneState& state;
  const Settings& settings;  // with which it was planned
  const FramePlan& plan;
  uint64_t number = 0;
  double cpuMs = 0.0;
  double sinceLastMs = 0.0;  // NaN after the window was idle
  bool lowered = false;      // its quality, for the pace
  bool compiles = false;     // it or the frame before made pipelines, which takes long
  bool repeats = false;      // it draws the last picture again, for the panels
  Settings chosen = {};      // by the user; `settings` may be lowered
};

// Collects the figures of frames for the panels.
class FrameReport {
 public:
  void clear();  // call when another scene is shown
  // `hoveredPath`: path of the mirror to outline; empty: none. The GPU's figures are those of the last frame that has
  // finished.
  void update(const RecordedFrame& frame, Renderer& renderer, SceneRenderer& sceneRenderer,
              const MirrorPath& hoveredPath);
  // Describes the requested target, and returns how to draw it over the picture; nothing if the plan lacks its pass or
  // the target has no area.
  std::optional<TargetDisplay> target(const TargetRequest& request, const FramePlan& plan, const Settings& settings,
                                      bool standardSampleLocations);

  // Parts of update() that need no device. `timed` are the passes of the frame that `timings` belong to, `passes` of
  // this frame.
  void updateTimes(const RecordedFrame& frame, const FrameTimings& timings, std::span<const RecordedPass> timed = {});
  void updatePasses(const RecordedFrame& frame, std::span<const RecordedPass> passes);
  void updateOutline(const RecordedFrame& frame, const MirrorPath& hovered);
  void updateEffects(const RecordedFrame& frame, const EffectLedger& ledger);
  void updateSkipped(const RecordedFrame& frame);

  FrameHistory& history() { return shown_.history; }
  std::span<const SkippedMirror> skipped() const { return skipped_; }  // in the last frame
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
    uint64_t number = 0;  // of the last frame
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
  // The picture that the times of passes are of.
  bool tilesTimed_ = false;  // several frames drew it
  Settings timedSettings_;
  bool timedLowered_ = false;
  Settings historySettings_;  // chosen for the frames of the history
  bool averages_ = false;     // ShownFrame::frameMs: its frames followed each other
  RecycledVector<SkippedMirror> skipped_;
  TargetKind targetKind_ = TargetKind::color;  // of ShownFrame::target
};

}  // namespace speculum
