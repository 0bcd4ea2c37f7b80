#include "accuracy/sweep_json.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "platform/files.hpp"
#include "scene/input_error.hpp"

namespace speculum {

namespace {

using nlohmann::ordered_json;

constexpr double largestFigure = 1e12;

}  // namespace

NLOHMANN_JSON_SERIALIZE_ENUM(SweepSeries::Axis,
                             {{SweepSeries::Axis::logarithmic, "logarithmic"}, {SweepSeries::Axis::linear, "linear"}})

void members(auto&& json, Of<Spread> auto& spread) {
  json.figure("median", spread.median);
  json.figure("min", spread.minimum);
  json.figure("q1", spread.lowerQuartile);
  json.figure("q3", spread.upperQuartile);
  json("repeats", spread.repeats);
}

void members(auto&& json, Of<SweepPoint> auto& point) {
  json("name", point.name);
  json("settings", point.changes);
  json("on_front", point.onFront);
  json.object("error", [&](auto&& error) {
    error("whole", point.whole);
    error("mirrors", point.mirrors);
    error.sometimes("flicker", point.flicker);
  });
  json("gpu_ms", point.gpuMs);
  json("cpu_ms", point.cpuMs);
  json("frame_ms", point.frameMs);
  json("picture", point.picture);
  json("heat_map", point.heatMap);
  json.sometimes("frames", point.frames);
}

void members(auto&& json, Of<SweepMotion> auto& motion) {
  json("path", motion.path);
  json("frames", motion.frames);
  json.figure("fps", motion.fps);
}

void members(auto&& json, Of<SweepSeries> auto& series) {
  json("key", series.key);
  json("name", series.name);
  json("axis", series.axis);
  json("x", series.x);
  json("points", series.points);
  json("note", series.note);
}

void members(auto&& json, Of<SweepResults> auto& results) {
  json("scene", results.scene);
  json("title", results.title);
  json("sweep", results.sweep);
  json.pair("size", results.width, results.height);
  json("time", results.time);
  json.sometimes("motion", results.motion);
  json("device", results.device);
  json("driver", results.driver);
  json("render_path", results.renderPath);
  json("machine", results.machine);
  json("version", results.version);
  json("date", results.date);
  json("settings", results.base);
  json.object("ground_truth", [&](auto&& truth) {
    truth("samples", results.truthSamples);
    truth.figure("ms", results.truthMs);
    truth("threads", results.truthThreads);
    truth("noise_floor", results.floor);
    truth("picture", results.truthPicture);
    truth.sometimes("frames", results.truthFrames);
  });
  json("points", results.points);
  json("series", results.series);
}

ordered_json parseJson(const std::vector<uint8_t>& bytes) {
  constexpr int mostMembers = 10'000;
  std::vector<int> members;  // numbers of members of the objects around
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

ordered_json metricsJson(const ImageMetrics& m) {
  JsonWriter json;
  members(json, m);
  json.written.erase("pixels");
  return std::move(json.written);
}

ordered_json comparisonJson(const Comparison& comparison) {
  ordered_json json = metricsJson(comparison.whole);
  if (comparison.masked) {
    json["mask"] = metricsJson(*comparison.masked);
  }
  return json;
}

ordered_json sweepJson(const SweepResults& results) {
  JsonWriter json;
  members(json, results);
  return std::move(json.written);
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
  SweepResults results;
  members(reader, results);
  const auto below = [](size_t count) { return [count](int i) { return i >= 0 && static_cast<size_t>(i) < count; }; };
  for (size_t i = 0; i < results.series.size(); ++i) {
    const SweepSeries& series = results.series[i];
    const std::string path = "series[" + std::to_string(i) + "].";
    if (series.points.size() != series.x.size() || !std::ranges::all_of(series.points, below(results.points.size()))) {
      reader.fail(path + "points");
    }
  }
  return results;
}

ordered_json JsonWriter::jsonOf(const std::vector<SettingChange>& changes) {
  ordered_json json = ordered_json::object();
  for (const SettingChange& change : changes) {
    json[change.key] = change.value;
  }
  return json;
}

void JsonReader::figure(const char* key, double& value) const {
  (*this)(key, value);
  if (!(value >= 0.0 && value <= largestFigure)) {
    fail(key);
  }
}

void JsonReader::orInfinity(const char* key, double& value) const {
  value = std::numeric_limits<double>::infinity();
  if (!member(key).is_null()) {
    (*this)(key, value);
  }
}

void JsonReader::pair(const char* key, int& first, int& second) const {
  std::vector<int> both;
  (*this)(key, both);
  if (both.size() != 2) {
    fail(key);
  }
  first = both[0];
  second = both[1];
}

void JsonReader::read(const std::string& key, const ordered_json& json, std::vector<SettingChange>& changes) const {
  if (!json.is_object()) {
    fail(key);
  }
  for (const auto& [name, value] : json.items()) {
    if (!value.is_string()) {
      fail(key);
    }
    changes.push_back({name, value.get<std::string>()});
  }
}

const ordered_json& JsonReader::member(const char* key) const {
  if (!json_.is_object() || !json_.contains(key)) {
    fail(key);
  }
  return json_.at(key);
}

int JsonReader::integerOf(const ordered_json& value, const std::string& key) const {
  const auto fits = [](auto number) { return std::in_range<int>(number); };
  if (!(value.is_number_unsigned() ? fits(value.get<uint64_t>())
                                   : value.is_number_integer() && fits(value.get<int64_t>()))) {
    fail(key);
  }
  return value.get<int>();
}

void JsonReader::fail(const std::string& key) const {
  throw InputError(file_.string() + ": " + path_ + key +
                   ": missing or of another kind (a results.json of speculum accuracy is needed)");
}

}  // namespace speculum
