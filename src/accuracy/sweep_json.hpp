#pragma once

#include <cmath>
#include <concepts>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "accuracy/sweep_results.hpp"

namespace speculum {

// Parses a file's content. Throws std::runtime_error, or nlohmann's exceptions if it is no JSON. Finding a member of an
// object takes time proportional to the number of members, which is limited before they are read.
nlohmann::ordered_json parseJson(const std::vector<uint8_t>& bytes);

// Returns { "rmse", "relative_rmse", "psnr", "ssim", "flip", "max_diff", "p99_diff", "pixels_over" }. JSON has no
// infinity: null stands for it.
nlohmann::ordered_json metricsJson(const ImageMetrics& metrics);

// Returns metricsJson() of the whole picture, with metricsJson() of the masked pixels under "mask" if there is a mask.
nlohmann::ordered_json comparisonJson(const Comparison& comparison);

// Returns results.json of `speculum accuracy`.
nlohmann::ordered_json sweepJson(const SweepResults& results);

// Reads results.json. Throws InputError "FILE: key: what is wrong (what would be right)" for a file that is no sweep's
// results.json.
SweepResults readSweepResults(const std::filesystem::path& file);

// members(json, value) lists the members of a type with their keys once, for a JsonWriter and for a JsonReader.
class JsonWriter;
template <typename T>
concept HasMembers = requires(JsonWriter& json, T& value) {
  members(json, value);
};

// Writes members of a JSON object.
class JsonWriter {
 public:
  void operator()(const char* key, const auto& value) { written[key] = jsonOf(value); }
  void figure(const char* key, double value) { written[key] = value; }
  // JSON has no infinity: null stands for it.
  void orInfinity(const char* key, double value) {
    written[key] = std::isfinite(value) ? nlohmann::ordered_json(value) : nullptr;
  }
  void pair(const char* key, int first, int second) { written[key] = {first, second}; }
  // Leaves out a value that says nothing.
  template <typename T>
  void sometimes(const char* key, const T& value) {
    if (value != T()) {
      (*this)(key, value);
    }
  }
  void object(const char* key, const auto& membersOf) {
    JsonWriter inner;
    membersOf(inner);
    written[key] = std::move(inner.written);
  }

  nlohmann::ordered_json written = nlohmann::ordered_json::object();

 private:
  template <typename T>
  static nlohmann::ordered_json jsonOf(const T& value) {
    if constexpr (HasMembers<const T>) {
      JsonWriter inner;
      members(inner, value);
      return std::move(inner.written);
    } else {
      return value;
    }
  }
  template <typename T>
  static nlohmann::ordered_json jsonOf(const std::optional<T>& value) {
    return value ? jsonOf(*value) : nullptr;
  }
  template <typename T>
  static nlohmann::ordered_json jsonOf(const std::vector<T>& values) {
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const T& value : values) {
      json.push_back(jsonOf(value));
    }
    return json;
  }
  static nlohmann::ordered_json jsonOf(const std::vector<SettingChange>& changes);
};

// Reads members of a JSON object, each checked for its kind. Every failure throws InputError with the file and the
// member's path. Keeps references to its arguments.
class JsonReader {
 public:
  JsonReader(const std::filesystem::path& file, const nlohmann::ordered_json& json, std::string path = {})
      : file_(file), json_(json), path_(std::move(path)) {}

  void operator()(const char* key, auto& value) const { read(key, member(key), value); }
  // Reads a number that is finite, not negative, and no more than any figure of a sweep can be.
  void figure(const char* key, double& value) const;
  void orInfinity(const char* key, double& value) const;
  void pair(const char* key, int& first, int& second) const;
  void sometimes(const char* key, auto& value) const {
    if (json_.is_object() && json_.contains(key)) {
      (*this)(key, value);
    }
  }
  void object(const char* key, const auto& membersOf) const {
    membersOf(JsonReader(file_, member(key), path_ + key + "."));
  }
  [[noreturn]] void fail(const std::string& key) const;

 private:
  // Returns the member itself, because a copy, as get() makes, could overflow the stack when values are nested deeply.
  const nlohmann::ordered_json& member(const char* key) const;
  // Returns a number that fits an int, while get<int>() would truncate any other.
  int integerOf(const nlohmann::ordered_json& json, const std::string& key) const;

  template <typename T>
  void read(const std::string& key, const nlohmann::ordered_json& json, T& value) const {
    if constexpr (HasMembers<T>) {
      members(JsonReader(file_, json, path_ + key + "."), value);
    } else if constexpr (std::integral<T> && !std::same_as<T, bool>) {
      value = integerOf(json, key);
    } else {
      try {
        value = json.get<T>();
      } catch (const nlohmann::json::exception&) {
        fail(key);
      }
      // The library turns a name that it does not know into the first enumerator.
      if (std::is_enum_v<T> && nlohmann::ordered_json(value) != json) {
        fail(key);
      }
    }
  }
  template <typename T>
  void read(const std::string& key, const nlohmann::ordered_json& json, std::optional<T>& value) const {
    value.reset();
    if (!json.is_null()) {
      read(key, json, value.emplace());
    }
  }
  template <typename T>
  void read(const std::string& key, const nlohmann::ordered_json& json, std::vector<T>& values) const {
    if (!json.is_array()) {
      fail(key);
    }
    // Reads one by one, so that the first wrong element of a hostile file ends reading before the others take memory.
    values.clear();
    for (size_t i = 0; i < json.size(); ++i) {
      read(HasMembers<T> ? key + "[" + std::to_string(i) + "]" : key, json[i], values.emplace_back());
    }
  }
  void read(const std::string& key, const nlohmann::ordered_json& json, std::vector<SettingChange>& changes) const;

  const std::filesystem::path& file_;
  const nlohmann::ordered_json& json_;
  std::string path_;
};

template <typename T, typename Plain>
concept Of = std::same_as<std::remove_const_t<T>, Plain>;

void members(auto&& json, Of<ImageMetrics> auto& metrics) {
  json.figure("rmse", metrics.rmse);
  json.orInfinity("relative_rmse", metrics.relativeRmse);
  json.orInfinity("psnr", metrics.psnr);
  json.figure("ssim", metrics.ssim);
  json.figure("flip", metrics.flip);
  json.figure("max_diff", metrics.maxDiff);
  json.figure("p99_diff", metrics.p99Diff);
  json("pixels_over", metrics.pixelsOver);
  json("pixels", metrics.pixels);
}

// `mirrors` is null for a picture without mirrors.
void members(auto&& json, Of<ErrorFigures> auto& errors) {
  json("whole", errors.whole);
  json("mirrors", errors.mirrors);
  json.sometimes("flicker", errors.flicker);
}

}  // namespace speculum
