#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "accuracy/report.hpp"
#include "accuracy/sweep_json.hpp"
#include "cli/commands.hpp"
#include "cli/stats.hpp"
#include "platform/process.hpp"
#include "platform/text.hpp"
#include "session/output_files.hpp"
#include "window/paced_subject.hpp"

namespace speculum {

namespace {

void writeReport(const Options& options, SweepResults& results, const std::string& folder) {
  const auto inFolder = [&](std::string& file) { file = folder + "/" + file; };
  for (SweepPoint& point : results.points) {
    inFolder(point.picture);
    inFolder(point.heatMap);
    std::ranges::for_each(point.frames, inFolder);
  }
  inFolder(results.truthPicture);
  std::ranges::for_each(results.truthFrames, inFolder);
  writeJson(options.out / "results.json", sweepJson(results));
  writeText(options.out / "results.csv", sweepCsv(results));
  writeText(options.out / "index.html", reportHtml(results, options.out));
}

void printFront(const SweepResults& results) {
  const auto flicker = [&](const std::optional<double>& value) {
    return results.motion ? fmt::format(" {:>10.5f}", value.value_or(0.0)) : "";
  };
  printLine(fmt::format("{:>10} {:>10} {:>10}{}  {}", "GPU ms", "mean FLIP", "RMSE",
                        results.motion ? "    flicker" : "", results.motion ? "cheapest first" : "on the front"));
  // A movement has two fronts, of error and of flicker. The list has all of its points, not those of one front.
  for (const int index : results.motion ? indicesByCost(results.points) : paretoFront(results.points)) {
    const SweepPoint& point = results.points[index];
    printLine(fmt::format("{:>10.3f} {:>10.5f} {:>10.5f}{}  {}", costMs(point), point.whole.flip, point.whole.rmse,
                          flicker(point.flicker), point.name));
  }
  printLine(fmt::format("{:>10.0f} {:>10.5f} {:>10.5f}{}  reference (and its noise floor)", results.truthMs,
                        results.floor.whole.flip, results.floor.whole.rmse, flicker(results.floor.flicker)));
}

}  // namespace

int runAccuracy(const Options& options) {
  Session session(options);
  const bool moving = !options.motion.empty();
  const MotionPath path = moving ? motionPath(options, session.scene()) : MotionPath{.start = options.time};
  SweepContext context = sweepContext(session);
  context.motion = moving;
  const SweepPlan plan = sweepPlan(options.sweep, context);
  const std::shared_ptr<const void> lock = claimFolder(options.out);
  const std::string folder = "measurements";
  SweepStore store(options.out / folder);
  PacedSubject subject(session, path);
  SweepScene scene{.scene = session.scene(),
                   .stateOf = [&](int frame) { return stateOf(session.scene(), path, frame); },
                   .frames = path.frames,
                   .truth = {.width = options.size.width, .height = options.size.height},
                   .identity = sweepIdentity(session, options)};
  if (options.sweep == "quick" || moving) {
    scene.truth.samples = 64;
    scene.truth.lattice = true;
    scene.truth.floorSamples = 81;
  }
  SweepResults results = describeSweep(session, plan, options.time);
  if (moving) {
    results.motion = {.path = options.motion, .frames = path.frames, .fps = path.fps};
  }
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
    printLine("To go on, run the same command again.", stderr);
    return 1;
  }
  writeReport(options, results, folder);
  printFront(results);
  printLine((options.out / "index.html").string());
  session.finish();
  return session.exitCode();
}

}  // namespace speculum
