#pragma once

#include <deque>
#include <memory>

#include "session/frame_planner.hpp"
#include "systems/scene_renderer.hpp"
#include "window/pace.hpp"

namespace speculum {

// Draws the picture or, of A | B, the picture of one half.
struct PictureHalf {
  PictureHalf(Renderer& renderer, const Scene& scene);

  // Plans a frame and uploads its textures, or leaves them out of the plan if there is no memory for them.
  const FittedPlan& plan(Frame& frame, const Pace::Request& request);
  Image8 pixels();  // of the last picture (display sRGB); waits for the GPU
  // Returns the text of the pace and what the picture approximates with the settings `chosen`, or would if the
  // animation, which `plays`, were paused.
  std::string text(const Scene& scene, const Settings& chosen, bool plays) const;

  std::unique_ptr<SceneRenderer> renderer;
  FramePlanner planner;
  Pace pace;
  uint64_t frame = 0;  // number of the last frame that drew it; 0: none yet
};

// Draws the window's picture, or the two of A | B in turn. Each frame draws only one half, so that the device's times
// are those of one set of settings.
class PictureHalves {
 public:
  PictureHalves(Renderer& renderer, const Scene& scene) : renderer_(renderer) { halves_.emplace_back(renderer, scene); }

  // Chooses the half of the next frame: both take turns. Makes what draws B, or drops it. Throws OutOfMemoryError.
  void takeTurns(bool split, const Scene& scene);
  void useScene(const Scene& scene);  // drops B

  bool split() const { return halves_.size() > 1; }
  int index() const { return drawn_; }  // of the half that is drawn in this frame, or was in the last one
  PictureHalf& drawn() { return at(drawn_); }
  const PictureHalf& drawn() const { return at(drawn_); }
  PictureHalf& at(int half) { return halves_.at(static_cast<size_t>(half)); }
  const PictureHalf& at(int half) const { return halves_.at(static_cast<size_t>(half)); }
  auto begin() { return halves_.begin(); }
  auto begin() const { return halves_.begin(); }
  auto end() { return halves_.end(); }
  auto end() const { return halves_.end(); }

  const FrameTimings& timings() const;  // of the last frame that drew this half and has finished
  uint64_t nonFinite() const;           // samples that debug.check_finite found, of all scenes
  std::string problem() const;          // what it found, or what a plan had to lower; empty: nothing

 private:
  void dropB();
  uint64_t finishedFrame(const PictureHalf& half) const;  // number of the last frame that drew it and has finished

  Renderer& renderer_;
  std::deque<PictureHalf> halves_;  // B only while there is A | B
  int drawn_ = 0;
  uint64_t nonFinite_ = 0;  // found by renderers that are gone
};

}  // namespace speculum
