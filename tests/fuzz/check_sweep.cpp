#include <nlohmann/json.hpp>

#include "accuracy/sweep_json.hpp"
#include "accuracy/sweep_planner.hpp"
#include "accuracy/sweep_store.hpp"
#include "fuzz_support.hpp"
#include "image/picture_files.hpp"

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

// Reads the text as the measurements and as the reference of a sweep's cache. Says whether it was either.
bool readsCache(const TemporaryFolder& folder, std::string_view text) {
  [[maybe_unused]] static const bool written = [&] {
    writeExr(folder / "truth-a.exr", LinearImage(2, 2));
    writePng(folder / "truth-a-mirrors.png", Image8(2, 2));
    writePng(folder / "truth-a-second.png", Image8(2, 2));
    return true;
  }();
  folder.write("truth-a.json", text);
  const std::filesystem::path measurements = folder.write("measurements.json", text);
  const SweepStore store(folder.path());
  store.save();
  const std::string once = readText(measurements);
  SweepStore(folder.path()).save();
  require(readText(measurements) == once, "what was written can be read");
  return store.truth("a") || once.size() > std::string_view("null").size();
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
  return readsCache(folder, text) || isResults || isPlan;
}

}  // namespace speculum::fuzz
