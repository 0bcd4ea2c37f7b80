#pragma once

#include <optional>
#include <set>
#include <string>

#include "accuracy/pareto.hpp"
#include "session/options.hpp"
#include "settings/settings.hpp"

namespace speculum {

inline QualityBudget budgetOf(const Settings& settings) {
  return {settings.quality.budgetMs, settings.quality.maxError};
}

// The point of a sweep that the bounds of quality.* chose.
struct QualityChoice {
  SweepPoint point;
  bool met = true;  // false: no point meets the bounds, and this one comes closest
  std::string why;  // one sentence for users
};

// Reads the file of --sweep-results. Throws InputError as readSweepResults() does, and for a sweep in motion, whose
// points may not name the settings that its frames had.
SweepResults readStillSweep(const std::filesystem::path& file);

// Chooses a point from the file of --sweep-results by quality.budget_ms and quality.max_error, sets `settings` to it,
// except for keys of --set, and prints the choice on stderr. Warns if the sweep is of another scene or size. Returns
// nothing without bounds, or without a sweep after a warning. Throws UsageError for bounds of --set without a sweep
// (the command demo only warns), InputError for a file that is not a sweep's.
std::optional<QualityChoice> chooseQuality(const Options& options, const std::filesystem::path& scene,
                                           Settings& settings);

// Returns every setting that a point's figures depend on, with its value at the point.
std::vector<SettingChange> settingsOfPoint(const SweepResults& results, int point);
bool isAtPoint(const Settings& settings, const std::vector<SettingChange>& point);

// Sets settings to those of a point. Keys listed in `kept` stay, with a warning where they differ. Throws InputError
// with the message of setSetting().
void applyPoint(const SweepResults& results, int point, const std::set<std::string>& kept, Settings& settings);

}  // namespace speculum
