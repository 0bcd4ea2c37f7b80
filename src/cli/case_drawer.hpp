#pragma once

#include <memory>
#include <optional>

#include "regress/case_file.hpp"
#include "regress/outcome.hpp"
#include "session/session.hpp"

namespace speculum {

// Options with which `render` draws the case, over those of `common`.
Options caseOptions(const RegressCase& subject, const Options& common);

// Draws cases of `regress` and compares them. Uses one device, and one session while scene and size stay the same.
class CaseDrawer {
 public:
  explicit CaseDrawer(const Options& options) : options_(options) {}

  // Draws the case options.regress.repeat times. Everything that goes wrong is in the outcome.
  Outcome outcomeOf(const RegressCase& subject);

 private:
  // Says whether there was an expected picture to compare with.
  bool drawAndJudge(const ExpectedCase& expected, Outcome& outcome);
  Image8 draw(const RegressCase& subject, Outcome& outcome);

  const Options& options_;
  std::optional<Device> device_;
  std::unique_ptr<Session> session_;
  int countedMessages_ = 0;  // of the validation layer
};

}  // namespace speculum
