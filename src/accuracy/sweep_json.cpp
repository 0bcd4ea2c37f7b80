#include "accuracy/sweep_json.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "platform/files.hpp"
#include "scene/scene_loader.hpp"

namespace speculum {

namespace {

using nlohmann::ordered_json;

constexpr double largestFigure = 1e12;

ordered_json changesJson(const std::vector<SettingChange>& changes) {
  ordered_json json = ordered_json::object();
  for (const SettingChange& change : changes) {
    json[change.key] = change.value;
  }
  return json;
}

ordered_json spreadJson(const Spread& spread) {
  return {{"median", spread.median},
          {"min", spread.minimum},
          {"q1", spread.lowerQuartile},
          {"q3", spread.upperQuartile},
          {"repeats", spread.repeats}};
}

ordered_json pointJson(const SweepPoint& point) {
  return {{"name", point.name},
          {"settings", changesJson(point.changes)},
          {"on_front", point.onFront},
          {"error", errorsJson({point.whole, point.mirrors})},
          {"gpu_ms", spreadJson(point.gpuMs)},
          {"cpu_ms", spreadJson(point.cpuMs)},
          {"frame_ms", spreadJson(point.frameMs)},
          {"picture", point.picture},
          {"heat_map", point.heatMap}};
}

ordered_json seriesJson(const SweepSeries& series) {
  ordered_json json = {{"key", series.key},
                       {"name", series.name},
                       {"axis", series.axis == SweepSeries::Axis::linear ? "linear" : "logarithmic"},
                       {"x", series.x},
                       {"points", series.points},
                       {"note", series.note},
                       {"theory_slope", series.theorySlope},
                       {"fitted", series.fitted}};
  json["fit"] = series.fit ? ordered_json{{"slope", series.fit->slope}, {"offset", series.fit->offset}} : nullptr;
  return json;
}

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
  const ErrorFigures errors = reader.errors("error");
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
  if (series.points.size() != series.x.size() || !std::ranges::all_of(series.points, below(pointCount))) {
    reader.fail("points");
  }
  if (!std::ranges::all_of(series.fitted, below(series.points.size()))) {
    reader.fail("fitted");
  }
  return series;
}

}  // namespace

ordered_json parseJson(const std::vector<uint8_t>& bytes) {
  constexpr int mostMembers = 10'000;
  std::vector<int> members;  // of the objects around
  return ordered_json::parse(bytes.begin(), bytes.end(), [&](int, ordered_json::parse_event_t event, ordered_json&) {
    if (event == ordered_json::parse_event_t::object_start) {
      members.push_back(0);
    } else if (event == ordered_json::parse_event_t::object_end) {
      members.pop_back();
    } else if (event == ordered_json::parse_event_t::key && ++members.back() > mostMembers) {
      throw std::runtime_error("an object has more than 10000 members");
    }
    return true;
  });
}

ordered_json errorsJson(const ErrorFigures& errors) {
  const auto counted = [](const ImageMetrics& metrics) {
    ordered_json json = metricsJson(metrics);
    json["pixels"] = metrics.pixels;
    return json;
  };
  ordered_json json = {{"whole", counted(errors.whole)}};
  json["mirrors"] = errors.mirrors ? counted(*errors.mirrors) : ordered_json(nullptr);
  return json;
}

ordered_json sweepJson(const SweepResults& r) {
  ordered_json json = {{"scene", r.scene},
                       {"title", r.title},
                       {"sweep", r.sweep},
                       {"size", {r.width, r.height}},
                       {"time", r.time},
                       {"device", r.device},
                       {"driver", r.driver},
                       {"render_path", r.renderPath},
                       {"machine", r.machine},
                       {"version", r.version},
                       {"date", r.date},
                       {"settings", changesJson(r.base)},
                       {"ground_truth",
                        {{"samples", r.truthSamples},
                         {"ms", r.truthMs},
                         {"threads", r.truthThreads},
                         {"noise_floor", errorsJson(r.floor)},
                         {"picture", r.truthPicture}}}};
  json["points"] = ordered_json::array();
  for (const SweepPoint& point : r.points) {
    json["points"].push_back(pointJson(point));
  }
  json["series"] = ordered_json::array();
  for (const SweepSeries& series : r.series) {
    json["series"].push_back(seriesJson(series));
  }
  return json;
}

SweepResults readSweepResults(const std::filesystem::path& file) {
  ordered_json json;
  try {
    const std::vector<uint8_t> bytes = readFile(file, 64u << 20);
    json = parseJson(bytes);
  } catch (const nlohmann::json::exception&) {
    throw InputError(file.string() + ": not JSON (a results.json of speculum accuracy is needed)");
  } catch (const FileError& error) {
    throw InputError(error.what());
  } catch (const std::runtime_error& error) {
    throw InputError(file.string() + ": " + error.what() + " (a results.json of speculum accuracy is needed)");
  }
  const JsonReader reader(file, json);
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
  results.floor = truth.errors("noise_floor");
  results.truthPicture = truth.get<std::string>("picture");
  for (const JsonReader& point : reader.items("points")) {
    results.points.push_back(readPoint(point));
  }
  for (const JsonReader& series : reader.items("series")) {
    results.series.push_back(readSeries(series, results.points.size()));
  }
  return results;
}

const ordered_json& JsonReader::member(const char* key) const {
  if (!json_.is_object() || !json_.contains(key)) {
    fail(key);
  }
  return json_.at(key);
}

const ordered_json& JsonReader::array(const char* key) const {
  const ordered_json& value = member(key);
  if (!value.is_array()) {
    fail(key);
  }
  return value;
}

int JsonReader::integerOf(const ordered_json& value, const char* key) const {
  const auto fits = [](auto number) { return std::in_range<int>(number); };
  if (!(value.is_number_unsigned() ? fits(value.get<uint64_t>())
                                   : value.is_number_integer() && fits(value.get<int64_t>()))) {
    fail(key);
  }
  return value.get<int>();
}

std::vector<int> JsonReader::integers(const char* key) const {
  std::vector<int> values;
  for (const ordered_json& value : array(key)) {
    values.push_back(integerOf(value, key));
  }
  return values;
}

double JsonReader::number(const char* key) const {
  const auto value = get<double>(key);
  if (!(value >= 0.0 && value <= largestFigure)) {
    fail(key);
  }
  return value;
}

double JsonReader::numberOrInfinity(const char* key) const {
  return null(key) ? std::numeric_limits<double>::infinity() : get<double>(key);
}

ErrorFigures JsonReader::errors(const char* key) const {
  const JsonReader reader = at(key);
  ErrorFigures figures{.whole = readMetrics(reader.at("whole"))};
  if (!reader.null("mirrors")) {
    figures.mirrors = readMetrics(reader.at("mirrors"));
  }
  return figures;
}

std::vector<JsonReader> JsonReader::items(const char* key) const {
  std::vector<JsonReader> readers;
  for (const ordered_json& value : array(key)) {
    readers.emplace_back(file_, value, path_ + key + "[" + std::to_string(readers.size()) + "].");
  }
  return readers;
}

void JsonReader::fail(const char* key) const {
  throw InputError(file_.string() + ": " + path_ + key +
                   ": missing or of another kind (a results.json of speculum accuracy is needed)");
}

}  // namespace speculum
