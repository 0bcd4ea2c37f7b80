#include "app/accuracy_controller.hpp"

#include <algorithm>
#include <utility>

#include "accuracy/heat_map.hpp"
#include "accuracy/sweep_json.hpp"
#include "app/quality.hpp"
#include "image/color.hpp"

namespace speculum {

namespace {

constexpr int heatBarSteps = 32;

std::string aboutText(const SweepResults& results) {
  return results.scene + " at " + std::to_string(results.width) + "x" + std::to_string(results.height) + ", " +
         std::to_string(results.points.size()) + " configurations, reference of " +
         std::to_string(results.truthSamples) + " samples, " + results.device;
}

}  // namespace

AccuracyController::AccuracyController(const Options& options, const Settings& settings, UiModel& model) {
  for (int i = 0; i < heatBarSteps; ++i) {
    model.accuracy.heatBar.emplace_back(heatColor((i + 0.5) / heatBarSteps));
  }
  if (!options.sweepResults.empty()) {
    results_ = readSweepResults(options.sweepResults);
    Settings scratch;
    for (size_t i = 0; i < results_.points.size(); ++i) {
      applyPoint(results_, static_cast<int>(i), {}, scratch);  // so that none fails later
    }
    showResults(model);
    model.accuracy.about = aboutText(results_);
    budget_ = {settings.quality.budgetMs, settings.quality.maxError};
  }
}

void AccuracyController::showResults(UiModel& model) {
  UiAccuracy& accuracy = model.accuracy;
  accuracy.points.clear();
  pointSettings_.clear();
  for (size_t i = 0; i < results_.points.size(); ++i) {
    const SweepPoint& point = results_.points[i];
    const Spread& spread = costSpread(point);
    accuracy.points.push_back(
        {point.name, point.whole.flip, spread.median, spread.lowerQuartile, spread.upperQuartile});
    pointSettings_.push_back(settingsOfPoint(results_, static_cast<int>(i)));
  }
  accuracy.front = paretoFront(results_.points);
  accuracy.noiseFloor = results_.floorWhole.flip;
  accuracy.about.clear();
  budget_ = {};
  chosen_ = -1;
  settings_.clear();
}

void AccuracyController::applyBudget(UiModel& model) {
  const QualitySettings& quality = model.settings.quality;
  if (quality.budgetMs == budget_.ms && quality.maxError == budget_.error) {
    return;
  }
  budget_ = {quality.budgetMs, quality.maxError};
  const std::optional<BudgetChoice> choice = chooseForBudget(results_, budget_);
  if (choice) {
    applyPoint(results_, choice->point, {}, model.settings);
    model.accuracy.choice = choice->why;
    chosen_ = choice->point;
  } else {
    const bool bounded = budget_.ms > 0.0 || budget_.error > 0.0;
    model.accuracy.choice = bounded ? "measure this view, or start with --sweep-results, to choose from" : "";
  }
}

void AccuracyController::apply(UiModel& model, const std::function<SweepRequest()>& view) {
  UiAccuracy& accuracy = model.accuracy;
  if (accuracy.cancel) {
    sweep_.cancel();
  }
  if (accuracy.measure) {
    sweep_.start({"starting", 0.0},
                 [request = view()](const SweepProgress& progress) { return measureView(request, progress); });
  }
  if (std::optional<SweepResults> results = sweep_.takeResult()) {
    results_ = std::move(*results);
    showResults(model);
    accuracy.about = aboutText(results_) + "; times taken while the window was drawing";
  }
  if (accuracy.apply >= 0 && accuracy.apply < static_cast<int>(results_.points.size())) {
    applyPoint(results_, accuracy.apply, {}, model.settings);
  }
  applyBudget(model);
}

void AccuracyController::findCurrentPoint(UiModel& model) {
  std::string settings = settingsKey(model.settings);
  if (settings == settings_) {
    return;
  }
  settings_ = std::move(settings);
  const auto at = std::find_if(pointSettings_.begin(), pointSettings_.end(),
                               [&](const auto& point) { return isAtPoint(model.settings, point); });
  UiAccuracy& accuracy = model.accuracy;
  accuracy.current = at == pointSettings_.end() ? -1 : static_cast<int>(at - pointSettings_.begin());
  if (accuracy.current != chosen_) {
    accuracy.choice.clear();
    chosen_ = -1;
  }
}

void AccuracyController::update(UiModel& model, const ShownPicture& shown, SceneRenderer& sceneRenderer) {
  UiAccuracy& accuracy = model.accuracy;
  const std::optional<SweepStatus> status = sweep_.progress();
  accuracy.stage = status ? status->stage : "";
  accuracy.progress = status ? status->fraction : 0.0;
  if (const std::optional<std::string> error = sweep_.takeError()) {
    accuracy.about = *error;
  }
  findCurrentPoint(model);
  const auto picture = [&] {
    return toDisplay(sceneRenderer.radiance(), shown.settings.view.exposure, shown.settings.view.toneMap);
  };
  const bool changed =
      accuracy.open && accuracy.showDifference ? difference_.update(shown, picture) : difference_.reset();
  if (changed) {
    sceneRenderer.setCover(difference_.heatMap());
  }
  accuracy.difference = difference_.status();
}

bool AccuracyController::working(const UiModel& model) const {
  const UiAccuracy& accuracy = model.accuracy;
  return !accuracy.stage.empty() || (accuracy.open && accuracy.showDifference && difference_.working());
}

void AccuracyController::forgetScene(UiModel& model) {
  sweep_.cancel();
  difference_.stop();
  results_ = {};
  showResults(model);
  model.accuracy.choice.clear();
}

}  // namespace speculum
