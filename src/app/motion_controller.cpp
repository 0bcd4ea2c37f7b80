#include "app/motion_controller.hpp"

#include <algorithm>
#include <utility>

namespace speculum {

namespace {

// Shares of the budget. Between roomToRaise and tooMuch the level stays, so that it does not change all the time.
constexpr double aim = 0.98;          // largest share that a level may take when it is lowered
constexpr double roomToRaise = 0.96;  // largest share that a better level may take
constexpr double tooMuch = 1.06;      // a frame beyond it lowers the level
constexpr double farBelow = 0.85;     // a better level predicted to take less is tried at once

constexpr double leastPatience = 0.15;  // seconds
constexpr double mostPatience = 1.5;
constexpr double settled = 1.0;      // seconds at a better level after which raising it was no mistake
constexpr int longestInterval = 60;  // frames

}  // namespace

// Returns the first level from `first` on that is predicted to take at most `ms`, else the last level. Estimates the
// levels' work from `work`, which was planned at level `planned`.
size_t MotionController::fittingLevel(std::span<const MotionLevel> levels, size_t first, size_t planned,
                                      const FrameWork& work, double ms) const {
  const auto fits = [&](const MotionLevel& level) {
    return model_.predict(scaledWork(work, levels[planned].settings, level.settings)) <= ms;
  };
  const auto found = std::find_if(levels.begin() + static_cast<std::ptrdiff_t>(first), levels.end(), fits);
  return std::min(static_cast<size_t>(found - levels.begin()), levels.size() - 1);
}

size_t MotionController::choose(std::span<const MotionLevel> levels, double budgetMs, double seconds,
                                const Planner& plan) {
  level_ = std::min(level_, levels.size() - 1);
  const bool begins = !std::exchange(moving_, true);
  FrameWork work = plan(levels[level_].settings);
  const size_t before = level_;
  if (begins) {
    predicted_.clear();
    patience_ = leastPatience;
    sinceChange_ = 0.0;
    raised_ = refused_ = false;
    const size_t fitting = fittingLevel(levels, 0, level_, work, aim * budgetMs);
    if (fitting < level_) {
      level_ = fitting;
      work = plan(levels[level_].settings);
    }
  }
  sinceChange_ += seconds;
  const Settings& settings = levels[level_].settings;
  const int interval =
      std::max({work.interval, settings.reflection.updateInterval, settings.effects.environmentInterval});
  predicted_.push_back(model_.predict(work));
  while (predicted_.size() > static_cast<size_t>(std::min(interval, longestInterval))) {
    predicted_.pop_front();
  }
  const double longest = std::ranges::max(predicted_);
  const auto planAt = [&](size_t level) {
    level_ = level;
    work = plan(levels[level].settings);
    return model_.predict(work);
  };
  if (model_.predict(work) > tooMuch * budgetMs) {
    double ms = tooMuch * budgetMs + 1.0;
    while (level_ + 1 < levels.size() && ms > tooMuch * budgetMs) {
      ms = planAt(fittingLevel(levels, level_ + 1, level_, work, aim * budgetMs));
    }
  } else if (!begins && level_ > 0 && longest <= roomToRaise * budgetMs) {
    const MotionLevel& better = levels[level_ - 1];
    const double promised = model_.predict(scaledWork(work, levels[level_].settings, better.settings));
    const bool waited = sinceChange_ >= patience_ || (promised <= farBelow * budgetMs && !refused_);
    if (waited && promised <= roomToRaise * budgetMs && planAt(level_ - 1) > roomToRaise * budgetMs) {
      planAt(before);
      refused_ = true;
      sinceChange_ = 0.0;
    }
  }
  if (level_ != before) {
    if (level_ > before) {
      const bool mistake = raised_ && sinceChange_ < settled;
      patience_ = mistake ? std::min(2.0 * patience_, mostPatience) : leastPatience;
    }
    raised_ = level_ < before && !begins;
    refused_ = false;
    sinceChange_ = 0.0;
    predicted_.clear();
  }
  return level_;
}

}  // namespace speculum
