#include "app/pace.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "frame/picture_offset.hpp"
#include "frame/picture_tiles.hpp"

namespace speculum {

namespace {

constexpr double cpuBudgetMs = 50.0;
constexpr double refreshShare = 0.8;
constexpr double longestWait = 3.0;  // budgets: slower still pictures come after a draft, tile by tile
constexpr double tilesShare = 2.0;   // budgets for a frame with tiles and without input
constexpr double leastShare = 0.1;   // of such a frame's time is its tiles'
constexpr size_t mostDrawn = 4;      // frames whose times have not arrived
constexpr size_t sentFrames = 8;     // frames of which one does not wait for the monitor
constexpr int framesToKnow = 5;      // timed moving frames after which it is known what playing costs
constexpr double leastMoved = 0.5;   // of the resolution, at which a scene is worth moving unasked

Settings withPictures(Settings settings, int pictures) {
  settings.view.accumulate = pictures;
  return settings;
}

// Says whether tiles can draw the picture; debug.check_finite looks at whole ones.
bool drawnInTiles(const FittedPlan& fitted) {
  return !fitted.plan.mainReused() && !fitted.settings.debug.checkFinite;
}

}  // namespace

void Pace::begin(const CameraPose& camera, bool otherwise, double seconds) {
  movement_.update(camera, otherwise, seconds);
  seconds_ = seconds;
  begun_ = Clock::now();
  if (!drawn_.empty() && drawn_.back().frameMs == 0.0) {
    drawn_.back().frameMs = std::chrono::duration<double, std::milli>(begun_ - drawn_.back().begun).count();
  }
}

const FittedPlan& Pace::plan(const Request& request) {
  fitted_.plan.tiles.reset();
  lowers_ = repeats_ = false;
  if (moving() && request.budgetMs > 0.0) {
    planMoving(request);
  } else {
    controller_.setStill();
    planStill(request);
  }
  return fitted_;
}

// Plans a picture, or number `picture` of a mean, with these settings.
void Pace::planWith(const Request& request, const Settings& settings, int picture) {
  FrameRequest frame = request.frame;
  frame.settings = settings;
  frame.picture = picture;
  fitted_ = request.planner.plan(frame);
  work_ = workOf(fitted_.plan, frame.scene, frame.state, fitted_.settings);
}

// Plans the frame within the budget. The text says what the picture gives up for that.
void Pace::planWithinBudget(const Request& request) {
  const Settings chosen = withPictures(request.frame.settings, 1);
  const std::vector<MotionLevel> levels = motionLevels(request.frame.scene, chosen, request.front, sampleCounts_);
  const size_t level = controller_.choose(levels, request.budgetMs, seconds_, [&](const Settings& settings) {
    planWith(request, settings, 0);
    return work_;
  });
  lowers_ = level > 0;
  if (learned_ >= framesToKnow) {
    findPlayCost(levels, request);
  }
  MotionLevel shown = levels[level];
  // A limit that leaves no image out costs no quality. Images below the chosen limit count too.
  const auto skips = [&](SkipReason reason) {
    return std::ranges::count(fitted_.plan.skipped, reason, &SkippedMirror::reason) > 0;
  };
  if (!skips(SkipReason::maxPasses)) {
    shown.settings.reflection.maxPasses = chosen.reflection.maxPasses;
  }
  if (!skips(SkipReason::minPixels)) {
    shown.settings.reflection.minPixels = chosen.reflection.minPixels;
  }
  text_ = motionText(chosen, shown);
}

// Looks for the best level that should fit: the controller rises to it by and by.
void Pace::findPlayCost(std::span<const MotionLevel> levels, const Request& request) {
  double ms = 0.0;
  const auto fits = [&](const MotionLevel& level) {
    ms = controller_.predict(scaledWork(work_, fitted_.settings, level.settings));
    return ms <= request.budgetMs;
  };
  const auto best = std::min(std::ranges::find_if(levels, fits), levels.end() - 1);
  const double scale = best->settings.view.scale / request.frame.settings.view.scale;
  playCost_ = scale >= leastMoved
                  ? ""
                  : fmt::format("Play (about {:.2g} frames/s at {:.2g} of the resolution)", 1000.0 / ms, scale);
}

void Pace::planMoving(const Request& request) {
  shown_.reset();
  planWithinBudget(request);
  text_ = "Moving: " + text_;
}

void Pace::planStill(const Request& request) {
  pictures_ = moving() ? 1 : stillPictures(request.frame.settings);
  // The mean begins anew when nothing moves any more, even if nothing else has changed.
  const auto shown = moving() ? std::nullopt : std::optional(std::pair(request.frame.settings, request.shown));
  if (std::exchange(shown_, shown) != shown || moving()) {
    picture_ = -1;
    target_.reset();
    redraws_ = false;
    slow_.reset();
    draft_.clear();
  }
  const bool divides = request.budgetMs > 0.0;
  if (!divides) {
    slow_.reset();
  }
  text_.clear();
  planTarget(request);
  if (moving() || (pictures_ == 1 && !divides)) {
    picture_ = pictures_;
    planWith(request, withPictures(request.frame.settings, 1), 0);
  } else if (picture_ >= 0 || !planFirst(request)) {
    planPicture(request);
  }
}

// Draws the last picture of a complete mean again for a target that was not kept, once: the mean itself stays. A single
// picture is drawn again anyway if the plan cannot reuse it.
void Pace::planTarget(const Request& request) {
  redraws_ = redraws_ && picture_ != pictures_;
  repeats_ = picture_ == pictures_ || redraws_;
  if (!request.target) {
    target_.reset();
  } else if (picture_ == pictures_ && pictures_ > 1 && target_ != request.target) {
    target_ = request.target;
    redraws_ = true;
    --picture_;
  }
}

// Plans the first frame in full quality if that is fast, else a draft. Returns false if the first picture of the mean
// is fast enough to come at once. A slow frame would delay the mean, whose pictures have one sample; a single picture
// is drawn in tiles only if it would hold up input for long.
bool Pace::planFirst(const Request& request) {
  const bool single = pictures_ == 1;
  const Settings settings = withPictures(request.frame.settings, 1);
  planWith(request, settings, 0);
  const double most = (single ? longestWait : 1.0) * request.budgetMs;
  const bool whole = request.budgetMs <= 0.0 || controller_.predict(work_) <= most;
  picture_ = whole && single ? 1 : 0;
  if (whole) {
    text_ = single ? "" : meanText();
    return true;
  }
  const FrameWork work = scaledWork(work_, settings, pictureSettings(withPictures(request.frame.settings, pictures_)));
  if (controller_.predict(work) <= longestWait * request.budgetMs) {
    return false;
  }
  slow_.emplace();
  planWithinBudget(request);
  draft_ = text_ = "Draft: " + text_;
  return true;
}

// Plans the next picture of the mean or, if it is slow, its next tiles.
void Pace::planPicture(const Request& request) {
  if (!slow_ && picture_ > 0 && request.budgetMs > 0.0) {
    slow_.emplace();
  }
  if (!slow_ || slow_->finished()) {
    planWith(request, withPictures(request.frame.settings, pictures_), pictures_ == 1 ? 0 : picture_);
    const double ms = controller_.predict(work_);
    if (slow_ && ms > longestWait * request.budgetMs && drawnInTiles(fitted_)) {
      const size_t faces = faceCount(fitted_.plan);
      slow_->begin(faces, tileCount(fitted_.plan) - faces, ms);
      slowWork_ = work_;
    }
  }
  if (slow_ && !slow_->finished()) {
    planTiles(request);
    if (!slow_->finished()) {
      text_ = tilesText();
      return;
    }
  }
  picture_ = std::min(picture_ + 1, pictures_);
  if (pictures_ > 1) {
    text_ = meanText();
  }
}

void Pace::planTiles(const Request& request) {
  const double pixels = static_cast<double>(request.shown.size.x) * request.shown.size.y;
  besidesMs_ = cpuMs_ + controller_.predict({.plainTexels = pixels});
  const double most = (request.input ? 1.0 : tilesShare) * request.budgetMs;
  // At least half of the time goes to the tiles, whatever the rest of a frame takes.
  fitted_.plan.tiles = slow_->next(std::max(most - besidesMs_, besidesMs_));
}

std::string Pace::tilesText() const {
  const double share = slow_->share();
  if (picture_ == 0 && !draft_.empty()) {
    return fmt::format("{}; first picture {:.0f} %", draft_, std::floor(100.0 * share));
  }
  if (pictures_ == 1) {
    return fmt::format("Picture {:.0f} %", std::floor(100.0 * share));
  }
  return fmt::format("{}, next one {:.0f} %", meanText(), std::floor(100.0 * share));
}

std::string Pace::meanText() const {
  return fmt::format("{} of {} pictures averaged", picture_, pictures_);
}

void Pace::drawn(uint64_t number, double cpuMs, double waitedMs, bool usual) {
  cpuMs_ = cpuMs;
  drawn_.push_back({.number = number,
                    .cpuMs = cpuMs,
                    .waitedMs = waitedMs,
                    .begun = begun_,
                    .work = usual ? std::optional(work_) : std::nullopt});
  if (drawn_.size() > mostDrawn) {
    drawn_.pop_front();
  }
}

// Learns the time of a frame. On a CPU device, drawing, the program and sending the picture to the window system share
// the cores, so a frame takes the sum of their times, or less where they overlap; on a GPU it takes the longer of the
// first two, unless the program waits for tiles or parts. Waiting for the monitor does not count.
void Pace::finished(const FrameTimings& timings) {
  const auto found = std::ranges::find(drawn_, timings.frame, &Drawn::number);
  if (found == drawn_.end()) {
    return;
  }
  sendMs_.push_back(std::max(found->presentMs + found->waitedMs - timings.gpuMs, 0.0));
  if (sendMs_.size() > sentFrames) {
    sendMs_.pop_front();
  }
  const double sum = found->cpuMs + timings.gpuMs + (cpuDevice_ ? std::ranges::min(sendMs_) : 0.0);
  const bool overlaps = !cpuDevice_ && !drawsTiles() && found->waitedMs == 0.0;
  const double ms = overlaps              ? std::max(found->cpuMs, timings.gpuMs)
                    : found->frameMs == 0 ? sum
                                          : std::min(found->frameMs, sum);
  if (drawsTiles() && found + 1 == drawn_.end()) {
    slow_->took(std::max(ms - besidesMs_, leastShare * ms));
    // The frames took longer than one would have, so their time is learned only where even that was less.
    if (slow_->finished() && slow_->totalMs() < controller_.predict(slowWork_)) {
      controller_.learn(slowWork_, slow_->totalMs());
    }
  } else if (found->work && timings.passes.empty()) {
    controller_.learn(*found->work, ms);
    learned_ += moving();
  }
  drawn_.erase(drawn_.begin(), found + 1);
}

int stillPictures(const Settings& settings) {
  return std::max(settings.view.accumulate, settings.quality.stillPictures);
}

double motionBudget(const Settings& settings, bool cpuDevice, double refreshHz) {
  return settings.quality.motionMs.value_or(cpuDevice ? cpuBudgetMs : refreshShare * 1000.0 / refreshHz);
}

}  // namespace speculum
