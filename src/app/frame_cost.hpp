#pragma once

#include <array>

#include "frame/frame_plan.hpp"

namespace speculum {

// Amounts of work in a frame, computed from its plan before it is drawn.
struct FrameWork {
  double picturePixels = 0.0;  // pixels that the display pass writes
  double passes = 0.0;
  double triangles = 0.0;
  double mainTexels = 0.0;
  double mirrorTexels = 0.0;
  int viewSamples = 1;
  int mirrorSamples = 1;
};

FrameWork workOf(const FramePlan& plan, const Scene& scene, const SceneState& state, const Settings& settings);
// Estimates the work of a frame planned with settings `from` if it were planned with `to`, from the numbers of texels
// and samples alone.
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
  static constexpr size_t kinds = 5;
  using Vector = std::array<double, kinds>;

  Vector guess(const FrameWork& work) const;  // milliseconds of each kind

  Vector prices_;  // milliseconds for a unit of work on a usual device of the kind
  Vector factors_;
  std::array<Vector, kinds> covariance_{};  // of factors_
  int surprises_ = 0;                       // frames in a row that took longer, or (negative) less long, than expected
};

}  // namespace speculum
