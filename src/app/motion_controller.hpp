#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <span>

#include "app/frame_cost.hpp"
#include "app/motion_levels.hpp"

namespace speculum {

// Keeps the frames of a moving picture within a budget: chooses for each one of several levels, the first of which has
// the settings that the user chose and each further one costs less. It goes down as soon as a frame is predicted to
// take longer, however far it takes, and up by one level after a while in which that would have fitted. Knows no
// device; see docs/window.md.
class MotionController {
 public:
  // Plans a frame with these settings and returns its work.
  using Planner = std::function<FrameWork(const Settings&)>;

  explicit MotionController(bool cpuDevice) : model_(cpuDevice) {}

  // Chooses the level of the next frame, `seconds` after the last, at most `budgetMs` (above 0) of work. `plan` is
  // called a few times, last with the settings of the level chosen.
  size_t choose(std::span<const MotionLevel> levels, double budgetMs, double seconds, const Planner& plan);
  // The picture stands still: the next frame that moves may be of any level.
  void stand() { moving_ = false; }

  // Frame `number` was drawn, at any level or standing still. Those whose time says nothing are not told.
  void drawn(uint64_t number, const FrameWork& work);
  // It took so long. Frames that are not known are ignored.
  void finished(uint64_t number, double ms);
  double predict(const FrameWork& work) const { return model_.predict(work); }

 private:
  size_t fittingLevel(std::span<const MotionLevel> levels, size_t first, size_t planned, const FrameWork& work,
                      double ms) const;

  struct Pending {
    uint64_t number = 0;
    FrameWork work;
  };

  CostModel model_;
  std::deque<Pending> pending_;  // drawn and not finished
  size_t level_ = 0;
  bool moving_ = false;
  double patience_ = 0.0;         // seconds at a level before a better one is tried
  double sinceChange_ = 0.0;      // seconds
  bool raised_ = false;           // the last change was to a better level
  std::deque<double> predicted_;  // milliseconds of the last frames, one update interval
};

}  // namespace speculum
