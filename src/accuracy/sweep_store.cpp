#include "accuracy/sweep_store.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "accuracy/sweep_json.hpp"
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

// Says whether a path relative to the folder leads to a place in the folder, also when links are followed.
bool isInside(const fs::path& folder, const fs::path& file) {
  return isBelow(withoutLinks(folder / file), withoutLinks(folder));
}

Image8 maskImage(const PixelMask& mask) {
  Image8 image(mask.width, mask.height);
  for (size_t i = 0; i < mask.selected.size(); ++i) {
    std::fill_n(&image.rgba[4 * i], 3, static_cast<uint8_t>(mask.selected[i] ? 255 : 0));
  }
  return image;
}

}  // namespace

void members(auto&& json, Of<Measurement> auto& measurement) {
  json("drawn", measurement.drawn);
  json("picture", measurement.picture);
  json("heat_map", measurement.heatMap);
  json.sometimes("frames", measurement.frames);
  json("gpu_ms", measurement.gpuMs);
  json("cpu_ms", measurement.cpuMs);
  json("frame_ms", measurement.frameMs);
  json("error", measurement.errors);
}

// Image and mask have files of their own.
void members(auto&& json, Of<GroundTruth> auto& truth) {
  json("floor", truth.floor);
  json("ms", truth.ms);
  json("threads", truth.threads);
}

SweepStore::SweepStore(fs::path folder) : folder_(std::move(folder)) {
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error || !isFolder(folder_)) {
    throw std::runtime_error(folder_.string() + ": cannot be made (a folder in a writable place is needed)");
  }
  const fs::path file = fileNamed("measurements.json");
  const std::optional<ordered_json> json = readJson(file);
  if (!json) {
    return;
  }
  try {
    for (const auto& [key, value] : json->items()) {
      Measurement measurement;
      members(JsonReader(file, value), measurement);
      // The folder may come from somebody else, and the report embeds these pictures.
      const auto kept = [&](const std::string& name) { return isInside(folder_, name) && isFile(folder_ / name); };
      if (!kept(measurement.picture) || !kept(measurement.heatMap) || !std::ranges::all_of(measurement.frames, kept)) {
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
  JsonWriter json;
  for (const auto& [key, measurement] : measurements_) {
    json(key.c_str(), measurement);
  }
  replaceFile(fileNamed("measurements.json"),
              json.written.dump(-1, ' ', false, ordered_json::error_handler_t::replace));
}

std::optional<GroundTruth> SweepStore::truth(const std::string& key) const {
  const std::string base = "truth-" + key;
  const std::optional<ordered_json> json = readJson(fileNamed(base + ".json"));
  if (!json) {
    return std::nullopt;
  }
  try {
    GroundTruth truth{.image = readExr(fileNamed(base + ".exr")),
                      .mirrors = readPixelMask(fileNamed(base + "-mirrors.png"))};
    members(JsonReader(fileNamed(base + ".json"), *json), truth);
    if (truth.floor.whole.pixels > 0) {
      truth.second = readImage8(fileNamed(base + "-second.png"));
      if (truth.second.width != truth.image.width || truth.second.height != truth.image.height) {
        throw FileError(fileNamed(base + "-second.png"), "has another size than the reference", "it is traced again");
      }
    }
    return truth;
  } catch (const std::exception& problem) {
    spdlog::warn("{}", problem.what());
    return std::nullopt;
  }
}

void SweepStore::keepTruth(const std::string& key, const GroundTruth& truth) const {
  const std::string base = "truth-" + key;
  writeExr(fileNamed(base + ".exr"), truth.image);
  writePng(fileNamed(base + "-mirrors.png"), maskImage(truth.mirrors));
  if (truth.second.width > 0) {
    writePng(fileNamed(base + "-second.png"), truth.second);
  }
  JsonWriter json;
  members(json, truth);
  // This file comes last: its presence means that the others are complete.
  replaceFile(fileNamed(base + ".json"), json.written.dump());
}

std::string SweepStore::keepPicture(const std::string& name, const Image8& image) const {
  writePng(fileNamed(name), image);
  return name;
}

fs::path SweepStore::fileNamed(const std::string& name) const {
  if (!isInside(folder_, name)) {
    throw FileError(folder_ / name, "leads out of the folder", "remove the link");
  }
  return folder_ / name;
}

}  // namespace speculum
