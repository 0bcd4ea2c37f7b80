#include "accuracy/sweep_store.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "accuracy/sweep_json.hpp"
#include "image/exr.hpp"
#include "image/picture_files.hpp"
#include "platform/files.hpp"

namespace speculum {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

// Returns nothing for a file that is absent or broken: its contents are measured again.
std::optional<ordered_json> readJson(const fs::path& file) {
  if (!isFile(file)) {
    return std::nullopt;
  }
  try {
    const std::vector<uint8_t> bytes = readFile(file);
    return parseJson(bytes);
  } catch (const std::exception&) {
    spdlog::warn("{}: unreadable, what it held is measured again", file.string());
    return std::nullopt;
  }
}

Image8 maskImage(const PixelMask& mask) {
  Image8 image(mask.width, mask.height);
  for (size_t i = 0; i < mask.selected.size(); ++i) {
    std::fill_n(&image.rgba[4 * i], 3, static_cast<uint8_t>(mask.selected[i] ? 255 : 0));
  }
  return image;
}

Measurement readMeasurement(const fs::path& file, const ordered_json& json) {
  const JsonReader reader(file, json);
  Measurement m{.picture = reader.get<std::string>("picture"),
                .heatMap = reader.get<std::string>("heat_map"),
                .gpuMs = reader.get<std::vector<double>>("gpu_ms"),
                .cpuMs = reader.get<std::vector<double>>("cpu_ms"),
                .frameMs = reader.get<std::vector<double>>("frame_ms")};
  if (!reader.null("error")) {
    m.errors = reader.errors("error");
  }
  return m;
}

}  // namespace

SweepStore::SweepStore(fs::path folder) : folder_(std::move(folder)) {
  if (folder_.empty()) {
    return;
  }
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error || !isFolder(folder_)) {
    throw std::runtime_error(folder_.string() + ": cannot be made (a folder in a writable place is needed)");
  }
  load();
}

void SweepStore::load() {
  const fs::path file = folder_ / "measurements.json";
  const std::optional<ordered_json> json = readJson(file);
  if (!json) {
    return;
  }
  try {
    for (const auto& [key, value] : json->items()) {
      Measurement measurement = readMeasurement(file, value);
      const auto kept = [&](const std::string& name) { return name.empty() || isFile(folder_ / name); };
      if (!kept(measurement.picture) || !kept(measurement.heatMap)) {
        measurement.errors.reset();
      }
      measurements_[key] = std::move(measurement);
    }
  } catch (const std::exception& problem) {
    spdlog::warn("{}", problem.what());
    measurements_.clear();
  }
}

void SweepStore::save() const {
  if (folder_.empty()) {
    return;
  }
  ordered_json json = ordered_json::object();
  for (const auto& [key, m] : measurements_) {
    json[key] = {{"picture", m.picture}, {"heat_map", m.heatMap}, {"gpu_ms", m.gpuMs},
                 {"cpu_ms", m.cpuMs},    {"frame_ms", m.frameMs}, {"error", nullptr}};
    if (m.errors) {
      json[key]["error"] = errorsJson(*m.errors);
    }
  }
  replaceFile(folder_ / "measurements.json", json.dump(-1, ' ', false, ordered_json::error_handler_t::replace));
}

std::optional<GroundTruth> SweepStore::truth(const std::string& key) const {
  const fs::path base = folder_ / ("truth-" + key);
  const std::optional<ordered_json> json = folder_.empty() ? std::nullopt : readJson(base.string() + ".json");
  if (!json) {
    return std::nullopt;
  }
  try {
    const JsonReader reader(base, *json);
    GroundTruth truth{.image = readExr(base.string() + ".exr"),
                      .mirrors = readPixelMask(base.string() + "-mirrors.png"),
                      .floor = reader.errors("floor"),
                      .ms = reader.get<double>("ms"),
                      .threads = reader.get<int>("threads"),
                      .throughputBeyond = reader.get<std::vector<double>>("throughput_beyond")};
    return truth;
  } catch (const std::exception& problem) {
    spdlog::warn("{}", problem.what());
    return std::nullopt;
  }
}

void SweepStore::keepTruth(const std::string& key, const GroundTruth& truth) const {
  if (folder_.empty()) {
    return;
  }
  const std::string base = (folder_ / ("truth-" + key)).string();
  writeExr(base + ".exr", truth.image);
  writePng(base + "-mirrors.png", maskImage(truth.mirrors));
  const ordered_json json = {{"floor", errorsJson(truth.floor)},
                             {"ms", truth.ms},
                             {"threads", truth.threads},
                             {"throughput_beyond", truth.throughputBeyond}};
  // This file comes last: its presence means that the others are complete.
  replaceFile(base + ".json", json.dump());
}

std::string SweepStore::keepPicture(const std::string& name, const Image8& image) const {
  if (folder_.empty()) {
    return {};
  }
  writePng(folder_ / name, image);
  return name;
}

}  // namespace speculum
