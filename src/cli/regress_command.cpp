#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <set>
#include <thread>

#include "cli/case_drawer.hpp"
#include "cli/commands.hpp"
#include "cli/stats.hpp"
#include "platform/files.hpp"
#include "platform/process.hpp"
#include "platform/text.hpp"
#include "regress/picture_check.hpp"
#include "regress/report_page.hpp"
#include "regress/worker_pool.hpp"
#include "scene/scene_loader.hpp"
#include "session/options.hpp"
#include "session/output_files.hpp"
#include "session/session_subject.hpp"
#include "session/version.hpp"

namespace speculum {

namespace {

constexpr int usualWorkers = 4;

std::vector<RegressCase> selectedCases(std::vector<RegressCase> cases, const Options& options) {
  const auto requireMatch = [&](const std::string& option, const std::string& glob) {
    if (std::ranges::none_of(cases, [&](const RegressCase& one) { return matchesGlob(glob, one.name); })) {
      throw UsageError(fmt::format("{}: no case of {} has a name like '{}' (* stands for any text)", option,
                                   options.regress.cases.string(), glob));
    }
  };
  requireMatch("--filter", options.regress.filter);
  std::erase_if(cases, [&](const RegressCase& subject) { return !matchesGlob(options.regress.filter, subject.name); });
  if (options.regress.update) {
    requireMatch("--update", *options.regress.update);
  }
  return cases;
}

// Draws the cases whose indices come on standard input, and answers each with its outcome.
int runWorker(const Options& options, const std::vector<RegressCase>& cases) {
  CaseDrawer drawer(options);
  for (std::string line; std::getline(std::cin, line);) {
    const nlohmann::json outcome = drawer.outcomeOf(cases.at(std::stoul(line)));
    // Starts on a new line, because a driver may have printed part of one.
    std::printf("\n%s%s\n", std::string(workerReplyMark).c_str(),
                outcome.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
    std::fflush(stdout);
  }
  return 0;
}

// Words of a shell command. The report's page puts quotes around the words that need them.
using Words = std::vector<std::string>;

void addCommands(const RegressCase& subject, const Options& options, const std::string& picture, Outcome& outcome) {
  Words& draw = outcome.drawCommand;
  draw = {"speculum", "render",
          "--scene",  subject.scene.string(),
          "--size",   fmt::format("{}x{}", subject.size.width, subject.size.height)};
  if (subject.time != 0.0) {
    draw.insert(draw.end(), {"--time", fmt::format("{}", subject.time)});
  }
  if (subject.camera) {
    draw.insert(draw.end(), {"--camera", *subject.camera});
  }
  addSettings(subject.settings, draw);
  Words given;  // options of this run that change pictures
  addSettings(options.settings, given);
  addDevice(options, given);
  if (options.validation) {
    given.push_back("--validation");
  }
  draw.insert(draw.end(), given.begin(), given.end());
  draw.insert(draw.end(), {"--out", picture});
  if (outcome.replaceable) {
    Words& accept = outcome.acceptCommand;
    // Writes into another folder, to keep the report that this command stands in.
    accept = {"speculum", "regress",   options.regress.cases.string(), "--out", (options.out / "accepted").string(),
              "--filter", subject.name};
    accept.insert(accept.end(), given.begin(), given.end());
    accept.push_back("--update");
  }
}

Outcome outcomeOf(const WorkerReply& reply, const RegressCase& subject, int repeat) {
  Outcome outcome;
  if (reply.end == JobEnd::answered) {
    outcome = nlohmann::json::parse(reply.text).get<Outcome>();
  } else {
    outcome.verdict = Verdict::error;
    outcome.message =
        reply.end == JobEnd::crashed ? reply.text : fmt::format("no picture within {} s", subject.timeout * repeat);
  }
  outcome.seconds = reply.seconds;
  outcome.log = reply.log;
  return outcome;
}

// Returns the expected picture's file. Outcome::picture is only for messages: JSON replaces bytes that are not UTF-8.
std::filesystem::path pictureOf(const RegressCase& subject, const Outcome& outcome) {
  return expectedOf(subject, outcome.driver).subject.picture;
}

// Lets only one of the cases that share an expected picture replace it: the first one in the file of cases, even if
// this run does not draw that case.
void requireWriter(const std::vector<RegressCase>& cases, const RegressCase& subject, Outcome& outcome) {
  if (!outcome.replaceable) {
    return;
  }
  const std::filesystem::path picture = withoutLinks(pictureOf(subject, outcome));
  const auto writer = std::ranges::find_if(cases, [&](const RegressCase& one) {
    const ExpectedCase expected = expectedOf(one, outcome.driver);
    return expected.result == ExpectedResult::pass && withoutLinks(expected.subject.picture) == picture;
  });
  if (writer->name != subject.name) {
    outcome.replaceable = false;
    outcome.message += fmt::format("; case '{}' writes this picture", writer->name);
  }
}

// Replaces the expected pictures of failed cases whose names match --update with the pictures just drawn, but replaces
// no file of `drawn`.
void acceptAll(const Options& options, UsedFiles& drawn, RegressRun& run) {
  for (size_t i = 0; i < run.cases.size(); ++i) {
    Outcome& outcome = run.outcomes[i];
    const std::string& name = run.cases[i].name;
    if (!outcome.replaceable || !matchesGlob(*options.regress.update, name)) {
      continue;
    }
    try {
      const std::filesystem::path picture = pictureOf(run.cases[i], outcome);
      drawn.requireUnused("--update", picture);
      std::error_code ignored;
      std::filesystem::create_directories(picture.parent_path(), ignored);
      replaceFile(picture, readFile(CaseFiles(options.out, name).actual));
      outcome.verdict = Verdict::updated;
      outcome.message = "wrote " + picture.string();
    } catch (const std::exception& error) {
      outcome.verdict = Verdict::error;
      outcome.message = error.what();
    }
  }
}

void writeReports(const Options& options, const RegressRun& run) {
  writeText(options.out / "index.html", regressHtml(run, options.out));
  if (!options.regress.junit.empty()) {
    writeText(options.regress.junit, junitXml(run));
  }
  if (environment("GITHUB_ACTIONS") == "true") {
    std::fputs(githubErrors(run).c_str(), besideOutput(options.regress.junit));
  }
  if (const std::string file = environment("GITHUB_STEP_SUMMARY"); !file.empty()) {
    // Other steps add to this file as well, so it is not replaced.
    std::ofstream stream;
    if (!std::filesystem::is_fifo(std::filesystem::path(file))) {  // opening a pipe might wait for a reader
      stream.open(file, std::ios::app);
    }
    if (!stream.is_open() || !(stream << githubSummary(run)).flush()) {
      throw FileError(file, "cannot be written", "check the folder's permissions and free space");
    }
  }
}

void printOutcomes(std::FILE* to, const RegressRun& run, const std::filesystem::path& page) {
  for (size_t i = 0; i < run.cases.size(); ++i) {
    const Outcome& outcome = run.outcomes[i];
    if (!outcome.message.empty()) {
      printLine(fmt::format("{:<7} {}: {}", verdictName(outcome.verdict), run.cases[i].name, outcome.message), to);
    }
  }
  printLine(summary(run) + "; " + page.string(), to);
}

// Returns the pictures that a case is compared with.
std::vector<std::filesystem::path> picturesOf(const RegressCase& subject) {
  std::vector<std::filesystem::path> pictures{subject.picture};
  for (const Expectation& expectation : subject.expect) {
    if (expectation.picture) {
      pictures.push_back(*expectation.picture);
    }
  }
  return pictures;
}

// The files of all cases, also of those that this run does not draw.
struct FilesOfCases {
  explicit FilesOfCases(const Options& options, const std::vector<RegressCase>& cases) {
    drawn.add("the file of cases", options.regress.cases);
    std::set<std::filesystem::path> scenes;
    for (const RegressCase& subject : cases) {
      const std::filesystem::path mask = subject.mask.value_or("");
      masks.add(fmt::format("the mask of case '{}'", subject.name), mask);
      add(fmt::format("a file of case '{}'", subject.name), mask);
      for (const std::filesystem::path& picture : picturesOf(subject)) {
        add(fmt::format("a file of case '{}'", subject.name), picture);
      }
      for (const std::filesystem::path& file :
           scenes.insert(subject.scene).second ? filesNamedBy(subject.scene) : std::set<std::filesystem::path>()) {
        drawn.add(fmt::format("a file that case '{}' draws", subject.name), file);
        add(fmt::format("a file of case '{}'", subject.name), file);
      }
    }
  }

  // Returns a name for a picture of the case that none of the files has, wherever the picture is written.
  std::string newPicture(const RegressCase& subject) {
    std::string name = subject.name;
    do {
      name += ".again";
    } while (!names.insert(name + ".png").second);
    return name + ".png";
  }

  UsedFiles drawn;  // files that scenes are drawn from, and the file of cases
  UsedFiles masks;
  UsedFiles all;
  std::set<std::filesystem::path> names;  // without folders

 private:
  void add(std::string_view words, const std::filesystem::path& file) {
    all.add(words, file);
    names.insert(file.filename());
  }
};

// Refuses to replace files that cases read with those of the report, and masks with updated pictures.
void requireFilesOfItsOwn(const Options& options, const std::vector<RegressCase>& drawn, FilesOfCases& files) {
  std::vector<std::filesystem::path> report{options.out / "index.html"};
  for (const RegressCase& subject : drawn) {
    if (options.regress.update && matchesGlob(*options.regress.update, subject.name)) {
      for (const std::filesystem::path& picture : picturesOf(subject)) {
        files.masks.requireUnused("--update", picture);
      }
    }
    const std::vector<std::filesystem::path> pictures = CaseFiles(options.out, subject.name).all();
    report.insert(report.end(), pictures.begin(), pictures.end());
  }
  for (const std::filesystem::path& file : report) {
    files.all.requireUnused("--out", file);
    files.all.add("a file of the report", file);
  }
  if (!options.regress.junit.empty()) {
    files.all.requireUnused("--junit", options.regress.junit);
  }
}

}  // namespace

int runRegress(const Options& options) {
  const std::vector<RegressCase> cases = readCases(options.regress.cases);
  RegressRun run{.file = options.regress.cases,
                 .cases = selectedCases(cases, options),
                 .command = {"speculum"},
                 .version = versionString,
                 .date = utcNow()};
  if (options.regress.worker) {
    return runWorker(options, run.cases);
  }
  run.command.insert(run.command.end(), options.arguments.begin(), options.arguments.end());
  const std::shared_ptr<const void> lock = claimFolder(options.out);
  FilesOfCases files(options, cases);
  requireFilesOfItsOwn(options, run.cases, files);
  std::vector<WorkerJob> jobs;
  for (size_t i = 0; i < run.cases.size(); ++i) {
    const RegressCase& subject = run.cases[i];
    jobs.push_back({std::to_string(i),
                    fmt::format("{} {}x{}", subject.scene.string(), subject.size.width, subject.size.height),
                    subject.timeout * options.regress.repeat});
    for (const std::filesystem::path& file : CaseFiles(options.out, subject.name).all()) {
      std::error_code ignored;
      std::filesystem::remove(file, ignored);
    }
  }
  run.outcomes.resize(run.cases.size());
  size_t withoutDevice = 0;
  std::vector<std::string> worker{executablePath().string()};
  worker.insert(worker.end(), options.arguments.begin(), options.arguments.end());
  // Behind the command: at the end it might follow a `--`, after which nothing is an option.
  worker.insert(std::ranges::find(worker, options.command) + 1, "--worker");
  const int workers = options.regress.jobs > 0
                          ? options.regress.jobs
                          : std::min(usualWorkers, static_cast<int>(std::thread::hardware_concurrency()));
  installInterruptHandler();
  {
    Progress progress("regress", static_cast<double>(jobs.size()));
    const bool finished = runWorkers(worker, workers, jobs, [&](size_t i, const WorkerReply& reply) {
      const RegressCase& subject = run.cases[i];
      Outcome& outcome = run.outcomes[i];
      try {
        outcome = outcomeOf(reply, subject, options.regress.repeat);
        withoutDevice += reply.end == JobEnd::answered && outcome.device.empty();
        requireWriter(cases, subject, outcome);
      } catch (const std::exception& error) {
        outcome.verdict = Verdict::error;
        outcome.message = error.what();
      }
      addCommands(subject, options, files.newPicture(subject), outcome);
      progress.advance();
    });
    if (!finished) {
      return 1;
    }
  }
  if (withoutDevice > 0 && withoutDevice == run.outcomes.size()) {
    throw std::runtime_error(run.outcomes.front().message);
  }
  if (options.regress.update) {
    acceptAll(options, files.drawn, run);
  }
  printOutcomes(besideOutput(options.regress.junit), run, options.out / "index.html");
  writeReports(options, run);
  if (run.count(Verdict::error) > 0) {
    return 2;
  }
  return run.passed() ? 0 : 1;
}

}  // namespace speculum
