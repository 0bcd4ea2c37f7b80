#include "accuracy/sweep_results.hpp"

#include <nlohmann/json.hpp>

#include "accuracy/sweep_json.hpp"

namespace speculum {

namespace {

using nlohmann::ordered_json;

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
          {"error", errorsJson(point.whole, point.mirrors)},
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

std::string csvField(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) {
    return text;
  }
  std::string quoted = "\"";
  for (const char c : text) {
    quoted += c == '"' ? "\"\"" : std::string(1, c);
  }
  return quoted + "\"";
}

void appendMetrics(std::string& line, const std::optional<ImageMetrics>& metrics) {
  const ordered_json json = metricsJson(metrics.value_or(ImageMetrics{}));
  for (const auto& [key, value] : json.items()) {
    line += "," + (metrics && !value.is_null() ? value.dump() : std::string());
  }
}

void appendSpread(std::string& line, const Spread& spread) {
  for (const double value : {spread.median, spread.minimum, spread.lowerQuartile, spread.upperQuartile}) {
    line += "," + ordered_json(value).dump();
  }
}

}  // namespace

ordered_json errorsJson(const ImageMetrics& whole, const std::optional<ImageMetrics>& mirrors) {
  const auto counted = [](const ImageMetrics& metrics) {
    ordered_json json = metricsJson(metrics);
    json["pixels"] = metrics.pixels;
    return json;
  };
  ordered_json json = {{"whole", counted(whole)}};
  json["mirrors"] = mirrors ? counted(*mirrors) : ordered_json(nullptr);
  return json;
}

std::string settingsText(const std::vector<SettingChange>& changes) {
  std::string text;
  for (const SettingChange& change : changes) {
    text += (text.empty() ? "" : " ") + change.key + "=" + change.value;
  }
  return text;
}

double seriesError(const SweepPoint& point) {
  return point.mirrors ? point.mirrors->rmse : point.whole.rmse;
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
                         {"noise_floor", errorsJson(r.floorWhole, r.floorMirrors)},
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

std::string sweepCsv(const SweepResults& results) {
  std::string text = "name,settings,on_front";
  for (const char* times : {"gpu_ms", "cpu_ms", "frame_ms"}) {
    for (const char* part : {"_median", "_min", "_q1", "_q3"}) {
      text += std::string(",") + times + part;
    }
  }
  text += ",repeats";
  for (const char* prefix : {"", "mirrors_"}) {
    const ordered_json names = metricsJson({});
    for (const auto& [key, value] : names.items()) {
      text += "," + std::string(prefix) + key;
    }
  }
  text += "\r\n";
  for (const SweepPoint& point : results.points) {
    text += csvField(point.name) + "," + csvField(settingsText(point.changes)) + (point.onFront ? ",1" : ",0");
    for (const Spread& spread : {point.gpuMs, point.cpuMs, point.frameMs}) {
      appendSpread(text, spread);
    }
    text += "," + std::to_string(point.gpuMs.repeats);
    appendMetrics(text, point.whole);
    appendMetrics(text, point.mirrors);
    text += "\r\n";
  }
  return text;
}

}  // namespace speculum
