#include "accuracy/report_example.hpp"

#include <cmath>
#include <limits>

#include "compare/picture_agreement.hpp"
#include "image/picture_files.hpp"
#include "made_pictures.hpp"

namespace speculum::testing_support {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int width = 64;
constexpr int height = 36;

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
  for (const char* scale : {"0.125", "0.25", "0.5", "1", "2", "4"}) {
    const int i = static_cast<int>(results.points.size()) - 1;
    results.points.push_back(point("scale " + std::string(scale), 0.5 * std::pow(2.2, i), 0.05 * std::pow(0.55, i),
                                   {{"reflection.scale", scale}}));
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
                            .note = "edges & texels"});
  results.series.push_back({.key = "reflection.max_depth",
                            .name = "Depth",
                            .axis = SweepSeries::Axis::linear,
                            .x = {0, 1, 2, 3},
                            .points = {7, 8, 9, 10},
                            .note = "a bounce each"});
  results.series.push_back({.key = "view.samples", .name = "Empty"});
}

Image8 picture(int seed) {
  return madePicture(width, height, [&](int x, int y) { return glm::ivec4(3 * x + 11 * seed, 5 * y, 255, 255); });
}

}  // namespace

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
  results.floor.whole = metrics(0.0004);
  results.floor.mirrors = metrics(0.0005);
  addPoints(results);
  addSeries(results);
  for (const int i : {1, 2, 7, 3, 4, 5, 6}) {
    results.points[i].onFront = true;
  }
  return results;
}

SweepResults oddResults() {
  SweepResults results = exampleResults();
  results.points[0].whole = metrics(0.0);
  results.points[0].mirrors = metrics(0.0);
  results.points[1].whole.relativeRmse = infinity;
  results.points[2].whole.flip = infinity;
  results.points[3].whole.rmse = std::numeric_limits<double>::quiet_NaN();
  results.points[4].gpuMs = {};
  results.points[4].frameMs = {};
  results.points[5].gpuMs = spread(1e-300);
  results.points[6].gpuMs = spread(1e300);
  results.points[7].mirrors.reset();
  results.series[0].x[0] = 0.0;
  results.series[1].points[2] = 99;
  results.floor.whole = {};
  return results;
}

SweepResults movingResults() {
  SweepResults results = exampleResults();
  results.motion = SweepMotion{"a path.toml", 3, 30.0};
  results.floor.flicker = 0.002;
  for (SweepPoint& point : results.points) {
    point.flicker = 0.5 * point.whole.flip;
  }
  results.points[0].flicker = 0.003;
  return results;
}

SweepResults singleResult() {
  SweepResults results;
  results.points.push_back(point("only", 1.0, 0.0, {}));
  results.points[0].mirrors.reset();
  results.points[0].onFront = true;
  return results;
}

void writePictures(SweepResults& results, const std::filesystem::path& folder) {
  writePng(folder / "truth.png", picture(0));
  results.truthPicture = "truth.png";
  for (size_t i = 0; i < results.points.size(); ++i) {
    results.points[i].picture = std::to_string(i) + ".png";
    results.points[i].heatMap = std::to_string(i) + ".flip.png";
    writePng(folder / results.points[i].picture, picture(static_cast<int>(i)));
    writePng(folder / results.points[i].heatMap, heatMap(Plane2d(width, height)));
  }
  for (int frame = 0; results.motion && frame < results.motion->frames; ++frame) {
    const std::string file = "frame" + std::to_string(frame) + ".png";
    writePng(folder / file, picture(20 + frame));
    results.truthFrames.push_back(file);
    results.points[0].frames.push_back(file);
  }
}

}  // namespace speculum::testing_support
