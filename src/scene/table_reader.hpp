#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace speculum {

// The numbers that a key takes; never infinite or NaN.
struct Range {
  double low = -std::numeric_limits<double>::max();
  double high = std::numeric_limits<double>::max();
  bool aboveLow = false;  // low itself is out

  bool contains(double value) const;
  std::string text() const;  // "a number in 0 .. 1"
};

inline constexpr Range kAny{};
inline constexpr Range kNotNegative{.low = 0.0};
inline constexpr Range kPositive{.low = 0.0, .aboveLow = true};
// Metres and degrees, and metres that are lengths: squares of sums and products of several of them are still doubles.
inline constexpr Range kCoordinate{.low = -1e15, .high = 1e15};
inline constexpr Range kLength{.low = 0.0, .high = 1e15, .aboveLow = true};
// Degrees per second: times any number of seconds is still a double.
inline constexpr Range kTurn{.low = -1e9, .high = 1e9};
inline constexpr Range kUnit{.low = 0.0, .high = 1.0};

// One table of a scene file. Every getter throws InputError with file, line and full key for a wrong type or a value
// out of range; those with a fallback return it when the key is absent, the others then throw as well.
class TableReader {
 public:
  // Throws for a key that is not among `known`. `label` is the table's full key, empty for the whole file. `file`,
  // `table` and `known` must outlive the reader.
  TableReader(const std::filesystem::path& file, std::string label, const toml::table& table, int line,
              std::span<const std::string_view> known);
  // Takes any key.
  TableReader(const std::filesystem::path& file, std::string label, const toml::table& table, int line);

  bool has(std::string_view key) const { return table_.contains(key); }
  int line() const { return line_; }
  int line(std::string_view key) const;  // the table's own when the key is absent
  const std::string& label() const { return label_; }
  const toml::table& table() const { return table_; }

  double number(std::string_view key, double fallback, const Range& range = kAny) const;
  int64_t integer(std::string_view key, int64_t fallback, int64_t low, int64_t high) const;
  bool boolean(std::string_view key, bool fallback) const;
  std::string text(std::string_view key, const std::string& fallback) const;
  std::string text(std::string_view key) const;
  glm::dvec3 vec3(std::string_view key, const glm::dvec3& fallback, const Range& range = kAny) const;
  glm::dvec3 vec3(std::string_view key, const Range& range = kAny) const;
  glm::dvec2 vec2(std::string_view key, const Range& range) const;
  // A number stands for three equal ones.
  glm::dvec3 numberOrVec3(std::string_view key, const glm::dvec3& fallback) const;
  std::vector<glm::dvec3> points(std::string_view key) const;
  // The place of the text among `choices`.
  size_t choice(std::string_view key, size_t fallback, std::span<const std::string_view> choices) const;

  std::optional<TableReader> subtable(std::string_view key, std::span<const std::string_view> known) const;
  std::optional<TableReader> subtable(std::string_view key) const;  // takes any key
  // [[key]] tables; each is labelled with its name, or else its index.
  std::vector<TableReader> tables(std::string_view key, std::span<const std::string_view> known) const;

  [[noreturn]] void fail(std::string_view key, std::string_view wrong, std::string_view right) const;
  [[noreturn]] void failAt(const toml::node& node, std::string_view key, std::string_view wrong,
                           std::string_view right) const;

 private:
  std::string fullKey(std::string_view key) const;
  const toml::table* tableOf(std::string_view key) const;
  const toml::node& required(std::string_view key, std::string_view right) const;
  double numberOf(const toml::node& node, std::string_view key, const Range& range) const;
  std::vector<double> numbersOf(const toml::node& node, std::string_view key, size_t count, const Range& range) const;
  glm::dvec3 vec3Of(const toml::node& node, std::string_view key, const Range& range) const;

  const std::filesystem::path& file_;
  std::string label_;
  const toml::table& table_;
  int line_ = 1;
};

// "a string", "a table" ...: what an error says that a value is.
std::string_view typeName(const toml::node& node);

}  // namespace speculum
