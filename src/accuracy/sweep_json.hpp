#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "accuracy/sweep_results.hpp"

namespace speculum {

// Throws std::runtime_error, or nlohmann's exceptions for what is no JSON. Members of an object are found in time
// proportional to their number, which is limited before they are read.
nlohmann::ordered_json parseJson(const std::vector<uint8_t>& bytes);

// Returns results.json of `speculum accuracy`.
nlohmann::ordered_json sweepJson(const SweepResults& results);

// Throws InputError "FILE: key: what is wrong (what would be right)" for a file that is no sweep's results.json.
SweepResults readSweepResults(const std::filesystem::path& file);

// { "whole", "mirrors" }: metrics with their number of pixels; null for a picture without mirrors.
nlohmann::ordered_json errorsJson(const ErrorFigures& errors);

// Members of a JSON object, each checked for its kind. Every failure throws InputError with the file and the member's
// path. Keeps references to its arguments.
class JsonReader {
 public:
  JsonReader(const std::filesystem::path& file, const nlohmann::ordered_json& json, std::string path = {})
      : file_(file), json_(json), path_(std::move(path)) {}

  template <typename T>
  T get(const char* key) const {
    try {
      return json_.at(key).get<T>();
    } catch (const nlohmann::json::exception&) {
      fail(key);
    }
  }
  // Returns a number that fits an int, while get<int>() would truncate any other.
  int integer(const char* key) const { return integerOf(member(key), key); }
  std::vector<int> integers(const char* key) const;
  // Finite, not negative, and no more than any figure of a sweep can be.
  double number(const char* key) const;
  // JSON has no infinity: null stands for it.
  double numberOrInfinity(const char* key) const;
  ErrorFigures errors(const char* key) const;
  JsonReader at(const char* key) const { return {file_, member(key), path_ + key + "."}; }
  std::vector<JsonReader> items(const char* key) const;
  bool null(const char* key) const { return member(key).is_null(); }
  // Returns the member itself, because a copy, as get() makes, could overflow the stack when values are nested deeply.
  const nlohmann::ordered_json& member(const char* key) const;
  [[noreturn]] void fail(const char* key) const;

 private:
  const nlohmann::ordered_json& array(const char* key) const;
  int integerOf(const nlohmann::ordered_json& value, const char* key) const;

  const std::filesystem::path& file_;
  const nlohmann::ordered_json& json_;
  std::string path_;
};

}  // namespace speculum
