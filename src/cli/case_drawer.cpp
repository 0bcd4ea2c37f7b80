#include "cli/case_drawer.hpp"

#include <spdlog/fmt/fmt.h>

#include "cli/commands.hpp"
#include "image/picture_files.hpp"

namespace speculum {

namespace {

// Adds the result of a check that failed `count` times. The first check that fails gives the outcome's message.
void addCheck(Outcome& outcome, const std::string& label, uint64_t count, const std::string& detail = {}) {
  if (count > 0) {
    outcome.figures.push_back({label, std::to_string(count), "0", true});
    if (outcome.verdict == Verdict::passed) {
      outcome.verdict = Verdict::failed;
      outcome.message = std::to_string(count) + " " + label + (detail.empty() ? "" : ", first " + detail);
    }
  }
}

}  // namespace

Options caseOptions(const RegressCase& subject, const Options& common) {
  Options options = common;
  options.scene = subject.scene.string();
  options.strict = common.strict || subject.strict;
  options.size = subject.size;
  options.settings = subject.settings;
  options.settings.insert(options.settings.end(), common.settings.begin(), common.settings.end());
  if (subject.camera) {
    setCamera(options, *subject.camera);
    options.cameraPlace = subject.cameraPlace;
  }
  return options;
}

Outcome CaseDrawer::outcomeOf(const RegressCase& subject) {
  Outcome outcome;
  try {
    if (!device_) {
      device_.emplace(deviceOptions(options_, nullptr));
    }
    outcome.device = device_->info().name;
    outcome.driver = device_->info().driver;
    const ExpectedCase expected = expectedOf(subject, outcome.driver);
    outcome.picture = expected.subject.picture.string();
    if (expected.result == ExpectedResult::skip) {
      outcome.verdict = Verdict::skipped;
      outcome.message = expected.reason;
    } else if (drawAndJudge(expected, outcome)) {
      applyExpectation(expected, outcome);
    }
  } catch (const std::exception& error) {
    outcome.verdict = Verdict::error;
    outcome.message = error.what();
    outcome.replaceable = false;
    session_.reset();
    device_.reset();
    countedMessages_ = 0;
  }
  return outcome;
}

bool CaseDrawer::drawAndJudge(const ExpectedCase& expected, Outcome& outcome) {
  RegressCase subject = expected.subject;
  const CaseFiles files(options_.out, subject.name);
  const Image8 actual = draw(subject, outcome);
  for (int i = 1; i < options_.regress.repeat; ++i) {
    const Image8 again = draw(subject, outcome);
    if (again.rgba != actual.rgba) {
      // Compares two pictures of this driver byte for byte, whatever tolerance the case has.
      subject.mask.reset();
      subject.tolerance = {.maxDiff = 0, .share = 0.0, .block = false};
      outcome.verdict = Verdict::failed;
      outcome.message = fmt::format("not deterministic: picture {} differs from the first", i + 1);
      outcome.picture = "first picture of this run";
      judge(actual, again, subject, files, outcome);
      return false;
    }
  }
  std::optional<Image8> picture;
  std::error_code none;
  if (std::filesystem::exists(subject.picture, none)) {  // reading refuses a pipe or folder
    picture = readImage8(subject.picture);
  }
  if (!picture || picture->width != actual.width || picture->height != actual.height) {
    outcome.verdict = Verdict::failed;
    outcome.replaceable = outcome.figures.empty() && expected.result == ExpectedResult::pass;
    outcome.message = !picture ? "there is no expected picture " + subject.picture.string()
                               : fmt::format("{} is {}x{}, the picture {}x{}", subject.picture.string(), picture->width,
                                             picture->height, actual.width, actual.height);
    outcome.message += expected.result != ExpectedResult::pass ? " (make it where the case passes)"
                       : !outcome.replaceable                  ? ""
                       : !picture                              ? " (--update writes it)"
                                                               : " (--update replaces it)";
    outcome.hasFiles = true;
    writePng(files.actual, actual);
    return false;
  }
  judge(*picture, actual, subject, files, outcome);
  return true;
}

Image8 CaseDrawer::draw(const RegressCase& subject, Outcome& outcome) {
  const Options options = caseOptions(subject, options_);
  if (!session_ || session_->scene().file != subject.scene || session_->size() != subject.size) {
    session_.reset();
    session_ = std::make_unique<Session>(options, &*device_);
    session_->showOnly();
  } else if (options.strict) {
    requireNoDefects(session_->scene());
  }
  Session& session = *session_;
  const uint64_t nonFinite = session.sceneRenderer().finiteWatch().count();
  session.setCamera(cameraOf(options, session.scene()));
  session.setSettings(settingsOf(session.scene(), options));
  session.restart();
  session.draw(subject.time, true);
  session.finish();
  Image8 picture = session.picture();
  const FiniteWatch& watch = session.sceneRenderer().finiteWatch();
  const uint64_t found = watch.count() - nonFinite;
  addCheck(outcome, "values that are not finite", found, found > 0 ? describe(watch.findings().front()) : "");
  // Counts messages since the last case, or since the device was made.
  const int messages = device_->validationMessages();
  addCheck(outcome, "validation messages", static_cast<uint64_t>(messages - std::exchange(countedMessages_, messages)));
  return picture;
}

}  // namespace speculum
