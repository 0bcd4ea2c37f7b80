#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "accuracy/sweep_results.hpp"
#include "settings/settings.hpp"

namespace speculum {

// Settings by key, each with several values.
using SettingGrid = std::vector<std::pair<std::string, std::vector<std::string>>>;

// Returns every combination of one value for each setting, the last setting varying fastest; nothing if there are more
// than `most`.
std::optional<std::vector<std::vector<SettingChange>>> combinations(const SettingGrid& grid, size_t most);

struct SweepConfiguration {
  std::string name;
  std::vector<SettingChange> changes;  // settings that differ from the base
};

struct SweepPlan {
  static constexpr int leastRepeats = 15;

  std::string name;
  int repeats = leastRepeats;                      // timed frames of each configuration
  std::vector<SweepConfiguration> configurations;  // the first has the base settings
  std::vector<SweepSeries> series;                 // not measured yet; points are indices into `configurations`
};

// Base settings, scene and device that a sweep is planned for.
struct SweepContext {
  Settings base;
  std::vector<int> sampleCounts{1, 4};  // supported by the device
  bool mirrors = true;                  // the scene has mirrors
  bool animated = false;                // something moves
  bool rough = false;                   // a mirror is rough
  bool motion = false;                  // a movement is measured, so quality.motion_ms can vary too
  int interval = 1;                     // frames; the longest update interval of all mirrors
  std::vector<std::string> effects{};   // switches of the effects that the scene uses, such as effects.shadows
};

// Collects configurations, each once.
class SweepPlanner {
 public:
  using Changes = std::vector<SettingChange>;

  SweepPlanner(std::string name, const SweepContext& context);

  // Adds a configuration, unless one with the same settings exists, and returns its index. Throws std::invalid_argument
  // with the message of setSetting().
  int add(const Changes& changes, const std::string& name = {});
  // Adds a configuration for each combination of values. Throws like add().
  void grid(const SettingGrid& axes);
  // Adds one configuration for each value, with the changes `fixed`, and the series of them. Leaves series of fewer
  // than two different configurations out.
  void series(SweepSeries series, const std::vector<std::string>& values, const Changes& fixed);
  // Adds one configuration for each value, with its changes in `each`, and the series of them.
  void series(SweepSeries series, const std::vector<std::string>& values, const std::vector<Changes>& each);

  SweepPlan plan;

 private:
  Settings base_;
  bool motion_ = false;
};

// Returns the changes of `first`, then those of `second`.
SweepPlanner::Changes joined(SweepPlanner::Changes first, const SweepPlanner::Changes& second);

// Returns the base settings with a configuration's changes. Throws std::invalid_argument with the message of
// setSetting().
Settings settingsWith(const Settings& base, const std::vector<SettingChange>& changes);

// Returns the built-in sweep "quick" or "full", or "motion" if one is measured, or reads `wanted` as a file with
// readSweepPlan().
SweepPlan sweepPlan(const std::string& wanted, const SweepContext& context);

// Reads a sweep from a TOML file such as examples/sweep.toml. Configurations with equal settings are one. Throws
// InputError with FILE:LINE.
SweepPlan readSweepPlan(const std::filesystem::path& file, const SweepContext& context);

// Plans a dozen configurations for the front of one view, without series.
SweepPlan viewSweep(const SweepContext& context);

}  // namespace speculum
