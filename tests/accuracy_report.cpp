#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <regex>
#include <set>

#include "accuracy/heat_map.hpp"
#include "accuracy/html_text.hpp"
#include "accuracy/pareto.hpp"
#include "accuracy/report.hpp"
#include "accuracy/report_viewer.hpp"
#include "html_check.hpp"
#include "temporary_folder.hpp"

namespace speculum {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();
constexpr int width = 64;
constexpr int height = 36;
const std::string awkwardName = "a <&\"> 'name'";

ImageMetrics metrics(double error) {
  return {.rmse = error,
          .relativeRmse = 3.0 * error,
          .psnr = error > 0.0 ? -20.0 * std::log10(error) : infinity,
          .ssim = 1.0 - error,
          .flip = 2.0 * error,
          .maxDiff = std::round(255.0 * error),
          .p99Diff = std::round(100.0 * error),
          .pixelsOver = static_cast<int64_t>(1000.0 * error),
          .pixels = width * height};
}

Spread spread(double ms) {
  return {.median = ms, .minimum = 0.97 * ms, .lowerQuartile = 0.99 * ms, .upperQuartile = 1.02 * ms, .repeats = 9};
}

SweepPoint point(std::string name, double ms, double error, std::vector<SettingChange> changes) {
  return {.name = std::move(name),
          .changes = std::move(changes),
          .whole = metrics(error),
          .mirrors = metrics(1.5 * error),
          .gpuMs = spread(ms),
          .cpuMs = spread(0.2),
          .frameMs = spread(ms + 1.0)};
}

void addPoints(SweepResults& results) {
  results.points.push_back(point("base", 2.0, 0.010, {}));
  for (int i = 0; i < 6; ++i) {
    const double scale = std::ldexp(0.125, i);
    results.points.push_back(point("scale " + numberText(scale), 0.5 * std::pow(2.2, i), 0.05 * std::pow(0.55, i),
                                   {{"reflection.scale", exactText(scale)}}));
  }
  for (int depth = 0; depth < 4; ++depth) {
    results.points.push_back(point("depth " + std::to_string(depth), 1.0 + 0.3 * depth, 0.1 * std::exp(-depth),
                                   {{"reflection.max_depth", std::to_string(depth)}}));
  }
  results.points.push_back(point(awkwardName, 9.0, 0.2, {{"view.clear_color", "1, 0, 0"}, {"view.samples", "1"}}));
}

void addSeries(SweepResults& results) {
  results.series.push_back({.key = "reflection.scale",
                            .name = "Resolution <of mirrors>",
                            .x = {0.125, 0.25, 0.5, 1.0, 2.0, 4.0},
                            .points = {1, 2, 3, 4, 5, 6},
                            .note = "edges & texels",
                            .theorySlope = -1.0,
                            .fit = LineFit{-0.86, -4.4},
                            .fitted = {0, 1, 2, 3}});
  results.series.push_back({.key = "reflection.max_depth",
                            .name = "Depth",
                            .axis = SweepSeries::Axis::linear,
                            .x = {0, 1, 2, 3},
                            .points = {7, 8, 9, 10},
                            .note = "a bounce each",
                            .theorySlope = -1.0,
                            .fit = LineFit{-1.0, -1.9},
                            .fitted = {0, 1, 2}});
  results.series.push_back({.key = "view.samples", .name = "Empty"});
}

// 12 points, 3 series, nothing on the disk.
SweepResults exampleResults() {
  SweepResults results{.scene = "scenes/room & co.toml",
                       .title = "A room <with> mirrors",
                       .sweep = "quick",
                       .width = width,
                       .height = height,
                       .time = 1.25,
                       .device = "A device",
                       .version = "1.2.3",
                       .date = "2001-02-03T04:05:06Z",
                       .base = {{"reflection.scale", "1.0"}, {"view.samples", "8"}}};
  results.truthMs = 54321.0;
  results.truthThreads = 2;
  results.floorWhole = metrics(0.0004);
  results.floorMirrors = metrics(0.0005);
  addPoints(results);
  addSeries(results);
  for (const int i : {1, 2, 7, 3, 4, 5, 6}) {
    results.points[i].onFront = true;
  }
  return results;
}

Image8 picture(int seed) {
  Image8 image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.at(x, y)[0] = static_cast<uint8_t>(3 * x + 11 * seed);
      image.at(x, y)[1] = static_cast<uint8_t>(5 * y);
    }
  }
  return image;
}

