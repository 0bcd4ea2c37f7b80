#include <algorithm>

#include "accuracy/sweep_json.hpp"
#include "accuracy/sweep_results.hpp"
#include "platform/files.hpp"

namespace speculum {

namespace {

using nlohmann::ordered_json;

std::vector<SettingChange> readChanges(const JsonReader& reader, const char* key) {
  std::vector<SettingChange> changes;
  const ordered_json& settings = reader.member(key);
  for (const auto& [name, value] : settings.items()) {
    if (!settings.is_object() || !value.is_string()) {
      reader.fail(key);
    }
    changes.push_back({name, value.get<std::string>()});
  }
  return changes;
}

Spread readSpread(const JsonReader& reader) {
  return {reader.number("median"), reader.number("min"), reader.number("q1"), reader.number("q3"),
          reader.integer("repeats")};
}

ImageMetrics readMetrics(const JsonReader& reader) {
  return {.rmse = reader.number("rmse"),
          .relativeRmse = reader.numberOrInfinity("relative_rmse"),
          .psnr = reader.numberOrInfinity("psnr"),
          .ssim = reader.number("ssim"),
          .flip = reader.number("flip"),
          .maxDiff = reader.number("max_diff"),
          .p99Diff = reader.number("p99_diff"),
          .pixelsOver = reader.integer("pixels_over"),
          .pixels = reader.integer("pixels")};
}

SweepPoint readPoint(const JsonReader& reader) {
  const ErrorFigures errors = readErrors(reader.at("error"));
  return {.name = reader.get<std::string>("name"),
          .changes = readChanges(reader, "settings"),
          .whole = errors.whole,
          .mirrors = errors.mirrors,
          .gpuMs = readSpread(reader.at("gpu_ms")),
          .cpuMs = readSpread(reader.at("cpu_ms")),
          .frameMs = readSpread(reader.at("frame_ms")),
          .onFront = reader.get<bool>("on_front"),
          .picture = reader.get<std::string>("picture"),
          .heatMap = reader.get<std::string>("heat_map")};
}

SweepSeries readSeries(const JsonReader& reader, size_t pointCount) {
  SweepSeries series{
      .key = reader.get<std::string>("key"),
      .name = reader.get<std::string>("name"),
      .axis = reader.get<std::string>("axis") == "linear" ? SweepSeries::Axis::linear : SweepSeries::Axis::logarithmic,
      .x = reader.get<std::vector<double>>("x"),
      .points = reader.integers("points"),
      .note = reader.get<std::string>("note"),
      .theorySlope = reader.get<double>("theory_slope"),
      .fitted = reader.integers("fitted")};
  if (!reader.null("fit")) {
    const JsonReader fit = reader.at("fit");
    series.fit = LineFit{fit.get<double>("slope"), fit.get<double>("offset")};
  }
  const auto below = [](size_t count) { return [count](int i) { return i >= 0 && static_cast<size_t>(i) < count; }; };
  if (series.points.size() != series.x.size() ||
      !std::all_of(series.points.begin(), series.points.end(), below(pointCount))) {
    reader.fail("points");
  }
  if (!std::all_of(series.fitted.begin(), series.fitted.end(), below(series.points.size()))) {
    reader.fail("fitted");
  }
  return series;
}

}  // namespace

ErrorFigures readErrors(const JsonReader& errors) {
  ErrorFigures figures{.whole = readMetrics(errors.at("whole"))};
  if (!errors.null("mirrors")) {
    figures.mirrors = readMetrics(errors.at("mirrors"));
  }
  return figures;
}

SweepResults readSweepResults(const std::filesystem::path& file) {
  ordered_json json;
  try {
    const std::vector<uint8_t> bytes = readFile(file, 64u << 20);
    json = ordered_json::parse(bytes.begin(), bytes.end());
  } catch (const nlohmann::json::exception&) {
    throw InputError(file.string() + ": not JSON (a results.json of speculum accuracy is needed)");
  } catch (const std::runtime_error& error) {
    throw InputError(error.what());
  }
  const JsonReader reader(file, json, "");
  SweepResults results{.scene = reader.get<std::string>("scene"),
                       .title = reader.get<std::string>("title"),
                       .sweep = reader.get<std::string>("sweep"),
                       .time = reader.get<double>("time"),
                       .device = reader.get<std::string>("device"),
                       .driver = reader.get<std::string>("driver"),
                       .renderPath = reader.get<std::string>("render_path"),
                       .machine = reader.get<std::string>("machine"),
                       .version = reader.get<std::string>("version"),
                       .date = reader.get<std::string>("date"),
                       .base = readChanges(reader, "settings")};
  const std::vector<int> size = reader.integers("size");
  if (size.size() != 2) {
    reader.fail("size");
  }
  results.width = size[0];
  results.height = size[1];
  const JsonReader truth = reader.at("ground_truth");
  results.truthMs = truth.number("ms");
  results.truthThreads = truth.integer("threads");
  results.truthSamples = truth.integer("samples");
  const ErrorFigures floor = readErrors(truth.at("noise_floor"));
  results.floorWhole = floor.whole;
  results.floorMirrors = floor.mirrors;
  results.truthPicture = truth.get<std::string>("picture");
  for (const JsonReader& point : reader.items("points")) {
    results.points.push_back(readPoint(point));
  }
  for (const JsonReader& series : reader.items("series")) {
    results.series.push_back(readSeries(series, results.points.size()));
  }
  return results;
}

}  // namespace speculum
