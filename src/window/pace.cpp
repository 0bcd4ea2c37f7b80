#include "window/pace.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "plan/pass_mask.hpp"
#include "plan/refined_tiles.hpp"

namespace speculum {

namespace {

// After a change panels need a frame to show it, another to settle, and two more because the figures in them are two
// frames old.
constexpr int framesAfterChange = 4;
constexpr int longestInterval = 3600;  // frames: a map with a longer interval is meant to stay as it is

// Returns the number of frames in which every cached image is rendered anew.
int framesUntilFresh(const Settings& settings) {
  const EffectSettings& effects = settings.effects;
  const bool maps = effects.curved && effects.curvedLookup == CurvedLookup::environment;
  return std::max(settings.reflection.updateInterval,
                  maps ? std::min(effects.environmentInterval, longestInterval) : 0);
}

constexpr double cpuBudgetMs = 50.0;
constexpr double refreshShare = 0.8;
constexpr double longestWait = 3.0;       // budgets: slower still pictures come after a draft, tile by tile
constexpr double tilesShare = 2.0;        // budgets for a frame with tiles and without input
constexpr double untouchedWait = 6.0;     // budgets instead of these two for a view that nobody touches
constexpr double untouchedSeconds = 0.5;  // without input, after which nobody does
constexpr double coveredWait = 20.0;      // budgets for a draft that is waited for
constexpr int framesToAnswer = 2;         // that show the first input after that: a new panel is laid out in the first
constexpr double leastShare = 0.1;  // least share of the time of a frame with tiles that counts as time of its tiles
// Passes that each frame has, however few tiles it draws.
constexpr std::array<std::string_view, 3> besideTiles = {"display", "debug view", "overlay"};
constexpr size_t mostDrawn = 4;     // frames whose times have not arrived
constexpr size_t sentFrames = 8;    // at least one of so many frames does not wait for the monitor
constexpr int framesToKnow = 5;     // timed moving frames after which it is known what playing costs
constexpr double leastMoved = 0.5;  // least share of the resolution at which a scene is worth moving unasked
constexpr double caution = 4.0;     // a tile that was never drawn may take so many times as long as expected
// Share of the dearest tile's time that still counts a frame later. One frame may be slow for another reason, such as
// another program that takes the processor.
constexpr double remembered = 0.9;
// Frames of a slow picture, besides those of its maps, on a busy machine, where a frame takes long whatever it draws.
constexpr size_t mostFrames = 128;
// Frames of a slow picture after which more tiles are tried again: one measurement may be wrong where others take the
// processor.
constexpr int framesToAskAgain = 8;

// Says whether tiles can draw the picture. debug.check_finite needs whole pictures.
bool drawnInTiles(const FittedPlan& fitted) {
  return !fitted.plan.mainReused() && !fitted.settings.debug.checkFinite;
}

}  // namespace

void FramePacer::change(std::span<const Settings> halves) {
  int fresh = 0;
  for (const Settings& settings : halves) {
    fresh = std::max(fresh, framesUntilFresh(settings));
  }
  due_ = static_cast<int>(halves.size()) * (framesAfterChange + fresh);
}

double FramePacer::beginFrame(double seconds) {
  return std::exchange(idled_, false) ? std::numeric_limits<double>::quiet_NaN() : 1000.0 * seconds;
}

std::string FirstPictures::text(bool preview, const std::optional<double>& share) const {
  const bool tries = triesLeft_ > 0 && content_;  // the first frame compiles
  return (preview ? "Preview. " : "") +
         (share   ? fmt::format("Drawing the first picture: {:.0f} %", std::floor(100.0 * *share))
          : tries ? "Measuring how fast the scene plays"
                  : "Compiling shaders for the first picture");
}

void SlowPicture::begin(size_t faces, size_t count, double ms) {
  tiles_ = {};
  faces_ = faces;
  faceMs_ = std::numeric_limits<double>::infinity();
  pays_ = true;
  lastCount_ = 0;
  framesAlike_ = 0;
  totalMs_ = 0.0;
  const std::vector<double> before = std::exchange(tileMs_, std::vector<double>(count));
  if (before.empty()) {
    std::ranges::fill(tileMs_, caution * ms / std::max(static_cast<double>(count), 1.0));
    return;
  }
  // The offset of another picture may move a mirror image's border over a tile's, which changes the number of tiles.
  for (size_t i = 0; i < count; ++i) {
    tileMs_[i] = before[i * before.size() / count];
  }
  measured_ = measured_ * count / before.size();
}

TileRange SlowPicture::next(double ms, bool input) {
  tiles_ = {tiles_.end, tiles_.end + 1};
  const bool faces = tiles_.first < faces_;
  const auto expected = [&](size_t tile) { return faces ? faceMs_ : tileMs_[tile - faces_]; };
  const size_t end = faces ? faces_ : faces_ + tileMs_.size();
  const bool mayWait = !faces && !input && pays_;
  const size_t least = mayWait ? std::min((tileMs_.size() + mostFrames - 1) / mostFrames, 2 * lastCount_) : 1;
  for (double sum = expected(tiles_.first); tiles_.end < end; ++tiles_.end) {
    sum += expected(tiles_.end);
    if (sum > ms && tiles_.end - tiles_.first >= least) {
      break;
    }
  }
  return tiles_;
}

void SlowPicture::took(double ms) {
  totalMs_ += ms;
  const size_t count = tiles_.end - tiles_.first;
  const double tileMs = ms / static_cast<double>(count);
  if (tiles_.first < faces_) {
    faceMs_ = tileMs;
    return;
  }
  if (count != lastCount_ && lastCount_ > 0) {
    // A tile takes as long as in the last frame if tiles take all of a frame's time. It takes a share that falls with
    // their number if they take none of it. The limit is halfway between.
    const double limit = 0.5 * lastTileMs_ * (1.0 + static_cast<double>(lastCount_) / static_cast<double>(count));
    pays_ = count > lastCount_ ? tileMs < limit : tileMs > limit;
    framesAlike_ = 0;
  } else if (++framesAlike_ == framesToAskAgain) {
    pays_ = true;
    framesAlike_ = 0;
  }
  lastCount_ = count;
  lastTileMs_ = tileMs;
  std::fill(tileMs_.data() + tiles_.first - faces_, tileMs_.data() + tiles_.end - faces_, tileMs);
  measured_ = std::max(measured_, tiles_.end - faces_);
  dearestMs_ = std::max(remembered * dearestMs_, tileMs);
  std::fill(tileMs_.data() + measured_, tileMs_.data() + tileMs_.size(), std::max(tileMs, dearestMs_ / caution));
}

void Pace::begin(const CameraPose& camera, bool contentMoves, double seconds) {
  movement_.update(camera, contentMoves, seconds);
  seconds_ = seconds;
  untouched_ += seconds;
  begun_ = Clock::now();
  if (!drawn_.empty() && drawn_.back().frameMs == 0.0) {
    drawn_.back().frameMs = std::chrono::duration<double, std::milli>(begun_ - drawn_.back().begun).count();
  }
}

const FittedPlan& Pace::plan(const Request& request) {
  fitted_.plan.tiles.reset();
  level_ = 0;
  sharpDraft_ = false;
  text_.clear();
  answers_ = request.input && untouched_ >= untouchedSeconds ? framesToAnswer : std::max(answers_ - 1, 0);
  untouched_ = request.input ? 0.0 : untouched_;
  if (moving() && request.budgetMs > 0.0) {
    planMoving(request);
  } else {
    controller_.setStill();
    planStill(request);
  }
  long_ = !moving() && request.budgetMs > 0.0 && controller_.predict(work_) > request.budgetMs;
  return fitted_;
}

double Pace::longestFrame(double touched) const {
  return untouched_ >= untouchedSeconds ? untouchedWait : touched;
}

// Plans a picture, or number `picture` of a mean, with these settings.
void Pace::planWith(const Request& request, const Settings& settings, int picture) {
  FrameRequest frame = request.frame;
  frame.settings = settings;
  frame.picture = picture;
  fitted_ = request.planner.plan(frame);
  work_ = workOf(fitted_.plan, frame.scene, frame.state, fitted_.settings);
}

// Plans the frame within the budget. text_ then says what the picture gives up.
void Pace::planWithinBudget(const Request& request) {
  const Settings chosen = withPictures(request.frame.settings, 1);
  const std::vector<MotionLevel> levels = motionLevels(request.frame.scene, chosen, request.front, sampleCounts_);
  level_ = controller_.begin(levels, request.budgetMs, seconds_);
  planWith(request, levels[level_].settings, 0);
  while (const std::optional<size_t> next = controller_.next(levels, work_)) {
    level_ = *next;
    planWith(request, levels[level_].settings, 0);
  }
  if (learned_ >= framesToKnow) {
    findPlayCost(levels, request);
  }
  sharpDraft_ = !moving() && request.covered && lowers() && sharpens(levels[level_].settings, request);
  MotionLevel shown = levels[level_];
  if (sharpDraft_) {
    shown.settings.view.scale = chosen.view.scale;
  }
  // A limit that leaves no image out costs no quality. Images that the chosen limit leaves out count too.
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

// Plans the frame with these settings in the chosen resolution, unless that takes too long: it needs no pipelines that
// the coarse frame does not need, and those of the whole picture take long to compile.
bool Pace::sharpens(Settings settings, const Request& request) {
  const Settings coarse = settings;
  settings.view.scale = request.frame.settings.view.scale;
  if (controller_.predict(scaledWork(work_, coarse, settings)) > coveredWait * request.budgetMs) {
    return false;
  }
  planWith(request, settings, 0);
  return true;
}

// Finds what playing costs, at the best level that should fit: the controller rises to that level by and by.
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
  forgetStill();
  state_ = State::moving;
  shown_.reset();
  planWithinBudget(request);
  text_ = "Moving: " + text_;
}

void Pace::forgetStill() {
  ++still_;
  state_ = State::changed;
  picture_ = converged_ = 0;
  target_.reset();
  slow_ = {};
  draft_.clear();
}

void Pace::planStill(const Request& request) {
  // The mean begins anew when nothing moves any more, even if nothing else has changed.
  const auto shown =
      moving() ? std::nullopt : std::optional(std::pair(imageSettings(request.frame.settings), request.shown));
  if (std::exchange(shown_, shown) != shown || moving()) {
    forgetStill();
  }
  pictures_ = moving() ? 1 : stillPictures(request.frame.settings);
  const bool divides = request.budgetMs > 0.0;
  if (!divides) {
    if (!slow_.finished()) {
      target_.reset();
    }
    slow_ = {};
    draft_.clear();
  }
  const State state = stateAfter(request);
  if (pictures_ == 1 && !divides) {
    planWith(request, withPictures(request.frame.settings, 1), 0);
    picture_ = 1;
    state_ = state == State::done ? State::done : State::whole;
  } else if (state == State::changed) {
    planFirst(request);
  } else {
    planPicture(request, state);
  }
}

// Returns what follows the last frame. A single picture needs no redraw for a target: it is drawn again anyway if its
// plan cannot reuse it.
Pace::State Pace::stateAfter(const Request& request) {
  if (!request.target) {
    target_.reset();
  }
  if (state_ == State::changed || !slow_.finished()) {
    return state_;
  }
  if (picture_ < pictures_) {
    return State::mean;
  }
  const bool missing = request.target && pictures_ > 1 && target_ != request.target;
  target_ = request.target;
  return missing ? State::redraw : State::done;
}

// Plans the first frame of a still view: in full quality if that is fast, else the first picture of the mean if that is
// fast, else a draft. A slow frame would delay the mean, whose pictures have one sample; a single picture is drawn in
// tiles only if it would hold up input for long.
void Pace::planFirst(const Request& request) {
  const Settings whole = withPictures(request.frame.settings, 1);
  planWith(request, whole, 0);
  const double most = (pictures_ == 1 ? longestFrame(longestWait) : 1.0) * request.budgetMs;
  if (request.budgetMs <= 0.0 || controller_.predict(work_) <= most) {
    state_ = State::whole;
    picture_ = pictures_ == 1 ? 1 : 0;
    text_ = pictures_ == 1 ? "" : meanText(0);
    return;
  }
  planPicture(request, State::mean);
  if (controller_.predict(work_) <= longestFrame(longestWait) * request.budgetMs) {
    return;
  }
  picture_ = 0;
  state_ = State::draft;
  planWithinBudget(request);
  draft_ = text_ = "Draft: " + text_;
}

// Plans the next picture or, if it is slow and another picture is shown meanwhile, its next tiles.
void Pace::planPicture(const Request& request, State state) {
  state_ = state;
  const FrameCache& cache = request.frame.cache;
  if (state == State::mean && slow_.finished() && picture_ > 0 && cache.refined && cache.refined->none()) {
    picture_ = pictures_;  // the mean has converged and is shown again
    converged_ = cache.accumulated;
  }
  const int next = state != State::redraw ? picture_ : (cache.accumulated > 0 ? cache.accumulated : pictures_) - 1;
  refined_ =
      state == State::mean && cache.refined && picture_ > 0 ? std::optional(cache.refined->share()) : std::nullopt;
  if (slow_.finished()) {
    planWith(request, withPictures(request.frame.settings, pictures_), pictures_ == 1 ? 0 : next);
    const bool covers = request.budgetMs > 0.0 && (picture_ > 0 || !draft_.empty());
    const double ms = controller_.predict(work_);
    if (covers && ms > longestFrame(longestWait) * request.budgetMs && drawnInTiles(fitted_)) {
      const size_t faces = faceCount(fitted_.plan);
      slow_.begin(faces, tileCount(fitted_.plan) - faces, ms);
      slowWork_ = work_;
    }
  }
  if (!slow_.finished()) {
    planTiles(request);
    if (!slow_.finished()) {
      text_ = tilesText(next);
      return;
    }
  }
  picture_ = state == State::redraw ? pictures_ : std::min(next + 1, pictures_);
  if (pictures_ > 1) {
    text_ = meanText(picture_);
  }
}

void Pace::planTiles(const Request& request) {
  const double pixels = static_cast<double>(request.shown.size.x) * request.shown.size.y;
  besidesMs_ = cpuMs_ + sendMs() + shownMs_.value_or(controller_.predict({.displayTexels = pixels}));
  const double most = (request.input ? 1.0 : longestFrame(tilesShare)) * request.budgetMs;
  // At least half of the time goes to the tiles, whatever the rest of a frame takes. A frame that answers input has
  // waited for a long one and takes no more than a tile.
  fitted_.plan.tiles =
      answers_ > 0 ? slow_.next(0.0, true) : slow_.next(std::max(most - besidesMs_, besidesMs_), request.input);
}

std::string Pace::tilesText(int complete) const {
  const double share = slow_.share();
  if (complete == 0 && !draft_.empty()) {
    return fmt::format("{}; first picture {:.0f} %", draft_, std::floor(100.0 * share));
  }
  if (pictures_ == 1) {
    return fmt::format("Picture {:.0f} %", std::floor(100.0 * share));
  }
  return fmt::format("{}, next one {:.0f} %", meanText(complete), std::floor(100.0 * share));
}

std::string Pace::meanText(int complete) const {
  if (converged_ > 0) {
    return fmt::format("{} of {} pictures averaged: converged", converged_, pictures_);
  }
  const std::string averaged = fmt::format("{} of {} pictures averaged", complete, pictures_);
  return !refined_ || complete == pictures_
             ? averaged
             : fmt::format("{}, refining {:.0f} %", averaged, std::ceil(100.0 * *refined_));
}

std::string Pace::progress() const {
  if (moving()) {
    return lowers() ? "in lower quality, because it moves" : "";
  }
  if (picture_ == 0 && !draft_.empty()) {
    return "not finished: a draft";
  }
  return pictures_ < 2   ? ""
         : !isComplete() ? fmt::format("not finished: {} of {} pictures averaged", std::max(picture_, 1), pictures_)
                         : fmt::format("finished: {} pictures averaged", converged_ > 0 ? converged_ : pictures_);
}

void Pace::drawn(uint64_t number, double cpuMs, double waitedMs, bool learns) {
  cpuMs_ = cpuMs;
  drawn_.push_back({.number = number,
                    .cpuMs = cpuMs,
                    .waitedMs = waitedMs,
                    .begun = begun_,
                    .work = learns && !fitted_.plan.refined ? std::optional(work_) : std::nullopt});
  if (drawn_.size() > mostDrawn) {
    drawn_.pop_front();
  }
}

// Returns the least time of sending a picture, which the cores of a CPU device then do not draw.
double Pace::sendMs() const {
  return cpuDevice_ && !sendMs_.empty() ? std::ranges::min(sendMs_) : 0.0;
}

// Learns the time of a frame. On a CPU device, drawing, the program and sending the picture to the window system share
// the cores, so a frame takes the sum of their times, or less where they overlap. On a GPU it takes the longer time of
// drawing and program, unless the program waits for tiles or parts. Waiting for the monitor does not count.
void Pace::finished(const FrameTimings& timings) {
  const auto found = std::ranges::find(drawn_, timings.frame, &Drawn::number);
  if (found == drawn_.end()) {
    return;
  }
  sendMs_.push_back(std::max(found->presentMs + found->waitedMs - timings.gpuMs, 0.0));
  if (sendMs_.size() > sentFrames) {
    sendMs_.pop_front();
  }
  double tilesMs = 0.0;
  for (const PassTiming& pass : timings.passes) {
    tilesMs += std::ranges::find(besideTiles, pass.name) != besideTiles.end() ? 0.0 : pass.gpuMs;
  }
  if (!timings.passes.empty()) {
    shownMs_ = std::max(timings.gpuMs - tilesMs, 0.0);
  }
  const double sum = found->cpuMs + timings.gpuMs + sendMs();
  const bool overlaps = !cpuDevice_ && !drawsTiles() && found->waitedMs == 0.0;
  const double ms = overlaps              ? std::max(found->cpuMs, timings.gpuMs)
                    : found->frameMs == 0 ? sum
                                          : std::min(found->frameMs, sum);
  if (drawsTiles() && found + 1 == drawn_.end()) {
    slow_.took(tilesMs > 0.0 ? tilesMs : std::max(ms - besidesMs_, leastShare * ms));
    // The frames with tiles took longer than a single frame would have, so their time is learned only if even that was
    // less than predicted.
    if (slow_.finished() && !fitted_.plan.refined && slow_.totalMs() < controller_.predict(slowWork_)) {
      controller_.learn(slowWork_, slow_.totalMs());
    }
  } else if (found->work) {
    controller_.learn(*found->work, ms);
    learned_ += moving();
  }
  drawn_.erase(drawn_.begin(), found + 1);
}

int stillPictures(const Settings& settings) {
  return std::max(settings.view.accumulate, settings.quality.stillPictures);
}

Settings imageSettings(Settings settings) {
  settings.ui = {};
  settings.view.continuous = false;
  settings.quality.motionMs.reset();
  return settings;
}

Settings withPictures(Settings settings, int pictures) {
  settings.view.accumulate = pictures;
  settings.view.accumulateError =
      pictures > 1 ? std::max(settings.view.accumulateError, settings.quality.stillError) : 0.0;
  return settings;
}

double motionBudget(const Settings& settings, bool cpuDevice, double refreshHz) {
  return settings.quality.motionMs.value_or(cpuDevice ? cpuBudgetMs : refreshShare * 1000.0 / refreshHz);
}

}  // namespace speculum