void writePictures(SweepResults& results, const TemporaryFolder& folder) {
  writePng(folder / "truth.png", picture(0));
  results.truthPicture = "truth.png";
  for (size_t i = 0; i < results.points.size(); ++i) {
    results.points[i].picture = std::to_string(i) + ".png";
    results.points[i].heatMap = std::to_string(i) + ".flip.png";
    writePng(folder / results.points[i].picture, picture(static_cast<int>(i)));
    writePng(folder / results.points[i].heatMap, heatMap(Plane2d(width, height)));
  }
}

std::vector<std::string> svgsOf(const std::string& html) {
  std::vector<std::string> svgs;
  for (size_t at = html.find("<svg"); at != std::string::npos; at = html.find("<svg", at + 1)) {
    svgs.push_back(html.substr(at, html.find("</svg>", at) + 6 - at));
  }
  return svgs;
}

std::vector<double> numbersIn(const std::string& text) {
  std::vector<double> numbers;
  static const std::regex number("-?[0-9]+(\\.[0-9]+)?");
  for (std::sregex_iterator i(text.begin(), text.end(), number), end; i != end; ++i) {
    numbers.push_back(std::stod(i->str()));
  }
  return numbers;
}

void expectWithin(const std::vector<double>& values, double low, double high, const std::string& what) {
  for (const double value : values) {
    EXPECT_GE(value, low) << what;
    EXPECT_LE(value, high) << what;
  }
}

void expectDrawnWithinViewBox(const std::string& svg) {
  const std::vector<HtmlElement> elements = htmlElements(svg);
  ASSERT_FALSE(elements.empty());
  const std::vector<double> box = numbersIn(elements.front().attribute("viewBox"));
  ASSERT_EQ(box.size(), 4u);
  for (const HtmlElement& element : elements) {
    for (const auto& [key, value] : element.attributes) {
      if (key == "x" || key == "x1" || key == "x2" || key == "cx") {
        expectWithin(numbersIn(value), 0.0, box[2], element.name + " " + key);
      } else if (key == "y" || key == "y1" || key == "y2" || key == "cy") {
        expectWithin(numbersIn(value), 0.0, box[3], element.name + " " + key);
      } else if (key == "points" || key == "d") {
        const std::vector<double> values = numbersIn(value);
        ASSERT_EQ(values.size() % 2, 0u);
        for (size_t i = 0; i < values.size(); ++i) {
          expectWithin({values[i]}, 0.0, box[2 + i % 2], element.name + " " + key);
        }
      }
    }
  }
}

// Whatever the results, the report is one that a browser can show as meant.
void expectSound(const std::string& html) {
  EXPECT_EQ(htmlFault(html), "");
  for (const std::string& svg : svgsOf(html)) {
    expectDrawnWithinViewBox(svg);
    std::string lower(svg);
    std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
    EXPECT_EQ(lower.find("nan"), std::string::npos) << svg;
    EXPECT_EQ(lower.find("inf"), std::string::npos) << svg;
  }
  for (const HtmlElement& element : htmlElements(html)) {
    EXPECT_TRUE(element.name != "img" || !element.attribute("alt").empty()) << element.attribute("class");
  }
}

