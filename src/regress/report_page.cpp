#include "regress/report_page.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>

#include "accuracy/report.hpp"
#include "image/picture_files.hpp"
#include "platform/files.hpp"
#include "platform/text.hpp"

namespace speculum {

namespace {

using nlohmann::ordered_json;

bool needsAttention(const Outcome& outcome) {
  return outcome.verdict == Verdict::failed || outcome.verdict == Verdict::error;
}

// Embeds the four pictures at a JPEG quality, or as PNG without one; null for a file that is missing.
ordered_json embedded(const CaseFiles& files, std::optional<int> quality) {
  ordered_json pictures = ordered_json::array();
  for (const std::filesystem::path& file : files.all()) {
    const auto png = readFileIfAny(file);
    pictures.push_back(nullptr);
    if (png) {
      pictures.back() = quality ? "data:image/jpeg;base64," + base64(encodeJpeg(readImage8(file), *quality))
                                : "data:image/png;base64," + base64(*png);
    }
  }
  return pictures;
}

size_t sizeOf(const ordered_json& pictures) {
  size_t size = 0;
  for (const ordered_json& picture : pictures) {
    size += picture.is_string() ? picture.get_ref<const std::string&>().size() : 0;
  }
  return size;
}

// Embeds the pictures in the best quality that fits `room` characters; null if none does.
ordered_json picturesOf(const CaseFiles& files, double room) {
  for (const std::optional<int> quality : {std::optional<int>(), std::optional(90), std::optional(70)}) {
    ordered_json pictures = embedded(files, quality);
    if (static_cast<double>(sizeOf(pictures)) <= room) {
      return pictures;
    }
  }
  return nullptr;
}

// A line has none of the characters that XML forbids.
std::string escapedXml(std::string_view text) {
  return escaped(oneLine(text), {{'<', "&lt;"}, {'>', "&gt;"}, {'&', "&amp;"}, {'"', "&quot;"}});
}

// Escape text for GitHub's workflow commands: a property has no comma and no colon.
std::string escapedMessage(std::string_view text) {
  return escaped(oneLine(text), {{'%', "%25"}});
}
std::string escapedProperty(std::string_view text) {
  return escaped(oneLine(text), {{'%', "%25"}, {',', "%2C"}, {':', "%3A"}});
}

std::string escapedCell(std::string_view text) {
  return escaped(oneLine(text), {{'|', "\\|"}, {'<', "\\<"}, {'\\', "\\\\"}});
}

// Returns the order of the report: errors and failures first, each group in the order of the file.
std::vector<size_t> reportOrder(const RegressRun& run) {
  std::vector<size_t> order(run.outcomes.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_partition(order.begin(), order.end(), [&](size_t i) { return needsAttention(run.outcomes[i]); });
  return order;
}

}  // namespace

std::string verdictName(Verdict verdict) {
  return nlohmann::json(verdict).get<std::string>();
}

int RegressRun::count(Verdict verdict) const {
  return static_cast<int>(std::ranges::count(outcomes, verdict, &Outcome::verdict));
}

std::string summary(const RegressRun& run) {
  std::string text = std::to_string(run.cases.size()) + (run.cases.size() == 1 ? " case" : " cases");
  const char* separator = ": ";
  for (const Verdict verdict : {Verdict::passed, Verdict::failed, Verdict::error, Verdict::skipped, Verdict::updated}) {
    if (const int count = run.count(verdict)) {
      text += separator + std::to_string(count) + " " + verdictName(verdict);
      separator = ", ";
    }
  }
  return text;
}

std::string regressHtml(const RegressRun& run, const std::filesystem::path& folder, double budget) {
  ordered_json cases = ordered_json::array();
  double left = budget;
  int waiting = static_cast<int>(std::ranges::count_if(run.outcomes, needsAttention));
  for (const size_t i : reportOrder(run)) {
    const Outcome& outcome = run.outcomes[i];
    const RegressCase& subject = run.cases[i];
    ordered_json entry = nlohmann::json(outcome);
    entry["name"] = subject.name;
    entry["line"] = subject.line;
    entry["size"] = {subject.size.width, subject.size.height};
    entry["pictures"] = nullptr;
    if (needsAttention(outcome)) {
      if (outcome.hasFiles) {
        entry["pictures"] = picturesOf(CaseFiles(folder, subject.name), left / waiting);
        left -= static_cast<double>(entry["pictures"].is_null() ? 0 : sizeOf(entry["pictures"]));
      }
      --waiting;
    }
    cases.push_back(std::move(entry));
  }
  return pageWithData(regressPage(), {{"file", run.file.string()},
                                      {"summary", summary(run)},
                                      {"command", run.command},
                                      {"version", run.version},
                                      {"date", run.date},
                                      {"cases", std::move(cases)}});
}

std::string junitXml(const RegressRun& run) {
  double seconds = 0.0;
  std::string cases;
  for (size_t i = 0; i < run.cases.size(); ++i) {
    const Outcome& outcome = run.outcomes[i];
    seconds += outcome.seconds;
    const std::string message = escapedXml(outcome.message);
    std::string text;
    for (const OutcomeFigure& figure : outcome.figures) {
      text += escapedXml(fmt::format("{}: {} (limit {})", figure.label, figure.value, figure.limit)) + "\n";
    }
    for (const std::string& line : outcome.log) {
      text += escapedXml(line) + "\n";
    }
    std::string result;
    if (outcome.verdict == Verdict::skipped) {
      result = fmt::format("<skipped message=\"{}\"/>", message);
    } else if (needsAttention(outcome)) {
      const char* element = outcome.verdict == Verdict::failed ? "failure" : "error";
      result = fmt::format("\n    <{0} message=\"{1}\">{2}</{0}>\n  ", element, message, text);
    }
    cases += fmt::format("  <testcase classname=\"{}\" name=\"{}\" time=\"{:.6f}\">{}</testcase>\n",
                         escapedXml(run.file.stem().string()), escapedXml(run.cases[i].name), outcome.seconds, result);
  }
  constexpr const char* report =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<testsuites tests=\"{0}\" failures=\"{1}\" disabled=\"{2}\" errors=\"{3}\">\n"
      "<testsuite name=\"speculum regress\" tests=\"{0}\" failures=\"{1}\" errors=\"{3}\" skipped=\"{2}\" "
      "time=\"{4:.6f}\">\n{5}</testsuite>\n</testsuites>\n";
  return fmt::format(report, run.cases.size(), run.count(Verdict::failed), run.count(Verdict::skipped),
                     run.count(Verdict::error), seconds, cases);
}

std::string githubErrors(const RegressRun& run) {
  // GitHub takes a relative path as one of the repository, and the command may have been run in a folder of the
  // repository.
  const std::string file = escapedProperty(wholePath(run.file).lexically_normal().string());
  std::string text;
  for (size_t i = 0; i < run.cases.size(); ++i) {
    if (needsAttention(run.outcomes[i])) {
      text += fmt::format("::error file={},line={},title={}::{}\n", file, run.cases[i].line,
                          escapedProperty(run.cases[i].name), escapedMessage(run.outcomes[i].message));
    }
  }
  return text;
}

std::string githubSummary(const RegressRun& run) {
  std::string text = "### speculum regress: " + summary(run) + "\n\n";
  if (run.passed()) {
    return text;
  }
  text += "| Case | Result | Why |\n| --- | --- | --- |\n";
  for (size_t i = 0; i < run.cases.size(); ++i) {
    if (needsAttention(run.outcomes[i])) {
      text += fmt::format("| {} | {} | {} |\n", escapedCell(run.cases[i].name), verdictName(run.outcomes[i].verdict),
                          escapedCell(run.outcomes[i].message));
    }
  }
  return text + "\n";
}

}  // namespace speculum
