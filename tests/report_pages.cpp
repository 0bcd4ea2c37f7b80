// Writes pages of accuracy reports into a folder, for report_page.py to open in a browser.
#include <fstream>

#include "accuracy/report.hpp"
#include "report_example.hpp"

namespace fs = std::filesystem;
using namespace speculum;
using namespace speculum::testing_support;

namespace {

void writePage(const fs::path& folder, const char* name, const SweepResults& results) {
  std::ofstream(folder / name) << reportHtml(results, folder);
}

}  // namespace

int main(int, char** arguments) {
  const fs::path folder = arguments[1];
  SweepResults example = exampleResults();
  writePictures(example, folder);
  writePage(folder, "example.html", example);
  fs::remove(folder / "0.png");
  fs::remove(folder / "truth.png");
  std::ofstream(folder / "1.flip.png") << "no picture";
  writePage(folder, "missing.html", example);
  writePage(folder, "bare.html", exampleResults());
  writePage(folder, "odd.html", oddResults());
  writePage(folder, "empty.html", {});
  SweepResults single = singleResult();
  writePage(folder, "single.html", single);
  single.points[0].gpuMs = {};
  writePage(folder, "untimed.html", single);
}