std::vector<uint8_t> decodedBase64(const std::string& text) {
  const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<uint8_t> bytes;
  uint32_t group = 0;
  int bits = 0;
  for (const char c : text) {
    const size_t value = alphabet.find(c);
    if (value == std::string::npos) {
      break;
    }
    group = group << 6 | static_cast<uint32_t>(value);
    bits += 6;
    if (bits >= 8) {
      bits -= 8;
      bytes.push_back(static_cast<uint8_t>(group >> bits));
    }
  }
  return bytes;
}

TEST(AccuracyReport, IsWellFormedAndHasEveryPoint) {
  const TemporaryFolder folder;
  SweepResults results = exampleResults();
  writePictures(results, folder);
  const std::string html = reportHtml(results, folder / "");
  expectSound(html);
  for (const SweepPoint& p : results.points) {
    EXPECT_NE(html.find(">" + escapeHtml(p.name) + "</button>"), std::string::npos) << p.name;
  }
  EXPECT_EQ(html.find(awkwardName), std::string::npos);
  EXPECT_EQ(html.find("<with>"), std::string::npos);
  EXPECT_EQ(html.find("<of mirrors>"), std::string::npos);
  EXPECT_NE(html.find(escapeHtml("--set 'view.clear_color=1, 0, 0' --set view.samples=1")), std::string::npos);
  EXPECT_NE(html.find(escapeHtml("speculum accuracy --scene 'scenes/room & co.toml' --size 64x36 --time 1.25 "
                                 "--sweep quick --set view.samples=8 --out ")),
            std::string::npos);
  EXPECT_EQ(html, reportHtml(results, folder / ""));
}

TEST(AccuracyReport, SumsUpWhatWasFound) {
  const std::string html = reportHtml(exampleResults(), "nowhere");
  EXPECT_NE(html.find("Of 12 configurations, 7 are worth their price, from 0.500 ms and mean FLIP 0.100 (scale 0.125) "
                      "to 25.8 ms and mean FLIP 0.00503 (scale 4.00)"),
            std::string::npos);
  EXPECT_NE(html.find("the base settings take 2.00 ms and mean FLIP 0.0200, off the front"), std::string::npos);
  EXPECT_NE(html.find("known to 0.000800, 25 times below that."), std::string::npos);
}

TEST(AccuracyReport, NeedsNothingBesideIt) {
  const TemporaryFolder folder;
  SweepResults results = exampleResults();
  writePictures(results, folder);
  const std::string html = reportHtml(results, folder / "");
  EXPECT_EQ(html.find("http:"), std::string::npos);
  EXPECT_EQ(html.find("https:"), std::string::npos);
  EXPECT_EQ(html.find("@import"), std::string::npos);
  EXPECT_EQ(html.find("url("), std::string::npos);
  int pictures = 0;
  for (const HtmlElement& element : htmlElements(html)) {
    EXPECT_EQ(element.attribute("href"), "");
    const std::string source = element.attribute("src");
    EXPECT_TRUE(source.empty() || source.starts_with("data:image/")) << source;
    pictures += !source.empty();
  }
  EXPECT_GT(pictures, 8);
}

TEST(AccuracyReport, EmbeddedPicturesKeepTheirSize) {
  const TemporaryFolder folder;
  SweepResults results = exampleResults();
  writePictures(results, folder);
  std::set<std::pair<int, int>> sizes;
  const std::string prefix = "data:image/jpeg;base64,";
  for (const HtmlElement& element : htmlElements(reportHtml(results, folder / ""))) {
    const std::string source = element.attribute("src");
    if (element.name != "img") {
      continue;
    }
    ASSERT_TRUE(source.starts_with(prefix));
    const std::vector<uint8_t> bytes = decodedBase64(source.substr(prefix.size()));
    const Image8 image = readImage8(folder.write("a.jpg", {reinterpret_cast<const char*>(bytes.data()), bytes.size()}));
    EXPECT_EQ(std::to_string(image.width), element.attribute("width"));
    EXPECT_EQ(std::to_string(image.height), element.attribute("height"));
    sizes.insert({image.width, image.height});
  }
  EXPECT_EQ(sizes, (std::set<std::pair<int, int>>{{width, height}, {width, legendHeight(width)}}));
}

