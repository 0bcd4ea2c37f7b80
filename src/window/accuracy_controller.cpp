#include "window/accuracy_controller.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "accuracy/pareto.hpp"
#include "accuracy/sweep_json.hpp"
#include "compare/picture_agreement.hpp"
#include "platform/files.hpp"
#include "platform/text.hpp"
#include "scene/fingerprint.hpp"
#include "session/session_subject.hpp"
#include "window/background_job.hpp"

namespace speculum {

namespace {

// Samples a pixel: enough to rank errors, in a fraction of the time of a report's 256.
constexpr int truthSamples = 64;
constexpr int floorSamples = 81;
constexpr int roughSamples = 4;
constexpr double roughPixels = 160.0 * 90.0;

Options optionsOf(const SweepRequest& request) {
  Options options = request.options;
  options.settings.clear();
  options.sweepResults.clear();
  return options;
}

Settings baseOf(const SweepRequest& request) {
  Settings base = request.base;
  base.quality = {};
  base.ui = {};
  base.reflection.updateInterval = base.limit.mostInterval = 1;  // the view stands still
  base.debug.checkFinite = false;                                // the time of the check would be counted
  return base;
}

// Returns the folder in which a view's measurement is kept, so that measuring the view again takes no time. Removes the
// oldest of such folders.
std::filesystem::path storeFolder(Session& session, const SweepRequest& request) {
  namespace fs = std::filesystem;
  constexpr size_t mostViews = 20;
  Fingerprint view;
  Options options = request.options;
  options.time = contentTime(session.scene(), options.time).value_or(0.0);  // content only: `request` has the camera
  view.add(sweepIdentity(session, options));
  view.add(std::as_bytes(std::span(&request.camera.eye, 1)));
  view.add(std::as_bytes(std::span(&request.camera.worldToView, 1)));
  view.add(request.camera.verticalFov);
  const fs::path sweeps = userCacheDir() / "sweeps";
  keepNewest(sweeps, mostViews);
  return sweeps / view.hex();
}

constexpr int heatBarSteps = 32;
constexpr int mostSamples = 64;  // samples a pixel of the difference map's finest reference
constexpr int roughRounds = 5;   // rounds of times of a rough measurement; its first points are shown after one

std::string momentText(const std::optional<WatchedState>& measured) {
  return measured && measured->animated ? fmt::format(" (animation at {:.2f} s)", measured->time) : "";
}

std::string aboutText(const SweepResults& results, const std::optional<WatchedState>& measured) {
  const std::string same = results.leftOut > 0 ? fmt::format(" ({} more draw the same)", results.leftOut) : "";
  return fmt::format("{} configurations{} at {}x{}, reference of {} samples a pixel{}", results.points.size(), same,
                     results.width, results.height, results.truthSamples, momentText(measured));
}

std::string roughText(const SweepResults& results, const std::optional<WatchedState>& measured) {
  return fmt::format("Rough: errors of a {}x{} picture, times estimated from it{}.", results.width, results.height,
                     momentText(measured));
}

// Returns for each setting that was measured by itself what its values cost, cheapest first.
std::map<std::string, std::string, std::less<>> pricesOf(const SweepResults& results, bool rough) {
  std::map<std::string, std::multimap<double, std::string>> values;  // by setting and milliseconds
  const auto add = [&](const std::string& key, const std::string& value, const SweepPoint& point) {
    const double ms = costSpread(point).median;
    values[key].emplace(ms, fmt::format("\n{}: {} ms, FLIP {:.3f}", value, significant(ms, 3), point.whole.flip));
  };
  for (const SweepPoint& point : results.points) {
    if (point.changes.size() == 1) {
      add(point.changes.front().key, point.changes.front().value, point);
    }
  }
  const auto unchanged = std::ranges::find_if(results.points, [](const auto& point) { return point.changes.empty(); });
  for (const SettingChange& base : results.base) {
    if (values.contains(base.key) && unchanged != results.points.end()) {
      add(base.key, base.value, *unchanged);
    }
  }
  std::map<std::string, std::string, std::less<>> prices;
  for (const auto& [key, texts] : values) {
    prices[key] = rough ? "\nEstimated for this view:" : "\nMeasured in this view:";
    for (const auto& [ms, line] : texts) {
      prices[key] += line;
    }
  }
  return prices;
}

}  // namespace

ViewMeasurement::ViewMeasurement(const SweepRequest& request)
    : request_(request), base_(baseOf(request)), session_(optionsOf(request)) {
  session_.setCamera(request.camera);
}

SweepResults ViewMeasurement::measure(PictureSize size, const Effort& effort, const SweepProgress& progress) {
  if (!progress({"starting", 0.0})) {
    return {};
  }
  session_.resize(size);
  session_.setSettings(base_);
  SceneState state = evaluate(session_.scene(), request_.options.time);
  state.camera = request_.camera;
  SweepPlan plan = viewSweep(sweepContext(session_));
  plan.repeats = effort.rounds;
  SessionSubject subject(session_, request_.options.time);
  SweepStore store(storeFolder(session_, request_));
  const SweepScene scene{.scene = session_.scene(),
                         .stateOf = [&](int) { return state; },
                         .truth = {.width = size.width,
                                   .height = size.height,
                                   .samples = effort.samples,
                                   .lattice = true,
                                   .floorSamples = effort.floorSamples}};
  SweepResults results = describeSweep(session_, plan, request_.options.time);
  bool finished = false;
  inBackground([&] { finished = runSweep(plan, base_, scene, subject, store, results, progress); });
  if (finished && session_.device().validationMessages() > 0) {
    throw std::runtime_error("the measurement made validation messages");
  }
  return finished ? results : SweepResults();
}

SizedMs ViewMeasurement::sizedMs(const SweepPoint& point, PictureSize small) {
  const auto [known, isNew] = sizedMs_.try_emplace(point.name);
  if (isNew) {
    const auto time = [&](PictureSize size) {
      session_.resize(size);
      const FrameCost cost = SessionSubject(session_, request_.options.time).cost(settingsWith(base_, point.changes));
      return cost.gpuMs > 0.0 ? cost.gpuMs : cost.frameMs;
    };
    time(small);  // not counted, because it compiles the point's pipelines
    known->second.small = time(small);
    known->second.whole = time(request_.options.size);
  }
  return known->second;
}

SweepResults ViewMeasurement::whole(const SweepProgress& progress) {
  return measure(request_.options.size, {.samples = truthSamples, .floorSamples = floorSamples}, progress);
}

SweepResults ViewMeasurement::rough(int rounds, const SweepProgress& progress) {
  const PictureSize whole = request_.options.size;
  const double scale = std::min(1.0, std::sqrt(roughPixels / (whole.width * whole.height)));
  const PictureSize small{std::max(1, static_cast<int>(whole.width * scale)),
                          std::max(1, static_cast<int>(whole.height * scale))};
  SweepResults results = measure(small, {.samples = roughSamples, .rounds = rounds}, progress);
  if (results.points.empty()) {
    return results;
  }
  const SizedMs base = sizedMs(results.points.front(), small);
  if (!progress({"times", 0.0})) {
    return {};
  }
  enlargeTimes(results, base, sizedMs(*std::ranges::min_element(results.points, {}, costMs), small),
               static_cast<double>(whole.width) * whole.height / (static_cast<double>(small.width) * small.height));
  return progress({"times", 1.0}) ? results : SweepResults();
}

void enlargeTimes(SweepResults& results, const SizedMs& base, const SizedMs& fastest, double pixels) {
  constexpr double leastRatio = 1.2;  // of two times that give a line: noise must not decide the line's slope
  const double proportion = base.whole / base.small;
  const bool line = base.small > leastRatio * fastest.small && base.whole > fastest.whole;
  const double slope = line ? (base.whole - fastest.whole) / (base.small - fastest.small) : proportion;
  const double factor = std::clamp(slope, proportion, std::max(proportion, pixels));
  const double constant = base.whole - factor * base.small;
  for (SweepPoint& point : results.points) {
    for (Spread* spread : {&point.gpuMs, &point.frameMs}) {
      if (spread->repeats == 0) {
        continue;
      }
      for (double* ms : {&spread->median, &spread->minimum, &spread->lowerQuartile, &spread->upperQuartile}) {
        *ms = std::max(*ms, constant + factor * *ms);  // a larger picture takes no less
      }
    }
  }
}

std::pair<std::string, double> measuringStep(int part, const SweepStatus& status) {
  // Part 1 takes the reference and the pictures from part 0.
  const int stage = status.stage == "times" ? 2 : part == 1 ? 3 : status.stage == "pictures" ? 1 : 0;
  const int step = part == 0 ? stage : part == 1 ? 3 : 4 + stage;
  const double done = stage == 3 || status.stage == "starting" ? 0.0 : status.fraction;
  const char* name = stage == 0 ? "Tracing the reference" : stage == 1 ? "Comparing settings" : "Timing settings";
  return {fmt::format("{} ({} of 7{})", name, step + 1, part < 2 ? ", rough" : ""), (step + done) / 7.0};
}

double secondsLeft(double elapsed, double fraction) {
  return fraction > 0.03 && elapsed > 2.0 ? elapsed * (1.0 / fraction - 1.0) : 0.0;
}

bool isOtherView(const WatchedState& measured, const WatchedState& now) {
  const bool setTime = now.animated && (now.paused || now.seeks != measured.seeks) && now.time != measured.time;
  const bool followsScene = !measured.movedCamera && !now.movedCamera;
  return setTime || (!followsScene &&
                     (now.camera.eye != measured.camera.eye || now.camera.worldToView != measured.camera.worldToView));
}

AccuracyController::AccuracyController(const Options& options, const Settings& loaded, const std::string& choice) {
  for (int i = 0; i < heatBarSteps; ++i) {
    shown_.heatBar.emplace_back(heatColor((i + 0.5) / heatBarSteps));
  }
  if (!options.sweepResults.empty()) {
    setResults(readStillSweep(options.sweepResults));
    Settings scratch;
    for (size_t i = 0; i < results_.points.size(); ++i) {
      applyPoint(static_cast<int>(i), scratch);  // throws now if a point cannot be applied
    }
    shown_.about = aboutText(results_, measured_);
    acceptBudget(loaded);
    if (const std::optional<BudgetChoice> chosen = chooseForBudget(results_, budget_)) {
      shown_.chosen = chosen->point;
      shown_.choiceMisses = !chosen->met;
    }
  }
  shown_.choice = choice;
}

void AccuracyController::setChoice(const std::string& text, bool misses) {
  shown_.choice = text;
  shown_.choiceMisses = misses;
}

void AccuracyController::setResults(SweepResults results, bool rough) {
  results_ = std::move(results);
  shown_.points.clear();
  pointSettings_.clear();
  for (size_t i = 0; i < results_.points.size(); ++i) {
    const SweepPoint& point = results_.points[i];
    const Spread& spread = costSpread(point);
    shown_.points.push_back({point.name, point.whole.flip, spread.median, spread.lowerQuartile, spread.upperQuartile});
    pointSettings_.push_back(settingsOfPoint(results_, static_cast<int>(i)));
  }
  shown_.prices = pricesOf(results_, rough);
  shown_.front = paretoFront(results_.points);
  frontLevels_.clear();
  for (auto point = shown_.front.rbegin(); point != shown_.front.rend(); ++point) {
    MotionLevel& level = frontLevels_.emplace_back();
    applyPoint(*point, level.settings);
    level.error = shown_.points[static_cast<size_t>(*point)].error;
  }
  shown_.noiseFloor = results_.floor.whole.flip;
  shown_.about.clear();
  // A budget chooses again, unless the user has set settings by hand since.
  budget_ = setByHand_ ? budget_ : QualityBudget();
  shown_.chosen = -1;
  isRough_ = rough;
  settings_.reset();
}

void AccuracyController::measure(SweepRequest request, const WatchedState& view) {
  requested_ = view;
  if (shown_.points.empty()) {
    shown_.about.clear();
  }
  sweep_.start({{"starting", 0.0}, nullptr}, [request = std::move(request)](const auto& report) {
    std::shared_ptr<const SweepResults> rough;
    int part = 0;
    const auto progress = [&](const SweepStatus& status) { return report({status, rough, part}); };
    ViewMeasurement measurement(request);
    for (const int rounds : {1, roughRounds}) {
      SweepResults results = measurement.rough(rounds, progress);
      if (results.points.empty()) {
        return results;
      }
      rough = std::make_shared<SweepResults>(std::move(results));
      ++part;
    }
    return measurement.whole(progress);
  });
}

void AccuracyController::cancel() {
  if (const auto status = sweep_.progress(); status && status->rough && status->rough == rough_) {
    shown_.about = roughText(results_, measured_) + " The measurement was cancelled.";
  }
  sweep_.cancel();
}

// Shows a rough measurement at first, and the whole one when it is complete.
void AccuracyController::takeResults() {
  if (const auto status = sweep_.progress(); status && status->rough && rough_ != status->rough) {
    rough_ = status->rough;
    setResults(*rough_, true);
    measured_ = requested_;
    shown_.about = roughText(results_, measured_) + " Better ones follow.";
  }
  if (std::optional<SweepResults> results = sweep_.takeResult()) {
    setResults(std::move(*results));
    measured_ = requested_;
    shown_.about = aboutText(results_, measured_);
  }
}

void AccuracyController::applyPoint(int point, Settings& settings) const {
  if (point >= 0 && point < static_cast<int>(results_.points.size())) {
    speculum::applyPoint(results_, point, {}, settings);
  }
}

void AccuracyController::beforeFrame(Settings& settings) {
  takeResults();
  followBudget(settings);
  findCurrentPoint(settings);
  shown_.alone = showsPoints_ && shown_.current >= 0 && picked_ == settings;
}

void AccuracyController::show(bool points, std::optional<double> errorGain) {
  showsPoints_ = points;
  coverChanged_ = coverChanged_ || (errorGain != errorGain_ && difference_.map().width > 0);
  errorGain_ = errorGain;
}

Settings AccuracyController::shown(Settings settings) const {
  settings.quality.stillPictures = shown_.alone ? 1 : settings.quality.stillPictures;
  return settings;
}

void AccuracyController::followBudget(Settings& settings) {
  if (budgetOf(settings) == budget_) {
    return;
  }
  acceptBudget(settings);
  setByHand_ = false;
  setChoice();
  shown_.chosen = -1;
  if (const std::optional<BudgetChoice> choice = chooseForBudget(results_, budget_)) {
    applyPoint(choice->point, settings);
    setChoice(choice->why + (isRough_ ? " (rough figures)" : ""), !choice->met);
    shown_.chosen = choice->point;
  }
}

void AccuracyController::findCurrentPoint(const Settings& settings) {
  if (settings_ == settings) {
    return;
  }
  settings_ = settings;
  const auto at = std::ranges::find_if(pointSettings_, [&](const auto& point) { return isAtPoint(settings, point); });
  shown_.current = at == pointSettings_.end() ? -1 : static_cast<int>(at - pointSettings_.begin());
  if (shown_.current != shown_.chosen) {
    const bool chose = budget_.bounds() && !results_.points.empty();
    setChoice(chose ? "Set by hand. Change a bound to let it choose again." : "");
    setByHand_ = chose;
    shown_.chosen = -1;
  }
}

void AccuracyController::afterFrame(const ShownPicture& shown, const WatchedState& view,
                                    const std::function<Image8()>& image) {
  const std::optional<Status> status = sweep_.progress();
  shown_.measuring = status.has_value();
  const auto [stage, progress] = status ? measuringStep(status->part, *status) : std::pair(std::string(), 0.0);
  if (std::exchange(shown_.stage, stage) != stage) {
    stageBegan_ = Clock::now();
  }
  const double elapsed = std::chrono::duration<double>(Clock::now() - stageBegan_).count();
  shown_.secondsLeft = status ? secondsLeft(elapsed, status->fraction) : 0.0;
  shown_.otherView = !shown_.points.empty() && measured_ && isOtherView(*measured_, view);
  shown_.progress = progress;
  if (const std::optional<std::string> error = sweep_.takeError()) {
    shown_.about = *error;
  }
  // A picked point was compared with a reference of truthSamples, so the map takes as many: both then show one figure.
  const int samples = shown_.alone && !isRough_ ? results_.truthSamples : mostSamples;
  const bool changed = errorGain_ ? image && difference_.update(shown, image, samples) : difference_.reset();
  coverChanged_ = coverChanged_ || changed;
  shown_.difference = difference_.status();
  shown_.mirrorErrors = difference_.mirrorErrors();
}

std::optional<Image8> AccuracyController::takeCover() {
  return std::exchange(coverChanged_, false)
             ? std::optional(heatColors(difference_.map(), 1.0 / errorGain_.value_or(1.0)))
             : std::nullopt;
}

bool AccuracyController::working() const {
  return sweep_.busy() || coverChanged_ || (errorGain_ && difference_.working());
}

void AccuracyController::forgetScene(const std::string& why) {
  const bool cancelled = sweep_.busy();
  sweep_.cancel();
  const std::string about = cancelled                ? why + ", so the measurement was cancelled."
                            : !shown_.points.empty() ? why + " since the measurement."
                                                     : shown_.about;
  coverChanged_ = difference_.reset() || coverChanged_;
  difference_.stop();
  setResults({});
  measured_.reset();
  shown_.about = about;
  setChoice();
}

}  // namespace speculum
