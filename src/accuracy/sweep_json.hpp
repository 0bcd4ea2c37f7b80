#pragma once

#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "accuracy/image_metrics.hpp"
#include "scene/scene_loader.hpp"

namespace speculum {

// { "whole", "mirrors" }: metrics with their number of pixels; null for a picture without mirrors.
nlohmann::ordered_json errorsJson(const ImageMetrics& whole, const std::optional<ImageMetrics>& mirrors);

// Reads one member after another; every failure names the file and the member's place.
class JsonReader {
 public:
  JsonReader(const std::filesystem::path& file, const nlohmann::ordered_json& json, std::string place)
      : file_(file), json_(json), place_(std::move(place)) {}

  template <typename T>
  T get(const char* key) const {
    try {
      return json_.at(key).get<T>();
    } catch (const nlohmann::json::exception&) {
      fail(key);
    }
  }
  // Nothing that does not fit an int, which get<int>() would cut to one.
  int integer(const char* key) const { return integerOf(member(key), key); }
  std::vector<int> integers(const char* key) const {
    std::vector<int> values;
    const nlohmann::ordered_json& array = member(key);
    if (!array.is_array()) {
      fail(key);
    }
    for (const nlohmann::ordered_json& value : array) {
      values.push_back(integerOf(value, key));
    }
    return values;
  }
  // Finite, not negative, and no more than any figure of a sweep can be.
  double number(const char* key) const {
    const auto value = get<double>(key);
    if (!(value >= 0.0 && value <= largestFigure)) {
      fail(key);
    }
    return value;
  }
  // JSON has no infinity: null stands for it.
  double numberOrInfinity(const char* key) const {
    return member(key).is_null() ? std::numeric_limits<double>::infinity() : get<double>(key);
  }
  JsonReader at(const char* key) const { return {file_, member(key), place_ + key + "."}; }
  std::vector<JsonReader> items(const char* key) const {
    std::vector<JsonReader> readers;
    const nlohmann::ordered_json& array = member(key);
    if (!array.is_array()) {
      fail(key);
    }
    for (size_t i = 0; i < array.size(); ++i) {
      readers.emplace_back(file_, array[i], place_ + key + "[" + std::to_string(i) + "].");
    }
    return readers;
  }
  bool null(const char* key) const { return member(key).is_null(); }
  [[noreturn]] void fail(const char* key) const {
    throw InputError(file_.string() + ": " + place_ + key +
                     ": missing or of another kind (a results.json of speculum accuracy is needed)");
  }

  // Whatever it is. A copy of it, as get() would make, could overflow the stack when values are nested deeply.
  const nlohmann::ordered_json& member(const char* key) const {
    if (!json_.is_object() || !json_.contains(key)) {
      fail(key);
    }
    return json_.at(key);
  }

 private:
  static constexpr double largestFigure = 1e12;

  int integerOf(const nlohmann::ordered_json& value, const char* key) const {
    const auto fits = [](auto number) { return std::in_range<int>(number); };
    if (!(value.is_number_unsigned() ? fits(value.get<uint64_t>())
                                     : value.is_number_integer() && fits(value.get<int64_t>()))) {
      fail(key);
    }
    return value.get<int>();
  }

  const std::filesystem::path& file_;
  const nlohmann::ordered_json& json_;
  std::string place_;
};

struct ErrorFigures {
  ImageMetrics whole;
  std::optional<ImageMetrics> mirrors;
};
ErrorFigures readErrors(const JsonReader& errors);

}  // namespace speculum
