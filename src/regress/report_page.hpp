#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "regress/case_file.hpp"
#include "regress/picture_check.hpp"

namespace speculum {

// A run of all cases, with one outcome for each.
struct RegressRun {
  std::filesystem::path file;  // file of the cases
  std::vector<RegressCase> cases;
  std::vector<Outcome> outcomes;
  std::vector<std::string> command;  // words of the command that ran the cases
  std::string version;
  std::string date;

  int count(Verdict verdict) const;
  bool passed() const { return count(Verdict::failed) == 0 && count(Verdict::error) == 0; }
};

// Returns a line such as "3 cases: 2 passed, 1 failed".
std::string summary(const RegressRun& run);

// Returns the report as one HTML file that needs no other file and no network. Embeds pictures of cases that did not
// pass from `folder`: as PNG, or as JPEG or not at all where they would exceed their share of `budget` characters.
std::string regressHtml(const RegressRun& run, const std::filesystem::path& folder, double budget = 18e6);

// Returns JUnit XML, with a test case for each case.
std::string junitXml(const RegressRun& run);

// Return "::error" lines of GitHub for cases that did not pass, and a table for the summary of the step.
std::string githubErrors(const RegressRun& run);
std::string githubSummary(const RegressRun& run);

// Returns the page with its style sheets and scripts, and "@DATA@" where its JSON belongs. Written at build time.
std::string_view regressPage();

}  // namespace speculum
