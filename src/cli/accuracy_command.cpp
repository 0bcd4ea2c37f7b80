#include <spdlog/fmt/fmt.h>

#include <nlohmann/json.hpp>

#include "accuracy/report.hpp"
#include "accuracy/sweep_json.hpp"
#include "cli/commands.hpp"
#include "cli/progress.hpp"
#include "cli/stats.hpp"
#include "platform/process.hpp"
#include "platform/text.hpp"
#include "session/session_subject.hpp"

namespace speculum {

namespace {

void writeReport(const Options& options, SweepResults& results, const std::string& folder) {
  for (SweepPoint& point : results.points) {
    point.picture = folder + "/" + point.picture;
    point.heatMap = folder + "/" + point.heatMap;
  }
  results.truthPicture = folder + "/" + results.truthPicture;
  writeJson(options.out / "results.json", sweepJson(results));
  writeText(options.out / "results.csv", sweepCsv(results));
  writeText(options.out / "index.html", reportHtml(results, options.out));
}

void printFront(const SweepResults& results) {
  printLine(fmt::format("{:<44} {:>10} {:>10} {:>10}", "on the front", "GPU ms", "mean FLIP", "RMSE"));
  for (const int index : paretoFront(results.points)) {
    const SweepPoint& point = results.points[index];
    printLine(fmt::format("{:<44} {:>10.3f} {:>10.5f} {:>10.5f}", point.name, costMs(point), point.whole.flip,
                          point.whole.rmse));
  }
  printLine(fmt::format("{:<44} {:>10.0f} {:>10.5f} {:>10.5f}", "reference (and its noise floor)", results.truthMs,
                        results.floor.whole.flip, results.floor.whole.rmse));
}

}  // namespace

int runAccuracy(const Options& options) {
  Session session(options);
  const SceneState state = evaluate(session.scene(), options.time);
  const SweepContext context = sweepContext(session);
  const SweepPlan plan = sweepPlan(options.sweep, context);
  const std::string folder = "measurements";
  SweepStore store(options.out / folder);
  SessionSubject subject(session, options.time);
  SweepScene scene{.scene = session.scene(),
                   .state = state,
                   .width = options.size.width,
                   .height = options.size.height,
                   .identity = sweepIdentity(session, options)};
  if (options.sweep == "quick") {
    scene.truthSamples = 64;
    scene.lattice = true;
    scene.floorSamples = 81;
  }
  SweepResults results = describeSweep(session, plan, options.time);
  installInterruptHandler();
  std::string stage;
  std::optional<Progress> progress;  // a bar for each stage, one after the other
  const auto show = [&](const SweepStatus& status) {
    if (!progress || stage != status.stage) {
      stage = status.stage;
      progress.reset();  // ends its line before the next one begins
      progress.emplace("accuracy, " + stage, 1.0);
    }
    return progress->set(status.fraction);
  };
  if (!runSweep(plan, context.base, scene, subject, store, results, show)) {
    printLine("interrupted; the same command goes on from here", stderr);
    return 1;
  }
  writeReport(options, results, folder);
  printFront(results);
  printLine((options.out / "index.html").string());
  session.finish();
  return session.exitCode();
}

}  // namespace speculum
