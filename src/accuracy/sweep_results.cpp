#include "accuracy/sweep_results.hpp"

#include <nlohmann/json.hpp>

#include "accuracy/sweep_json.hpp"
#include "platform/text.hpp"

namespace speculum {

namespace {

using nlohmann::ordered_json;

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

std::string settingsText(const std::vector<SettingChange>& changes) {
  std::string text;
  for (const SettingChange& change : changes) {
    text += (text.empty() ? "" : " ") + change.key + "=" + change.value;
  }
  return text;
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
  text += results.motion ? ",flicker\r\n" : "\r\n";
  for (const SweepPoint& point : results.points) {
    text += csvField(point.name) + "," + csvField(settingsText(point.changes)) + (point.onFront ? ",1" : ",0");
    for (const Spread& spread : {point.gpuMs, point.cpuMs, point.frameMs}) {
      appendSpread(text, spread);
    }
    text += "," + std::to_string(point.gpuMs.repeats);
    appendMetrics(text, point.whole);
    appendMetrics(text, point.mirrors);
    text += (results.motion ? "," + ordered_json(point.flicker.value_or(0.0)).dump() : "") + "\r\n";
  }
  return text;
}

}  // namespace speculum
