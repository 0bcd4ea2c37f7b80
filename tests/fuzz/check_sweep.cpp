#include <nlohmann/json.hpp>

#include "accuracy/sweep_json.hpp"
#include "accuracy/sweep_plan.hpp"
#include "fuzz_support.hpp"

namespace speculum::fuzz {

namespace {

void checkResults(const SweepResults& results) {
  for (const SweepSeries& series : results.series) {
    require(series.points.size() == series.x.size(), "a series has a value for each point");
    for (const int point : series.points) {
      require(point >= 0 && static_cast<size_t>(point) < results.points.size(), "a series' points are the sweep's");
    }
  }
  // What was read can be written.
  sweepCsv(results);
  sweepJson(results).dump();
}

void checkPlan(const SweepPlan& plan) {
  require(!plan.configurations.empty() && plan.configurations[0].changes.empty(), "the base comes first");
  require(plan.configurations.size() <= 1000 && plan.repeats >= SweepPlan::leastRepeats, "plans keep to their bounds");
  for (const SweepConfiguration& configuration : plan.configurations) {
    settingsWith(Settings(), configuration.changes);
  }
  for (const SweepSeries& series : plan.series) {
    require(series.points.size() == series.x.size() && series.points.size() > 1, "a series has points");
  }
}

}  // namespace

bool checkSweep(std::string_view text) {
  static const TemporaryFolder folder;
  SweepResults results;
  const std::filesystem::path json = folder.write("results.json", text);
  const bool isResults = accepted([&] { results = readSweepResults(json); });
  if (isResults) {
    checkResults(results);
  }
  SweepPlan plan;
  const std::filesystem::path toml = folder.write("sweep.toml", text);
  const bool isPlan = accepted([&] { plan = readSweepPlan(toml, SweepContext()); });
  if (isPlan) {
    checkPlan(plan);
  }
  return isResults || isPlan;
}

}  // namespace speculum::fuzz
