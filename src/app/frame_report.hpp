#pragma once

#include <deque>

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

  FrameHistory& history() { return view_.history; }
  std::span<const SkippedMirror> skipped() const { return skipped_; }  // in the last frame
  const FrameView& view() const { return view_; }

 private:
  bool drewPicture(uint64_t frame) const;  // the whole of one, among the latest frames
  void updateEffects(const RecordedFrame& frame, const EffectLedger& ledger);
  void updateSkipped(const RecordedFrame& frame);
  void addTiles(const RecordedFrame& frame, const FrameTimings& timings, std::span<const RecordedPass> timed);

  struct TimedPass : RecordedPass {
    double gpuMs = 0.0;
  };
  // Frames so far that drew a picture: one, or several that drew tiles of it.
  struct Tiles {
    uint64_t number = 0;  // of the last one
    double sinceLastMs = 0.0;
    double cpuMs = 0.0;
    double gpuMs = 0.0;             // without the last one
    std::vector<TimedPass> passes;  // likewise
    bool timed = true;              // those are complete
  };
  struct DrawnFrame {
    Tiles tiles;
    bool whole = true;  // one frame drew the picture
  };
  static void addPasses(const FrameTimings& timings, std::span<const RecordedPass> timed, Tiles& tiles);

  FrameView view_;
  std::deque<DrawnFrame> drawn_;  // that drew the scene and not the panels only, the latest
  Tiles tiles_;
  bool tilesTimed_ = false;  // times of passes are of a picture that several frames drew
  bool averages_ = false;    // FrameView::frameMs: its frames followed each other
  std::vector<SkippedMirror> skipped_;
};

}  // namespace speculum
