#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "compare/compared_image.hpp"
#include "compare/picture_agreement.hpp"
#include "regress/case_file.hpp"

namespace speculum {

enum class Verdict { passed, failed, error, skipped, updated };

// A figure beside its limit, as the report shows it.
struct OutcomeFigure {
  std::string label;
  std::string value;
  std::string limit;  // "–" where there is none
  bool over = false;
};

// Result of a case. Workers write an outcome as a line of JSON; the commands are added afterwards.
struct Outcome {
  Verdict verdict = Verdict::passed;
  std::string message;  // one line: why the case did not simply pass
  std::string device;
  std::string driver;
  std::string picture;                     // file of the expected picture
  std::vector<std::string> drawCommand;    // words of the command that draws the case again
  std::vector<std::string> acceptCommand;  // words of the command that replaces the expected picture; none: forbidden
  bool replaceable = false;                // --update may write the expected picture
  bool hasFiles = false;                   // the pictures of the case are beside the report
  double gain = 1.0;                       // factor on differences in the difference picture
  double seconds = 0.0;
  std::vector<int> region;  // left, top, width, height of the largest difference, pixels; empty without one
  std::vector<OutcomeFigure> figures;
  std::vector<std::string> log;  // last lines that the worker wrote
};

NLOHMANN_JSON_SERIALIZE_ENUM(Verdict, {{Verdict::passed, "passed"},
                                       {Verdict::failed, "failed"},
                                       {Verdict::error, "error"},
                                       {Verdict::skipped, "skipped"},
                                       {Verdict::updated, "updated"}})
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(OutcomeFigure, label, value, limit, over)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Outcome, verdict, message, device, driver, picture, drawCommand, acceptCommand,
                                   replaceable, hasFiles, gain, seconds, region, figures, log)

// Returns the name of a verdict, such as "passed".
std::string verdictName(Verdict verdict);

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
