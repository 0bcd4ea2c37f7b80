#pragma once

#include <array>

#include "plan/frame_plan.hpp"

namespace speculum {

// Amounts of work in a frame, computed from its plan before it is drawn.
struct FrameWork {
  double displayTexels = 0.0;  // written by the display pass; 0: there is none
  double shadowTexels = 0.0;   // written in shadow maps
  double passes = 0.0;         // all
  double mirrorPasses = 0.0;   // of mirrors
  double triangles = 0.0;
  double mainTexels = 0.0;
  double mirrorTexels = 0.0;
  double mapTexels = 0.0;  // of environment maps
  // Estimated rays: from drawn surfaces to lights, and from mirrors of each kind, with the rays from hits to lights.
  double lightRays = 0.0;
  double rippleRays = 0.0;
  double smoothRays = 0.0;
  double curvedRays = 0.0;
  double roughRays = 0.0;
  int viewSamples = 1;
  int interval = 1;            // frames in which each mirror is rendered once
  double mirrorSamples = 1.0;  // on average over the mirrors' texels
};

// Returns the work of a frame that was planned with these settings.
FrameWork workOf(const FramePlan& plan, const Scene& scene, const SceneState& state, const Settings& settings);
// Estimates the work with settings `to` of a frame that was planned with settings `from`. Scales the numbers of texels,
// samples, passes and rays alone, so maps that replace rays cost nothing, and neither do effects whose rays `from`
// lacks.
FrameWork scaledWork(FrameWork work, const Settings& from, const Settings& to);

// Predicts the milliseconds of a frame: the sum over its kinds of work of amount, typical price and factor. Typical
// prices are constants of the kind of device. A Kalman filter estimates the factors from the times of frames. The
// factors start correlated, so that a device that is slow as a whole is recognised within a few frames.
class CostModel {
 public:
  explicit CostModel(bool cpuDevice);

  double predict(const FrameWork& work) const;   // milliseconds
  void learn(const FrameWork& work, double ms);  // from a frame that took `ms`

 private:
  static constexpr size_t kinds = 6;
  using Vector = std::array<double, kinds>;

  Vector typicalMs(const FrameWork& work) const;  // of each kind, by typical prices

  Vector typicalPrices_;  // milliseconds for a unit of work
  Vector factors_;
  std::array<Vector, kinds> covariance_{};  // of factors_
  int surprises_ = 0;                       // frames in a row that took longer, or (negative) less long, than expected
};

}  // namespace speculum
