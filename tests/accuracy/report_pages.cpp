// Writes pages of reports into a folder, for report_page.py to open in a browser.
#include <fstream>

#include "accuracy/report.hpp"
#include "accuracy/report_example.hpp"
#include "image/picture_files.hpp"
#include "made_pictures.hpp"
#include "regress/picture_check.hpp"
#include "regress/report_page.hpp"

namespace fs = std::filesystem;
using namespace speculum;
using namespace speculum::testing_support;

namespace {

void writeFile(const fs::path& file, const std::string& text) {
  std::ofstream(file) << text;
}

void writePage(const fs::path& folder, const char* name, const SweepResults& results) {
  writeFile(folder / name, reportHtml(results, folder));
}

// Writes pages with a seam of one pixel, a crash, a new picture without an expected one, and passing cases.
void writeRegressPages(const fs::path& folder) {
  const Image8 expected = madePicture(64, 36, [](int x, int y) {
    const int grey = (64 * y + x) / 16;
    return glm::ivec4(grey, grey, grey, 255);
  });
  Image8 actual = expected;
  for (int y = 0; y < actual.height; ++y) {
    actual.at(32, y)[0] ^= 0x80;
  }
  RegressRun run{.file = "cases.toml", .command = {"speculum", "regress", "cases.toml"}, .version = "1", .date = "now"};
  const auto add = [&](const std::string& name, Outcome outcome) -> Outcome& {
    run.cases.push_back({.name = name, .size = {64, 36}, .tolerance = {.maxDiff = 3, .share = 0.001, .block = true}});
    run.outcomes.push_back(std::move(outcome));
    return run.outcomes.back();
  };
  add("fine", {});
  writeFile(folder / "regress_passed.html", regressHtml(run, folder));
  Outcome& seam = add("seam", {.driver = "a driver",
                               .drawCommand = {"speculum", "render", "--set", "a b=1"},
                               .acceptCommand = {"speculum", "regress", "--filter", "seam", "--update"}});
  judge(expected, actual, run.cases.back(), CaseFiles(folder, "seam"), seam);
  add("left out", {.verdict = Verdict::skipped, .message = "too slow"});
  add("crash",
      {.verdict = Verdict::error, .message = "signal 11", .drawCommand = {"speculum"}, .log = {"</script>", "ouch"}});
  add("new",
      {.verdict = Verdict::failed, .message = "there is no expected picture", .replaceable = true, .hasFiles = true});
  writePng(CaseFiles(folder, "new").actual, actual);
  writeFile(folder / "regress.html", regressHtml(run, folder));
}

}  // namespace

int main(int, char** arguments) {
  const fs::path folder = arguments[1];
  writeRegressPages(folder);
  SweepResults example = exampleResults();
  writePictures(example, folder);
  writePage(folder, "example.html", example);
  fs::remove(folder / "0.png");
  fs::remove(folder / "truth.png");
  std::ofstream(folder / "1.flip.png") << "no picture";
  writePage(folder, "missing.html", example);
  writePage(folder, "bare.html", exampleResults());
  writePage(folder, "odd.html", oddResults());
  SweepResults moving = movingResults();
  writePictures(moving, folder);
  writePage(folder, "motion.html", moving);
  writePage(folder, "empty.html", {});
  SweepResults single = singleResult();
  writePage(folder, "single.html", single);
  single.points[0].gpuMs = {};
  writePage(folder, "untimed.html", single);
}
