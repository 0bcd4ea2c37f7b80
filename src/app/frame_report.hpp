#pragma once

#include <deque>

#include "app/pass_sums.hpp"
#include "systems/scene_renderer.hpp"
#include "ui/views.hpp"

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
};

// Collects the figures of frames for the panels.
class FrameReport {
 public:
  void clear();  // call when another scene is shown
  // `hoveredPath`: path of the mirror to outline; empty: none. The GPU's figures are those of the last frame that has
  // finished.
  void update(const RecordedFrame& frame, Renderer& renderer, SceneRenderer& sceneRenderer,
              const std::vector<int>& hoveredPath);
  // Describes the requested target, and returns how to draw it over the picture; nothing if the plan lacks its pass or
  // the target has no area.
  std::optional<DebugView> target(const TargetRequest& request, const FramePlan& plan, const Settings& settings,
                                  bool standardSampleLocations);

  // Parts of update() that need no device. `passes` belong to this frame, `timed` to the frame that was timed.
  void updateTimes(const RecordedFrame& frame, const FrameTimings& timings, std::span<const RecordedPass> timed = {});
  void updatePasses(const RecordedFrame& frame, const FrameTimings& timings, std::span<const RecordedPass> passes,
                    std::span<const RecordedPass> timed);
  void updateOutline(const RecordedFrame& frame, const std::vector<int>& hovered);
  void updateEffects(const RecordedFrame& frame, const EffectLedger& ledger);
  void updateSkipped(const RecordedFrame& frame);

  FrameHistory& history() { return view_.history; }
  std::span<const SkippedMirror> skipped() const { return skipped_; }  // in the last frame
  const FrameView& view() const { return view_; }

 private:
  bool drewPicture(uint64_t frame) const;  // the whole of one, among the latest frames
  void addFrame(const RecordedFrame& frame, const FrameTimings& timings, std::span<const RecordedPass> timed);

  // Frames so far that drew a picture: the whole of it, or tiles.
  struct Picture {
    bool whole = true;
    uint64_t number = 0;  // of the last one
    double sinceLastMs = 0.0;
    double cpuMs = 0.0;
    double gpuMs = 0.0;  // without the last one
    PassSums passes;     // likewise
    bool timed = true;   // those are complete

    void addPasses(const FrameTimings& timings, std::span<const RecordedPass> recorded) {
      timed = timed && !timings.passes.empty();
      passes.add(recorded, timings);
    }
  };

  FrameView view_;
  std::deque<Picture> drawn_;  // of the scene, not the panels only; the latest
  Picture picture_;            // that the last frame drew
  bool tilesTimed_ = false;    // times of passes are of a picture that several frames drew
  bool averages_ = false;      // FrameView::frameMs: its frames followed each other
  std::vector<SkippedMirror> skipped_;
};

}  // namespace speculum