// Points whose marks have that class, in the plot that comes at that place.
std::set<int> markedPoints(const std::string& svg, const std::string& style) {
  std::set<int> points;
  for (const HtmlElement& element : htmlElements(svg)) {
    const std::string classes = " " + element.attribute("class") + " ";
    if (classes.find(" " + style + " ") != std::string::npos && !element.attribute("data-point").empty()) {
      points.insert(std::stoi(element.attribute("data-point")));
    }
  }
  return points;
}

TEST(AccuracyReport, MarksTheFrontOfEachPlot) {
  SweepResults results = exampleResults();
  results.points[4].mirrors->rmse = 1.0;  // no longer on the front of mirrors
  const std::string html = reportHtml(results, "nowhere");
  const std::vector<std::string> svgs = svgsOf(html);
  ASSERT_GE(svgs.size(), 4u);  // FLIP wide and narrow, RMSE, RMSE over mirrors
  const std::set<int> flip = {1, 2, 3, 4, 5, 6, 7};
  EXPECT_EQ(markedPoints(svgs[0], "front"), flip);
  EXPECT_EQ(markedPoints(svgs[1], "front"), flip);
  EXPECT_EQ(markedPoints(svgs[0], "dominated"), (std::set<int>{0, 8, 9, 10, 11}));
  std::vector<FrontCandidate> candidates;
  for (const SweepPoint& p : results.points) {
    candidates.push_back({p.mirrors->rmse, p.gpuMs});
  }
  const std::vector<int> mirrors = paretoFront(candidates);
  EXPECT_EQ(markedPoints(svgs[3], "front"), std::set<int>(mirrors.begin(), mirrors.end()));
  EXPECT_EQ(markedPoints(svgs[3], "front").count(4), 0u);
  std::set<int> rows;
  for (const HtmlElement& element : htmlElements(html)) {
    if (element.name == "tr" && element.attribute("class").starts_with("front")) {
      rows.insert(std::stoi(element.attribute("data-point")));
    }
  }
  EXPECT_EQ(rows, flip);
}

TEST(AccuracyReport, TableIsSortedByCostAtFirst) {
  double last = 0.0;
  int rows = 0;
  const SweepResults results = exampleResults();
  for (const HtmlElement& element : htmlElements(reportHtml(results, "nowhere"))) {
    if (element.name == "tr" && !element.attribute("data-point").empty()) {
      const double ms = costMs(results.points[std::stoi(element.attribute("data-point"))]);
      EXPECT_GE(ms, last);
      last = ms;
      ++rows;
    }
  }
  EXPECT_EQ(rows, 12);
}

TEST(AccuracyReport, ShowsTheBaseTheFrontAndTheWorst) {
  SweepResults results = exampleResults();
  EXPECT_TRUE(shownPoints(results, 12).empty()) << "no pictures were kept";
  for (SweepPoint& p : results.points) {
    p.picture = "a.png";
  }
  EXPECT_EQ(shownPoints(results, 4), (std::vector<int>{0, 1, 6, 11}));
  const std::vector<int> all = shownPoints(results, 12);
  const std::set<int> shown(all.begin(), all.end());
  EXPECT_EQ(shown.size(), all.size());
  for (const int needed : {0, 1, 2, 3, 4, 5, 6, 7, 11}) {
    EXPECT_EQ(shown.count(needed), 1u) << needed;
  }
}

