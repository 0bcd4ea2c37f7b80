#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "image/image.hpp"

namespace speculum {

// Bounds on how far a picture may be from the expected one. A member without a value is not given here or, for FLIP, no
// bound.
struct Tolerance {
  std::optional<int> maxDiff;     // 1/255, of the channel that differs most
  std::optional<double> share;    // largest share of the pixels that may be over maxDiff
  std::optional<bool> block;      // true: no 3x3 block may be wholly over maxDiff
  std::optional<double> flip;     // mean
  std::optional<double> flipP99;  // 99th percentile over pixels

  bool operator==(const Tolerance&) const = default;
};
// Returns `base` with the bounds that `changes` gives.
Tolerance merged(const Tolerance& base, const Tolerance& changes);

enum class ExpectedResult { pass, fail, skip };

// Expected result for drivers that match `driver` and `version`.
struct Expectation {
  std::string driver;                  // family, see isOfFamily()
  std::optional<std::string> version;  // range, see isInVersions(); no value: every version
  ExpectedResult result = ExpectedResult::pass;
  std::string reason;                            // why the result is fail or skip
  std::optional<std::filesystem::path> picture;  // expected picture of these drivers; no value: the case's
  Tolerance tolerance;                           // bounds that replace those of the case
};

struct RegressCase {
  std::string name;  // unique; also the name of its files
  int line = 0;      // line of the case's table in the file
  std::filesystem::path scene;
  double time = 0.0;                  // seconds
  std::optional<std::string> camera;  // as --camera takes it
  std::string cameraPlace;            // where it stands, "FILE:LINE: key"
  PictureSize size;
  std::vector<std::pair<std::string, std::string>> settings;  // as --set takes them
  std::optional<std::filesystem::path> mask;
  double timeout = 0.0;           // seconds
  bool strict = false;            // defects of models are errors
  std::filesystem::path picture;  // expected
  Tolerance tolerance;            // all bounds are given, except that those on FLIP may be missing
  std::vector<Expectation> expect;
};

// A case as a driver is expected to draw it: with picture and tolerance of the first expectation that matches the
// driver.
struct ExpectedCase {
  RegressCase subject;
  ExpectedResult result = ExpectedResult::pass;
  std::string reason;
};
// `driver` is the driver's text, as for isOfFamily().
ExpectedCase expectedOf(const RegressCase& subject, const std::string& driver);

// Reads the cases of a TOML file, which docs/regression.md describes. Paths are relative to the file; a scene that is
// not there may be one that comes with the program. Throws InputError.
std::vector<RegressCase> readCases(const std::filesystem::path& file);

// Says whether a driver, such as "llvmpipe Mesa 22.3.6 (LLVM 15.0.6)", is of a family: its text holds the family's
// word, in upper or lower case. "lavapipe" means llvmpipe.
bool isOfFamily(const std::string& driver, const std::string& family);

// Says whether the first dotted number of the driver's text is in a range: comparisons separated by commas, each one of
// >=, >, <=, <, = before a version. Parts that the range does not name are not compared: 25.0.7 is "=25" and "<=25".
// Throws std::invalid_argument for a range that cannot be read.
bool isInVersions(const std::string& driver, const std::string& range);

}  // namespace speculum
