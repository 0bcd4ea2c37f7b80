#include "app/accuracy_controller.hpp"

#include <nlohmann/json.hpp>

#include "accuracy/heat_map.hpp"
#include "app/quality.hpp"

namespace speculum {

namespace {

constexpr int heatBarSteps = 32;

Image8 drawnPicture(Renderer& renderer, SceneRenderer& sceneRenderer, const DifferenceView::Look& look) {
  renderer.waitIdle();
  const std::vector<float> texels = renderer.uploader().readFloats(sceneRenderer.mainTarget().color());
  LinearImage image(look.width, look.height);
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    image.pixels[i] = {texels[4 * i], texels[4 * i + 1], texels[4 * i + 2]};
  }
  return toDisplay(image, look.settings.view.exposure, look.settings.view.toneMap);
}

std::string aboutText(const SweepResults& results) {
  return results.scene + " at " + std::to_string(results.width) + "x" + std::to_string(results.height) + ", " +
         std::to_string(results.points.size()) + " configurations, " + results.device;
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
    budget_ = {settings.quality.budgetMs, settings.quality.maxError};
  }
}

void AccuracyController::showResults(UiModel& model) {
  UiAccuracy& accuracy = model.accuracy;
  accuracy.points.clear();
  for (const SweepPoint& point : results_.points) {
    const Spread& spread = point.gpuMs.median > 0.0 ? point.gpuMs : point.frameMs;
    accuracy.points.push_back(
        {point.name, point.whole.flip, spread.median, spread.lowerQuartile, spread.upperQuartile});
  }
  accuracy.front = paretoFront(results_.points);
  accuracy.noiseFloor = results_.floorWhole.flip;
  accuracy.about = aboutText(results_);
  budget_ = {};
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
    sweep_.start(view());
  }
  if (std::optional<SweepResults> results = sweep_.take()) {
    results_ = std::move(*results);
    showResults(model);
  }
  if (accuracy.apply >= 0 && accuracy.apply < static_cast<int>(results_.points.size())) {
    applyPoint(results_, accuracy.apply, {}, model.settings);
  }
  applyBudget(model);
}

void AccuracyController::findCurrentPoint(UiModel& model) {
  const std::string settings = settingsJson(model.settings).dump();
  if (settings == settings_) {
    return;
  }
  settings_ = settings;
  model.accuracy.current = -1;
  for (int i = 0; i < static_cast<int>(results_.points.size()) && model.accuracy.current < 0; ++i) {
    Settings atPoint = model.settings;
    applyPoint(results_, i, {}, atPoint);
    model.accuracy.current = settingsJson(atPoint).dump() == settings ? i : -1;
  }
}

void AccuracyController::update(UiModel& model, const DifferenceView::Look& look, Renderer& renderer,
                                SceneRenderer& sceneRenderer) {
  UiAccuracy& accuracy = model.accuracy;
  const std::optional<SweepStatus> status = sweep_.status();
  accuracy.stage = status ? status->stage : "";
  accuracy.progress = status ? status->fraction : 0.0;
  const std::string failed = sweep_.error();
  if (!failed.empty()) {
    accuracy.about = failed;
  }
  findCurrentPoint(model);
  const bool changed = accuracy.showDifference
                           ? difference_.update(look, [&] { return drawnPicture(renderer, sceneRenderer, look); })
                           : difference_.reset();
  if (changed) {
    sceneRenderer.setCover(difference_.heatMap());
  }
  accuracy.difference = difference_.status();
}

void AccuracyController::forgetScene(UiModel& model) {
  sweep_.cancel();
  sweep_.take();
  difference_.reset();
  results_ = {};
  UiAccuracy& accuracy = model.accuracy;
  accuracy.points.clear();
  accuracy.front.clear();
  accuracy.current = -1;
  accuracy.about.clear();
  accuracy.choice.clear();
  budget_ = {};
}

}  // namespace speculum
