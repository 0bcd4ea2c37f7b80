#include <nlohmann/json.hpp>
#include <set>

#include "fuzz_support.hpp"
#include "image/picture_files.hpp"
#include "platform/text.hpp"
#include "regress/case_file.hpp"
#include "regress/report_page.hpp"
#include "settings/settings.hpp"

namespace speculum::fuzz {

namespace {

// Checks what `regress` relies on, without drawing.
void checkSubject(const RegressCase& subject, std::set<std::string>& names) {
  require(names.insert(subject.name).second, "names are unique");
  require(subject.name.find('/') == std::string::npos && !subject.name.empty(), "names are those of files");
  require(isFile(subject.scene) && (!subject.mask || isFile(*subject.mask)), "scenes and masks are there");
  require(subject.tolerance.maxDiff && subject.tolerance.share && subject.tolerance.block, "tolerances are complete");
  Settings settings;
  for (const auto& [key, value] : subject.settings) {
    require(!setSetting(settings, key, value), "settings have been checked");
  }
  for (const char* driver : {"llvmpipe Mesa 22.3.6 (LLVM 15.0.6)", "NVIDIA 550.54.15", ""}) {
    const ExpectedCase expected = expectedOf(subject, driver);
    require(!expected.subject.picture.empty(), "an expected picture has a name");
  }
}

// A run in which all cases failed for a reason of the file.
void checkReports(const RegressRun& run) {
  nlohmann::json(junitXml(run)).dump();  // throws for what is not UTF-8
  const std::string errors = githubErrors(run);
  require(static_cast<size_t>(std::ranges::count(errors, '\n')) == run.cases.size(), "an error is one line");
  regressHtml(run, "/nowhere");
}

}  // namespace

bool checkCase(std::string_view text) {
  static const TemporaryFolder folder;
  [[maybe_unused]] static const bool written = [] {
    folder.write("room.toml", "[camera]\nposition = [0, 0, 2]\ntarget = [0, 0, 0]\n");
    folder.write("hall.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    writePng(folder / "mask.png", Image8(2, 2));
    return true;
  }();
  try {
    isInVersions("llvmpipe Mesa 22.3.6", std::string(text));
  } catch (const std::invalid_argument&) {  // as for nearly every text
  }
  require(oneLine(oneLine(text)) == oneLine(text), "a text is made one line once");
  RegressRun run{.file = folder.write("cases.toml", text)};
  if (!accepted([&] { run.cases = readCases(run.file); })) {
    return false;
  }
  std::set<std::string> names;
  for (const RegressCase& subject : run.cases) {
    checkSubject(subject, names);
    Outcome outcome{.verdict = Verdict::failed};
    outcome.message = subject.expect.empty() ? subject.name : subject.expect[0].reason;
    run.outcomes.push_back(std::move(outcome));
  }
  if (run.cases.size() <= 100) {  // otherwise few inputs would run in a second
    checkReports(run);
  }
  return true;
}

}  // namespace speculum::fuzz
