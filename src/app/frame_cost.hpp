#pragma once

#include <array>

#include "frame/frame_plan.hpp"

namespace speculum {

// Amounts of work in a frame, computed from its plan before it is drawn.
struct FrameWork {
  double plainTexels = 0.0;   // written without light: by the display pass, and of shadow maps
  double passes = 0.0;        // all
  double mirrorPasses = 0.0;  // of mirrors
  double triangles = 0.0;
  double mainTexels = 0.0;
  double mirrorTexels = 0.0;
  double mapTexels = 0.0;  // of environment maps
  // Rays, about: from what is drawn to lights, and from mirrors of each kind with those that their hits send to lights.
  double lightRays = 0.0;
  double rippleRays = 0.0;
  double curvedRays = 0.0;
  double roughRays = 0.0;
  int viewSamples = 1;
  int mirrorSamples = 1;
};

FrameWork workOf(const FramePlan& plan, const Scene& scene, const SceneState& state, const Settings& settings);
// Estimates the work of a frame planned with settings `from` if it were planned with `to`, from the numbers of texels,
// samples, passes and rays alone: maps that are looked up instead of rays cost nothing, and rays that `from` lacks are
// not known.
FrameWork scaledWork(FrameWork work, const Settings& from, const Settings& to);

// Predicts milliseconds of a frame as a sum over its kinds of work, each with a price that it learns from frames: a
// Kalman filter over the factors between the prices and a guess for the kind of device. What changes the speed of the
// whole device, such as other programs, is learned as one factor, so that few frames correct the prices of work that
// they hardly had.
class CostModel {
 public:
  explicit CostModel(bool cpuDevice);

  double predict(const FrameWork& work) const;  // milliseconds
  void learn(const FrameWork& work, double ms);

 private:
  static constexpr size_t kinds = 6;
  using Vector = std::array<double, kinds>;

  Vector guess(const FrameWork& work) const;  // milliseconds of each kind

  Vector prices_;  // milliseconds for a unit of work on a usual device of the kind
  Vector factors_;
  std::array<Vector, kinds> covariance_{};  // of factors_
  int surprises_ = 0;                       // frames in a row that took longer, or (negative) less long, than expected
};

}  // namespace speculum
