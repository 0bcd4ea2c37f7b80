#pragma once

#include <memory>
#include <optional>

#include "regress/case_file.hpp"
#include "regress/picture_check.hpp"
#include "session/session.hpp"

namespace speculum {

// Returns the options with which `render` draws the case: those of `common`, and over them the case's own.
Options caseOptions(const RegressCase& subject, const Options& common);

// Draws cases of `regress` and compares them. Uses one device, and one session while scene and size stay the same.
class CaseDrawer {
 public:
  explicit CaseDrawer(const Options& options) : options_(options) {}

  // Draws the case options.regress.repeat times. Everything that goes wrong is in the outcome, exceptions too.
  Outcome outcomeOf(const RegressCase& subject);

 private:
  // Draws the case and compares it. Returns false if repeated pictures differ, or if there is no expected picture of
  // the same size.
  bool drawAndJudge(const ExpectedCase& expected, Outcome& outcome);
  Image8 draw(const RegressCase& subject, Outcome& outcome);

  const Options& options_;
  std::optional<Device> device_;
  std::unique_ptr<Session> session_;
  int countedMessages_ = 0;  // validation messages of the device that are in an outcome already
};

}  // namespace speculum
