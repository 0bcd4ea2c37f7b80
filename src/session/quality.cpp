#include "session/quality.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <map>
#include <ranges>

#include "accuracy/sweep_json.hpp"
#include "platform/text.hpp"
#include "scene/scene_loader.hpp"
#include "settings/setting_fields.hpp"

namespace speculum {

namespace {

// Says whether a sweep measures the setting. The others choose what is shown, or change no radiance.
bool isQuality(const std::string& key) {
  const SettingField* field = findSettingField(key);
  return !field || (field->changes < FramePart::display && !field->subject && !key.starts_with("debug."));
}

void warnOfDifferences(const SweepResults& results, const Options& options, const std::filesystem::path& scene) {
  if (results.scene != scene.filename()) {
    spdlog::warn("the sweep is of {}: its figures need not hold for {}", results.scene, scene.filename().string());
  }
  if (results.width != options.size.width || results.height != options.size.height) {
    spdlog::warn("the sweep is of {}x{} pixels: its milliseconds are not those of {}x{}", results.width, results.height,
                 options.size.width, options.size.height);
  }
}

}  // namespace

std::vector<SettingChange> settingsOfPoint(const SweepResults& results, int point) {
  std::map<std::string, std::string> values;
  for (const std::vector<SettingChange>& changes : {results.base, results.points[point].changes}) {
    for (const SettingChange& change : changes) {
      values[change.key] = change.value;
    }
  }
  std::vector<SettingChange> settings;
  for (const auto& [key, value] : values) {
    if (isQuality(key)) {
      settings.push_back({key, value});
    }
  }
  return settings;
}

bool isAtPoint(const Settings& settings, const std::vector<SettingChange>& point) {
  return std::ranges::all_of(
      point, [&](const SettingChange& change) { return settingValue(settings, change.key) == change.value; });
}

void applyPoint(const SweepResults& results, int point, const std::set<std::string>& kept, Settings& settings) {
  for (const SettingChange& change : settingsOfPoint(results, point)) {
    if (kept.contains(change.key)) {
      if (settingValue(settings, change.key) != change.value) {
        spdlog::warn("{} is set by hand: the sweep's figures do not hold for it", change.key);
      }
    } else if (const auto problem = setSetting(settings, change.key, change.value)) {
      throw InputError("--sweep-results: " + results.points[point].name + ": " + *problem);
    }
  }
}

SweepResults readStillSweep(const std::filesystem::path& file) {
  SweepResults results = readSweepResults(file);
  if (results.motion) {
    throw InputError(file.string() + ": motion: measured in motion (results of accuracy without --motion are needed)");
  }
  return results;
}

std::optional<QualityChoice> chooseQuality(const Options& options, const std::filesystem::path& scene,
                                           Settings& settings) {
  if (!budgetOf(settings).bounds()) {
    if (!options.sweepResults.empty() && options.command != "demo") {
      throw UsageError(
          "--sweep-results: chooses nothing without a bound (--set quality.budget_ms=MS or quality.max_error=FLIP)");
    }
    return std::nullopt;
  }
  const auto keys = std::views::keys(options.settings);
  const std::set<std::string> kept(keys.begin(), keys.end());
  if (options.sweepResults.empty()) {
    const bool byHand = kept.contains("quality.budget_ms") || kept.contains("quality.max_error");
    if (byHand && options.command != "demo") {
      throw UsageError(
          "quality.budget_ms and quality.max_error choose from a sweep "
          "(--sweep-results F, the results.json of speculum accuracy)");
    }
    const char* bounds = settings.quality.maxError <= 0.0   ? "GPU budget waits"
                         : settings.quality.budgetMs <= 0.0 ? "Max. mean FLIP waits"
                                                            : "GPU budget and Max. mean FLIP wait";
    spdlog::warn("{} for a measurement ({})", bounds,
                 options.command == "demo" ? "Accuracy > Measure this view"
                                           : "render and bench take --sweep-results F, the results.json of accuracy");
    return std::nullopt;
  }
  const SweepResults results = readStillSweep(options.sweepResults);
  const std::optional<BudgetChoice> choice = chooseForBudget(results, budgetOf(settings));
  if (!choice) {
    throw InputError(options.sweepResults.string() + ": points: none (a sweep with at least one point is needed)");
  }
  warnOfDifferences(results, options, scene);
  applyPoint(results, choice->point, kept, settings);
  printLine(fmt::format("quality: {} (measured on {}, {} at {}x{})", choice->why, results.device, results.scene,
                        results.width, results.height),
            stderr);
  return QualityChoice{results.points[choice->point], choice->met, choice->why};
}

}  // namespace speculum
