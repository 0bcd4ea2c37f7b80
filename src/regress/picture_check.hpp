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

// Throws std::runtime_error when sizes differ, also that of the mask.
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

// Compares and fills figures, verdict and message of the outcome. Writes the pictures unless the case passes.
void judge(const Image8& expected, const Image8& actual, const RegressCase& subject, const CaseFiles& files,
           Outcome& outcome);

// Turns a failure that is expected into success, and a success where a failure is expected into one.
void applyExpectation(const ExpectedCase& expected, Outcome& outcome);

}  // namespace speculum
