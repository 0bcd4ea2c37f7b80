#include <cstdio>
#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>

#include "accuracy/fingerprint.hpp"
#include "accuracy/report.hpp"
#include "app/commands.hpp"
#include "app/progress.hpp"
#include "app/session_subject.hpp"
#include "app/stats.hpp"
#include "app/version.hpp"
#include "core/platform.hpp"

namespace speculum {

namespace {

namespace fs = std::filesystem;

void addFile(Fingerprint& fingerprint, const fs::path& file) {
  if (const std::optional<std::vector<uint8_t>> bytes = readFile(file)) {
    fingerprint.add(std::as_bytes(std::span(*bytes)));
  }
}

// Another build, other shaders, another driver: everything is measured again.
std::string identity(Session& session, double time) {
  Fingerprint fingerprint;
  addFile(fingerprint, executablePath());
  std::vector<fs::path> shaders;
  for (const auto& entry : fs::directory_iterator(dataDirectory("shaders"))) {
    shaders.push_back(entry.path());
  }
  std::sort(shaders.begin(), shaders.end());
  for (const fs::path& shader : shaders) {
    addFile(fingerprint, shader);
  }
  addScene(fingerprint, session.scene());
  const Device& device = session.device();
  for (const std::string& text : {device.info().name, device.info().driver, machineDescription(),
                                  std::string(renderPathName(device.renderPath()))}) {
    fingerprint.add(text);
  }
  fingerprint.add(session.size().width);
  fingerprint.add(session.size().height);
  fingerprint.add(time);
  return fingerprint.hex();
}

std::string utcNow() {
  const std::time_t now = std::time(nullptr);
  char text[32];
  std::strftime(text, sizeof(text), "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&now));
  return text;
}

SweepResults describe(const Options& options, Session& session) {
  const Device& device = session.device();
  SweepResults results{.scene = session.scene().file.filename().string(),
                       .title = session.scene().title,
                       .time = options.time,
                       .device = device.info().name,
                       .driver = device.info().driver,
                       .renderPath = std::string(renderPathName(device.renderPath())),
                       .machine = machineDescription(),
                       .version = versionString,
                       .date = utcNow()};
  for (const SettingInfo& info : settingInfos()) {
    const std::string value = settingValue(session.settings(), info.key);
    if (!value.empty()) {
      results.base.push_back({std::string(info.key), value});
    }
  }
  return results;
}

// A bar for each stage, one after the other.
class StageProgress {
 public:
  bool operator()(const SweepStatus& status) {
    if (!progress_ || stage_ != status.stage) {
      stage_ = status.stage;
      progress_.reset();
      progress_ = std::make_unique<Progress>("accuracy, " + stage_, 1.0);
    }
    progress_->set(status.fraction);
    return !interruptRequested();
  }

 private:
  std::string stage_;
  std::unique_ptr<Progress> progress_;
};

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
  std::printf("%-44s %10.0f %10.5f %10.5f\n", "ground truth (and its noise floor)", results.truthMs,
              results.floorWhole.flip, results.floorWhole.rmse);
}

}  // namespace

int runAccuracy(const Options& options) {
  Session session(options);
  const SceneState state = evaluate(session.scene(), options.time);
  const SweepContext context{.base = session.settings(),
                             .sampleCounts = sampleCountsOf(session.device()),
                             .mirrors = !session.scene().mirrors.empty(),
                             .animated = moves(session.scene())};
  const SweepPlan plan = sweepPlan(options.sweep, context);
  const std::string folder = "measurements";
  SweepStore store(options.out / folder);
  SessionSubject subject(session, options.time);
  const SweepScene scene{.scene = session.scene(),
                         .state = state,
                         .width = options.size.width,
                         .height = options.size.height,
                         .identity = identity(session, options.time)};
  SweepResults results = describe(options, session);
  results.sweep = plan.name;
  installInterruptHandler();
  StageProgress progress;
  if (!runSweep(plan, context.base, scene, subject, store, results, std::ref(progress))) {
    std::fprintf(stderr, "interrupted; the same command goes on from here\n");
    return 1;
  }
  writeReport(options, results, folder);
  printFront(results);
  std::printf("%s\n", (options.out / "index.html").c_str());
  const int messages = session.device().validationMessages();
  if (messages > 0) {
    std::fprintf(stderr, "%d validation messages\n", messages);
  }
  return messages > 0 ? 1 : 0;
}

}  // namespace speculum
