#include <cstdio>
#include <nlohmann/json.hpp>

#include "accuracy/report.hpp"
#include "accuracy/sweep_json.hpp"
#include "app/commands.hpp"
#include "app/progress.hpp"
#include "app/session_subject.hpp"
#include "app/stats.hpp"
#include "platform/process.hpp"

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
  std::printf("%-44s %10s %10s %10s\n", "on the front", "GPU ms", "mean FLIP", "RMSE");
  for (const int index : paretoFront(results.points)) {
    const SweepPoint& point = results.points[index];
    std::printf("%-44s %10.3f %10.5f %10.5f\n", point.name.c_str(), costMs(point), point.whole.flip, point.whole.rmse);
  }
  std::printf("%-44s %10.0f %10.5f %10.5f\n", "reference (and its noise floor)", results.truthMs,
              results.floor.whole.flip, results.floor.whole.rmse);
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
  const SweepScene scene{.scene = session.scene(),
                         .state = state,
                         .width = options.size.width,
                         .height = options.size.height,
                         .identity = sweepIdentity(session, options)};
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
    std::fprintf(stderr, "interrupted; the same command goes on from here\n");
    return 1;
  }
  writeReport(options, results, folder);
  printFront(results);
  std::printf("%s\n", (options.out / "index.html").c_str());
  session.finish();
  return session.exitCode();
}

}  // namespace speculum