TEST(AccuracyReport, StaysSmallWithManyLargePictures) {
  const TemporaryFolder folder;
  SweepResults results = exampleResults();
  Image8 noise(640, 360);
  uint32_t state = 1;
  for (uint8_t& byte : noise.rgba) {
    state = state * 1664525u + 1013904223u;
    byte = static_cast<uint8_t>(state >> 24);
  }
  writePng(folder / "noise.png", noise);
  results.width = 640;
  results.height = 360;
  results.truthPicture = "noise.png";
  for (int i = 0; i < 28; ++i) {
    results.points.push_back(point("more " + std::to_string(i), 3.0 + i, 0.3, {{"view.samples", "2"}}));
  }
  for (SweepPoint& p : results.points) {
    p.picture = p.heatMap = "noise.png";
  }
  const std::string html = reportHtml(results, folder / "");
  EXPECT_LT(html.size(), 1600000u);
  EXPECT_NE(html.find("is not in this report; its lossless file is noise.png"), std::string::npos);
  expectSound(html);
}

TEST(AccuracyReport, MissingPicturesAreToldInTheirPlace) {
  const TemporaryFolder folder;
  SweepResults results = exampleResults();
  writePictures(results, folder);
  std::filesystem::remove(folder / "0.png");
  folder.write("1.flip.png", "no picture");
  std::filesystem::remove(folder / "truth.png");
  const std::string html = reportHtml(results, folder / "");
  expectSound(html);
  EXPECT_NE(html.find("The picture of base is not in this report; its lossless file is 0.png"), std::string::npos);
  EXPECT_NE(html.find("The error map of scale 0.125 is not in this report; its lossless file is 1.flip.png"),
            std::string::npos);
  EXPECT_NE(html.find("The reference picture is not in this report"), std::string::npos);
  EXPECT_NE(reportHtml(results, "nowhere").find("No pictures were kept, or none could be read."), std::string::npos);
}

TEST(AccuracyReport, OddValuesDoNotBreakIt) {
  SweepResults results = exampleResults();
  results.points[0].whole = metrics(0.0);
  results.points[0].mirrors = metrics(0.0);
  results.points[1].whole.relativeRmse = infinity;
  results.points[2].whole.flip = infinity;
  results.points[3].whole.rmse = notANumber;
  results.points[4].gpuMs = {};
  results.points[4].frameMs = {};
  results.points[5].gpuMs = spread(1e-300);
  results.points[6].gpuMs = spread(1e300);
  results.points[7].mirrors.reset();
  results.series[0].fit = LineFit{infinity, notANumber};
  results.series[0].x[0] = 0.0;
  results.series[1].points[2] = 99;
  results.series[1].fitted = {0, 7, -1};
  results.floorWhole = {};
  const std::string html = reportHtml(results, "nowhere");
  expectSound(html);
  EXPECT_NE(html.find("no difference"), std::string::npos);
  EXPECT_NE(html.find("∞"), std::string::npos);
}

TEST(AccuracyReport, NothingAndAlmostNothingCanBeShown) {
  const std::string empty = reportHtml({}, "nowhere");
  expectSound(empty);
  EXPECT_NE(empty.find("No configuration was measured."), std::string::npos);
  SweepResults single;
  single.points.push_back(point("only", 1.0, 0.0, {}));
  single.points[0].mirrors.reset();
  single.points[0].onFront = true;
  expectSound(reportHtml(single, "nowhere"));
  single.points[0].gpuMs = {};
  const std::string untimed = reportHtml(single, "nowhere");
  expectSound(untimed);
  EXPECT_NE(untimed.find("has no timestamps"), std::string::npos);
}

TEST(HtmlCheck, FindsWhatIsWrong) {
  EXPECT_EQ(htmlFault("<p class=\"a > b\">x<br>y</p><script>1 < 2</script>"), "");
  EXPECT_NE(htmlFault("<p><b></p></b>"), "");
  EXPECT_NE(htmlFault("<p>"), "");
  EXPECT_NE(htmlFault("</p>"), "");
  EXPECT_NE(htmlFault("<p a=1></p>"), "");
  EXPECT_NE(htmlFault("<p a=\"1\" a=\"2\"></p>"), "");
  EXPECT_NE(htmlFault("<p>1 < 2</p>"), "");
}

}  // namespace
}  // namespace speculum
