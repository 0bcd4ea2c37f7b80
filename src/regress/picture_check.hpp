#pragma once

#include <optional>

#include "compare/picture_agreement.hpp"
#include "compare/plane.hpp"
#include "regress/case_file.hpp"
#include "regress/outcome.hpp"

namespace speculum {

// Result of comparing a picture with the expected one.
struct PictureCheck {
  PictureAgreement agreement;
  std::vector<OutcomeFigure> figures;
  std::optional<Plane2d> flip;         // error of each pixel, if there is a limit on FLIP
  std::optional<std::string> problem;  // first limit that is exceeded, as a sentence
};

// Compares a picture with the expected one by the case's tolerance. Throws std::runtime_error when sizes differ, also
// that of the mask.
PictureCheck checkPicture(const Image8& expected, const Image8& actual, const RegressCase& subject);

// Names of the files of a case in the report's folder.
struct CaseFiles {
  CaseFiles(const std::filesystem::path& folder, const std::string& name);
  std::filesystem::path expected;
  std::filesystem::path actual;
  std::filesystem::path difference;
  std::filesystem::path flip;
  std::vector<std::filesystem::path> all() const { return {expected, actual, difference, flip}; }
};

// Compares the pictures and fills figures, verdict and message of the outcome. Writes the pictures unless the case
// passes.
void judge(const Image8& expected, const Image8& actual, const RegressCase& subject, const CaseFiles& files,
           Outcome& outcome);

// Turns an expected failure into a success, and a success into a failure where a failure is expected.
void applyExpectation(const ExpectedCase& expected, Outcome& outcome);

}  // namespace speculum
