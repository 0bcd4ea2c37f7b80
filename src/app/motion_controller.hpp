#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <span>

#include "app/frame_cost.hpp"
#include "app/motion_levels.hpp"

namespace speculum {

// Keeps the time of a moving picture's frames near a budget by choosing a level for each. The first level has the
// settings that the user chose; each further one costs less. The controller goes down, by as many levels as needed, as
// soon as a frame is predicted to take clearly longer, and up by one level after a while in which that level would have
// fitted. It needs no device. docs/window.md describes it for users.
class MotionController {
 public:
  // Plans a frame with these settings and returns its work.
  using Planner = std::function<FrameWork(const Settings&)>;

  explicit MotionController(bool cpuDevice) : model_(cpuDevice) {}

  // Chooses the level of the next frame, `seconds` after the last, for a budget of `budgetMs` (above 0). Calls
  // `plan` a few times, last with the settings of the chosen level.
  size_t choose(std::span<const MotionLevel> levels, double budgetMs, double seconds, const Planner& plan);
  // Call when the picture stands still: the next moving frame may have any level.
  void setStill() { moving_ = false; }

  // Call with the time of each frame, moving or still, unless it did unusual work that `work` does not contain.
  void learn(const FrameWork& work, double ms) { model_.learn(work, ms); }
  double predict(const FrameWork& work) const { return model_.predict(work); }

 private:
  size_t fittingLevel(std::span<const MotionLevel> levels, size_t first, size_t planned, const FrameWork& work,
                      double ms) const;

  CostModel model_;
  size_t level_ = 0;
  bool moving_ = false;
  double patience_ = 0.0;         // seconds at a level before a better one is tried
  double sinceChange_ = 0.0;      // seconds
  bool raised_ = false;           // the last change was to a better level
  bool refused_ = false;          // since the last change, a better level was planned and did not fit
  std::deque<double> predicted_;  // milliseconds of the last frames, one update interval
};

}  // namespace speculum
