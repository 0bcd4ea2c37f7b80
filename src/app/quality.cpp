#include "app/quality.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdio>
#include <set>

#include "scene/scene_loader.hpp"

namespace speculum {

namespace {

void set(Settings& settings, const SettingChange& change) {
  if (const auto problem = setSetting(settings, change.key, change.value)) {
    throw InputError("--sweep-results: " + *problem);
  }
}

std::vector<std::string> keysOf(const Options& options) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : options.settings) {
    keys.push_back(key);
  }
  return keys;
}

bool contains(const std::vector<std::string>& keys, const std::string& key) {
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

bool bounded(const Settings& settings) {
  return settings.quality.budgetMs > 0.0 || settings.quality.maxError > 0.0;
}

}  // namespace

void applyPoint(const SweepResults& results, int point, const std::vector<std::string>& kept, Settings& settings) {
  std::set<std::string> swept;
  for (const SweepPoint& other : results.points) {
    for (const SettingChange& change : other.changes) {
      swept.insert(change.key);
    }
  }
  for (const SettingChange& change : results.base) {
    if (swept.contains(change.key) && !contains(kept, change.key)) {
      set(settings, change);
    }
  }
  for (const SettingChange& change : results.points[point].changes) {
    if (!contains(kept, change.key)) {
      set(settings, change);
    } else {
      spdlog::warn("{} is set by hand: the sweep's figures do not hold for it", change.key);
    }
  }
}

std::optional<QualityChoice> chooseQuality(const Options& options, Settings& settings) {
  if (!bounded(settings)) {
    return std::nullopt;
  }
  const std::vector<std::string> kept = keysOf(options);
  if (options.sweepResults.empty()) {
    const bool byHand = contains(kept, "quality.budget_ms") || contains(kept, "quality.max_error");
    if (byHand && options.command != "demo") {
      throw UsageError(
          "--set: quality.budget_ms and quality.max_error choose from a sweep (--sweep-results F, the results.json of "
          "speculum accuracy)");
    }
    spdlog::warn("quality.budget_ms and quality.max_error have no effect before a sweep is measured or loaded");
    return std::nullopt;
  }
  const SweepResults results = readSweepResults(options.sweepResults);
  const QualityBudget budget{settings.quality.budgetMs, settings.quality.maxError};
  const std::optional<BudgetChoice> choice = chooseForBudget(results, budget);
  if (!choice) {
    throw InputError(options.sweepResults.string() + ": points: none (a sweep with at least one point is needed)");
  }
  applyPoint(results, choice->point, kept, settings);
  std::fprintf(stderr, "quality: %s (measured on %s, %s at %dx%d)\n", choice->why.c_str(), results.device.c_str(),
               results.scene.c_str(), results.width, results.height);
  return QualityChoice{results.points[choice->point], choice->met, choice->why};
}

}  // namespace speculum
