#include "window/motion_controller.hpp"

#include <algorithm>
#include <utility>

namespace speculum {

namespace {

// Shares of the budget. Between roomToRaise and tooMuch the level stays, so that it does not change all the time.
constexpr double aim = 0.98;          // largest share that a level may take when it is lowered
constexpr double roomToRaise = 0.96;  // largest share that a better level may take
constexpr double tooMuch = 1.06;      // a frame beyond this share lowers the level
constexpr double farBelow = 0.85;     // a better level predicted to take less is tried at once

constexpr double leastPatience = 0.15;  // seconds
constexpr double mostPatience = 1.5;
constexpr double settled = 1.0;      // seconds at a better level after which raising it was no mistake
constexpr int mostPredictions = 60;  // frames

}  // namespace

// Returns the first level from `first` on that is predicted to take no more than the share `aim` of the budget, else
// the last level. Estimates the levels' work from `work`, which was planned at level_.
size_t MotionController::fittingLevel(std::span<const MotionLevel> levels, size_t first, const FrameWork& work) const {
  const auto fits = [&](const MotionLevel& level) {
    return model_.predict(scaledWork(work, levels[level_].settings, level.settings)) <= aim * budgetMs_;
  };
  const auto found = std::find_if(levels.begin() + static_cast<std::ptrdiff_t>(first), levels.end(), fits);
  return std::min(static_cast<size_t>(found - levels.begin()), levels.size() - 1);
}

std::optional<size_t> MotionController::tryLevel(Try why, size_t level) {
  try_ = why;
  return level_ = level;
}

size_t MotionController::begin(std::span<const MotionLevel> levels, double budgetMs, double seconds) {
  budgetMs_ = budgetMs;
  before_ = std::min(level_, levels.size() - 1);
  begins_ = !std::exchange(moving_, true);
  if (begins_) {
    predicted_.clear();
    patience_ = leastPatience;
    sinceChange_ = 0.0;
    raised_ = refused_ = false;
  }
  sinceChange_ += seconds;
  return *tryLevel(begins_ ? Try::afterStanding : Try::current, before_);
}

std::optional<size_t> MotionController::next(std::span<const MotionLevel> levels, const FrameWork& work) {
  std::optional<size_t> another;
  if (try_ == Try::afterStanding) {
    const size_t fitting = fittingLevel(levels, 0, work);
    another = fitting < level_ ? tryLevel(Try::current, fitting) : nextFromCurrent(levels, work);
  } else if (try_ == Try::current) {
    another = nextFromCurrent(levels, work);
  } else if (try_ == Try::lower) {
    another = lower(levels, work);
  } else if (try_ == Try::higher && model_.predict(work) > roomToRaise * budgetMs_) {
    refused_ = true;
    sinceChange_ = 0.0;
    another = tryLevel(Try::back, before_);
  }
  if (!another) {
    choose();
  }
  return another;
}

std::optional<size_t> MotionController::nextFromCurrent(std::span<const MotionLevel> levels, const FrameWork& work) {
  const Settings& settings = levels[level_].settings;
  const int interval =
      std::max({work.interval, settings.reflection.updateInterval, settings.effects.environmentInterval});
  predicted_.push_back(model_.predict(work));
  while (predicted_.size() > static_cast<size_t>(std::min(interval, mostPredictions))) {
    predicted_.pop_front();
  }
  if (predicted_.back() > tooMuch * budgetMs_) {
    return lower(levels, work);
  }
  if (begins_ || level_ == 0 || std::ranges::max(predicted_) > roomToRaise * budgetMs_) {
    return std::nullopt;
  }
  const double promised = model_.predict(scaledWork(work, settings, levels[level_ - 1].settings));
  const bool waited = sinceChange_ >= patience_ || (promised <= farBelow * budgetMs_ && !refused_);
  return waited && promised <= roomToRaise * budgetMs_ ? tryLevel(Try::higher, level_ - 1) : std::nullopt;
}

std::optional<size_t> MotionController::lower(std::span<const MotionLevel> levels, const FrameWork& work) {
  const bool fits = model_.predict(work) <= tooMuch * budgetMs_ || level_ + 1 == levels.size();
  return fits ? std::nullopt : tryLevel(Try::lower, fittingLevel(levels, level_ + 1, work));
}

// Takes the level that was planned last.
void MotionController::choose() {
  if (level_ == before_) {
    return;
  }
  if (level_ > before_) {
    const bool mistake = raised_ && sinceChange_ < settled;
    patience_ = mistake ? std::min(2.0 * patience_, mostPatience) : leastPatience;
  }
  raised_ = level_ < before_ && !begins_;
  refused_ = false;
  sinceChange_ = 0.0;
  predicted_.clear();
}

}  // namespace speculum
