#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/value_range.hpp"

namespace speculum {

// One table of a TOML file. Every getter throws InputError with file, line and full key for a wrong type or a value out
// of range, and for an absent key unless it takes a fallback.
class TableReader {
 public:
  // Throws InputError for a key that is not among `known`, unless `known` is empty. `label` is the table's full key,
  // empty for the whole file. `file` and `table` must outlive the reader.
  TableReader(const std::filesystem::path& file, std::string label, const toml::table& table, int line,
              std::span<const std::string_view> known = {});

  bool has(std::string_view key) const { return table_.contains(key); }
  int line() const { return line_; }
  const toml::table& table() const { return table_; }

  double number(std::string_view key, const Range& range) const;
  double number(std::string_view key, double fallback, const Range& range) const {
    return has(key) ? number(key, range) : fallback;
  }
  int64_t integer(std::string_view key, const Range& range) const;
  bool boolean(std::string_view key) const;
  std::string text(std::string_view key) const { return textAs(key, "a string is needed"); }
  std::string textAs(std::string_view key, std::string_view right) const;
  std::string text(std::string_view key, const std::string& fallback) const { return has(key) ? text(key) : fallback; }
  glm::dvec2 vec2(std::string_view key, const Range& range) const;
  glm::dvec3 vec3(std::string_view key, const Range& range) const;
  glm::dvec3 numberOrVec3(std::string_view key) const;  // a number stands for three equal ones
  std::vector<glm::dvec3> points(std::string_view key) const;
  // Returns the index of the text in `choices`.
  size_t choice(std::string_view key, std::span<const std::string_view> choices) const;

  std::optional<TableReader> subtable(std::string_view key, std::span<const std::string_view> known = {}) const;
  // Returns the [[key]] tables; the label of each has its `name` or, without one, its index.
  std::vector<TableReader> tables(std::string_view key, std::span<const std::string_view> known) const;

  // Returns "FILE:LINE: key", with which errors about the key begin.
  std::string place(std::string_view key) const;

  [[noreturn]] void fail(std::string_view key, std::string_view wrong, std::string_view right) const;
  [[noreturn]] void failAt(const toml::node& node, std::string_view key, std::string_view wrong,
                           std::string_view right) const;

 private:
  int line(std::string_view key) const;  // the table's own when the key is absent
  std::string fullKey(std::string_view key) const;
  void expect(bool fits, const toml::node& node, std::string_view key, std::string_view right) const;
  const toml::node& required(std::string_view key, std::string_view right) const;
  double numberOf(const toml::node& node, std::string_view key, const Range& range) const;
  template <int size>
  glm::vec<size, double> vectorOf(const toml::node& node, std::string_view key, const Range& range) const;

  const std::filesystem::path& file_;
  std::string label_;
  const toml::table& table_;
  int line_ = 1;
};

// Returns the node's number, rounded to a double; nothing if the node is no number.
std::optional<double> numberIn(const toml::node& node);

// Returns the name of a value's type for errors: "a string", "a table" ...
std::string_view typeName(const toml::node& node);

}  // namespace speculum
