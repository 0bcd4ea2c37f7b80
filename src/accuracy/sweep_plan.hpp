#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "accuracy/sweep_results.hpp"
#include "frame/settings.hpp"

namespace speculum {

struct SweepConfiguration {
  std::string name;
  std::vector<SettingChange> changes;  // from the base settings, those that change something
};

// A series of SweepResults before it is measured.
struct PlannedSeries {
  // What theory says of the slope; `depth` takes it from the mirrors that the scene shows.
  enum class Theory { none, fixed, depth };

  SweepSeries series;  // key, name, axis, x, points (indices into SweepPlan::configurations), note, theorySlope
  Theory theory = Theory::none;
  double fitUpTo = std::numeric_limits<double>::infinity();  // x; what lies beyond follows another law
};

struct SweepPlan {
  static constexpr int leastRepeats = 15;

  std::string name;
  int repeats = leastRepeats;                      // timed frames of each configuration
  std::vector<SweepConfiguration> configurations;  // the first is the base itself
  std::vector<PlannedSeries> series;
};

// What a sweep is for.
struct SweepContext {
  Settings base;
  std::vector<int> sampleCounts{1, 4};  // that the device has
  bool mirrors = true;                  // the scene has mirrors
  bool animated = false;                // something moves
  bool rough = false;                   // a mirror is rough
  std::vector<std::string> effects{};   // switches, such as effects.shadows, of those that the scene asks for
};

// The built-in sweeps "quick" and "full", or a TOML file:
//
//     repeats = 15                                # 15 or more
//     [[configuration]]
//     name     = "cheap"
//     settings = { "reflection.scale" = 0.5, "reflection.samples" = 1 }
//     [[grid]]                                    # every combination
//     settings = { "reflection.scale" = [0.5, 1], "reflection.max_depth" = [1, 2, 4] }
//     [[series]]                                  # a convergence plot
//     key      = "reflection.scale"
//     values   = [0.25, 0.5, 1]
//     axis     = "logarithmic"                    # or "linear"; of the setting
//     theory   = -0.5                             # optional: slope of log(RMSE) along the axis
//     note     = "why"                            # optional
//     settings = { "view.samples" = 4 }           # optional: the same for all
//
// Configurations with equal settings are one. Throws InputError with FILE:LINE.
SweepPlan sweepPlan(const std::string& wanted, const SweepContext& context);
// A dozen configurations for the front of one view, without series.
SweepPlan viewSweep(const SweepContext& context);
SweepPlan readSweepPlan(const std::filesystem::path& file, const SweepContext& context);

// Collects configurations, each once.
class SweepPlanner {
 public:
  using Changes = std::vector<SettingChange>;

  SweepPlanner(std::string name, const SweepContext& context);

  // Index of the configuration; an earlier one with the same settings is found again. Throws std::invalid_argument with
  // what setSetting says.
  int add(const Changes& changes, const std::string& name = {});
  void grid(const std::vector<std::pair<std::string, std::vector<std::string>>>& axes);
  // One configuration for each value. Series of less than two different configurations are left out.
  void series(PlannedSeries planned, const std::vector<std::string>& values, const Changes& fixed);
  // The same with all changes of each value given.
  void series(PlannedSeries planned, const std::vector<std::string>& values, const std::vector<Changes>& each);

  SweepPlan plan;

 private:
  Settings base_;
};

// Base settings with a configuration's changes. Throws std::invalid_argument with what setSetting says.
Settings settingsWith(const Settings& base, const std::vector<SettingChange>& changes);

}  // namespace speculum
