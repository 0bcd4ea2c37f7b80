// The JSON of the accuracy report and its place in the page; report_page.py tests the page in a browser.
#include "accuracy/report.hpp"

#include <nlohmann/json.hpp>

#include "accuracy/pareto.hpp"
#include "accuracy/report_example.hpp"
#include "image/picture_files.hpp"
#include "temporary_folder.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

using namespace testing_support;
using nlohmann::ordered_json;

// Returns the JSON in a page.
std::string embeddedJson(const std::string& html) {
  const std::string begin = "<script type=\"application/json\" id=\"data\">";
  const size_t at = html.find(begin) + begin.size();
  return html.substr(at, html.find("</script>", at) - at);
}

TEST(AccuracyReport, EmbedsItsJsonInThePage) {
  const TemporaryFolder folder;
  SweepResults results = exampleResults();
  writePictures(results, folder / "");
  const std::string html = reportHtml(results, folder / "");
  EXPECT_EQ(html, reportHtml(results, folder / ""));
  EXPECT_FALSE(contains(embeddedJson(html), "<")) << "no name can end the script element";
  EXPECT_EQ(ordered_json::parse(embeddedJson(html)), reportJson(results, folder / ""));
  EXPECT_FALSE(contains(html, "@STYLE@"));
  EXPECT_FALSE(contains(html, "@SCRIPT@"));
}

TEST(AccuracyReport, PageNamesNoOtherFile) {
  const std::string html = reportHtml(exampleResults(), "nowhere");
  for (const char* reference : {"https:", "@import", "url(", "src=\"", "href="}) {
    EXPECT_FALSE(contains(html, reference)) << reference;
  }
}

TEST(AccuracyReport, BrokenUtf8BecomesReplacementCharacters) {
  SweepResults results = exampleResults();
  results.title = "a\xff\xc3(";
  EXPECT_TRUE(contains(reportHtml(results, "nowhere"), "\"title\":\"a\uFFFD\uFFFD(\""));
}

TEST(AccuracyReport, HasTheFrontOfEachError) {
  SweepResults results = exampleResults();
  results.points[5].mirrors->rmse = 1.0;  // no longer on the front of mirrors
  results.points[6].mirrors.reset();
  const ordered_json fronts = reportJson(results, "nowhere")["fronts"];
  EXPECT_EQ(fronts["flip"], (std::vector{1, 7, 2, 3, 4, 5, 6})) << "by cost";
  for (SweepPoint& point : results.points) {
    point.whole.flip = point.mirrors ? point.mirrors->rmse : 1e9;
  }
  EXPECT_EQ(fronts["mirrors"], paretoFront(results.points));
  for (const int changed : {5, 6}) {
    EXPECT_EQ(std::count(fronts["mirrors"].begin(), fronts["mirrors"].end(), changed), 0);
    EXPECT_EQ(std::count(fronts["rmse"].begin(), fronts["rmse"].end(), changed), 1);
  }
}

TEST(AccuracyReport, MovementsHaveFlickerAndFrames) {
  const TemporaryFolder folder;
  SweepResults results = movingResults();
  writePictures(results, folder / "");
  const ordered_json json = reportJson(results, folder / "");
  for (SweepPoint& point : results.points) {
    point.whole.flip = point.flicker.value();
  }
  EXPECT_EQ(json["fronts"]["flicker"], paretoFront(results.points));
  EXPECT_NE(json["fronts"]["flicker"], json["fronts"]["flip"]) << "the base flickers little";
  EXPECT_EQ(json["pictures"]["frames"].size(), 3u);
  EXPECT_EQ(json["pictures"]["shown"][0]["point"], 0);
  EXPECT_EQ(json["pictures"]["shown"][0]["frames"], json["pictures"]["frames"]);
  EXPECT_TRUE(json["pictures"]["shown"][1]["frames"].empty());
  const ordered_json still = reportJson(exampleResults(), "nowhere");
  EXPECT_TRUE(still["fronts"]["flicker"].empty());
  EXPECT_TRUE(still["pictures"]["frames"].empty());
}

TEST(AccuracyReport, NamesBaseSettingsThatAreNoDefaults) {
  EXPECT_EQ(reportJson(exampleResults(), "nowhere")["changed"].dump(), R"({"view.samples":"8"})");
}

TEST(AccuracyReport, ShowsBaseFrontAndWorst) {
  SweepResults results = exampleResults();
  EXPECT_TRUE(shownPoints(results, 12).empty()) << "no pictures were kept";
  for (SweepPoint& point : results.points) {
    point.picture = "a.png";
  }
  EXPECT_EQ(shownPoints(results, 4), (std::vector{0, 1, 6, 11}));
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
    results.points.push_back(results.points[0]);
  }
  for (SweepPoint& point : results.points) {
    point.picture = point.heatMap = "noise.png";
  }
  const std::string html = reportHtml(results, folder / "");
  EXPECT_LT(html.size(), 1600000u);
  for (SweepPoint& point : results.points) {
    point.frames.assign(24, "noise.png");
  }
  results.truthFrames.assign(24, "noise.png");
  EXPECT_LT(reportHtml(results, folder / "").size(), 7'500'000u);
  EXPECT_GE(ordered_json::parse(embeddedJson(html))["pictures"]["shown"].size(), 1u);
}

TEST(AccuracyReport, MissingPicturesAreNull) {
  const TemporaryFolder folder;
  SweepResults results = exampleResults();
  writePictures(results, folder / "");
  std::filesystem::remove(folder / "0.png");
  folder.write("1.flip.png", "no picture");
  std::filesystem::remove(folder / "truth.png");
  const ordered_json pictures = reportJson(results, folder / "")["pictures"];
  EXPECT_TRUE(pictures["reference"].is_null());
  EXPECT_EQ(pictures["shown"].size(), 8u);
  for (const ordered_json& shown : pictures["shown"]) {
    EXPECT_NE(shown["point"], 0);
    EXPECT_EQ(shown["map"].is_null(), shown["point"] == 1);
  }
  EXPECT_TRUE(reportJson(results, "nowhere")["pictures"]["shown"].empty());
}

TEST(AccuracyReport, Base64MatchesTheRfc) {
  const auto encoded = [](const std::string& text) { return base64(std::vector<uint8_t>(text.begin(), text.end())); };
  EXPECT_EQ(encoded(""), "");
  EXPECT_EQ(encoded("f"), "Zg==");
  EXPECT_EQ(encoded("fo"), "Zm8=");
  EXPECT_EQ(encoded("foo"), "Zm9v");
  EXPECT_EQ(encoded("foob"), "Zm9vYg==");
  EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
  EXPECT_EQ(encoded("\xfb\xff\xfe"), "+//+");
}

}  // namespace
}  // namespace speculum
