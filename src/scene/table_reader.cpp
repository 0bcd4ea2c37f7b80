#include "scene/table_reader.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "scene/input_error.hpp"

namespace speculum {

namespace {

int lineOf(const toml::source_region& region, int fallback) {
  return region.begin.line > 0 ? static_cast<int>(region.begin.line) : fallback;
}

std::string elementKey(std::string_view key, size_t index) {
  return fmt::format("{}[{}]", key, index);
}

}  // namespace

std::string_view typeName(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return node.is_array_of_tables() ? "an array of tables" : "an array";
    case toml::node_type::string:
      return "a string";
    case toml::node_type::integer:
      return "an integer";
    case toml::node_type::floating_point:
      return "a number with a fraction";
    case toml::node_type::boolean:
      return "a boolean";
    default:
      return "a date or time";
  }
}

TableReader::TableReader(const std::filesystem::path& file, std::string label, const toml::table& table, int line,
                         std::span<const std::string_view> known)
    : file_(file), label_(std::move(label)), table_(table), line_(std::max(1, line)) {
  const toml::key* first = nullptr;
  for (const auto& [key, value] : table_) {
    const bool isKnown = known.empty() || std::ranges::find(known, key.str()) != known.end();
    if (!isKnown && (first == nullptr || key.source().begin.line < first->source().begin.line)) {
      first = &key;
    }
  }
  if (first != nullptr) {
    fail(first->str(), "is not a known key", nearestKeyAdvice(first->str(), known));
  }
}

int TableReader::line(std::string_view key) const {
  const auto found = table_.find(key);
  return found == table_.end() ? line_ : lineOf(found->first.source(), lineOf(found->second.source(), line_));
}

std::string TableReader::fullKey(std::string_view key) const {
  return label_.empty() ? std::string(key) : label_ + "." + std::string(key);
}

std::string TableReader::place(std::string_view key) const {
  return fmt::format("{}:{}: {}", file_.string(), line(key), fullKey(key));
}

void TableReader::fail(std::string_view key, std::string_view wrong, std::string_view right) const {
  throwInputError(file_, line(key), fullKey(key), wrong, right);
}

void TableReader::failAt(const toml::node& node, std::string_view key, std::string_view wrong,
                         std::string_view right) const {
  throwInputError(file_, lineOf(node.source(), line_), fullKey(key), wrong, right);
}

void TableReader::expect(bool fits, const toml::node& node, std::string_view key, std::string_view right) const {
  if (!fits) {
    failAt(node, key, fmt::format("is {}", typeName(node)), right);
  }
}

const toml::node& TableReader::required(std::string_view key, std::string_view right) const {
  const toml::node* node = table_.get(key);
  if (node == nullptr) {
    fail(key, "is missing", right);
  }
  return *node;
}

std::optional<double> numberIn(const toml::node& node) {
  // toml++'s value<double>() refuses integers that a double rounds.
  if (const toml::value<int64_t>* integer = node.as_integer()) {
    return static_cast<double>(integer->get());
  }
  return node.value_exact<double>();
}

double TableReader::numberOf(const toml::node& node, std::string_view key, const Range& range) const {
  expect(node.is_number(), node, key, range.text());
  const double value = numberIn(node).value();
  if (!range.contains(value)) {
    failAt(node, key, fmt::format("is {}", value), range.text());
  }
  return value;
}

template <int size>
glm::vec<size, double> TableReader::vectorOf(const toml::node& node, std::string_view key, const Range& range) const {
  const std::string right = fmt::format("an array of {} numbers is needed", size);
  const toml::array* array = node.as_array();
  expect(array != nullptr, node, key, right);
  if (array->size() != size) {
    failAt(node, key, fmt::format("has {} elements", array->size()), right);
  }
  glm::vec<size, double> vector;
  for (int i = 0; i < size; ++i) {
    vector[i] = numberOf((*array)[i], elementKey(key, i), range);
  }
  return vector;
}

double TableReader::number(std::string_view key, const Range& range) const {
  return numberOf(required(key, range.text()), key, range);
}

int64_t TableReader::integer(std::string_view key, const Range& range) const {
  const std::string right =
      range.powersOfTwo ? range.text() : fmt::format("an integer {:.0f} .. {:.0f} is needed", range.low, range.high);
  const toml::node& node = required(key, right);
  expect(node.is_integer(), node, key, right);
  const int64_t value = node.as_integer()->get();
  if (!range.contains(static_cast<double>(value))) {
    failAt(node, key, fmt::format("is {}", value), right);
  }
  return value;
}

bool TableReader::boolean(std::string_view key) const {
  const toml::node& node = required(key, "true or false is needed");
  expect(node.is_boolean(), node, key, "true or false is needed");
  return node.as_boolean()->get();
}

std::string TableReader::textAs(std::string_view key, std::string_view right) const {
  const toml::node& node = required(key, right);
  expect(node.is_string(), node, key, right);
  return node.as_string()->get();
}

glm::dvec3 TableReader::vec3(std::string_view key, const Range& range) const {
  return vectorOf<3>(required(key, "an array of 3 numbers is needed"), key, range);
}

glm::dvec2 TableReader::vec2(std::string_view key, const Range& range) const {
  return vectorOf<2>(required(key, "an array of 2 numbers is needed"), key, range);
}

glm::dvec3 TableReader::numberOrVec3(std::string_view key) const {
  constexpr std::string_view right = "a number or an array of 3 numbers is needed";
  const toml::node& node = required(key, right);
  expect(node.is_number() || node.is_array(), node, key, right);
  return node.is_number() ? glm::dvec3(numberOf(node, key, anyRange)) : vectorOf<3>(node, key, anyRange);
}

std::vector<glm::dvec3> TableReader::points(std::string_view key) const {
  const toml::node& node = required(key, "an array of points is needed");
  expect(node.is_array(), node, key, "an array of points [x, y, z] is needed");
  std::vector<glm::dvec3> points;
  for (size_t i = 0; i < node.as_array()->size(); ++i) {
    points.push_back(vectorOf<3>((*node.as_array())[i], elementKey(key, i), coordinateRange));
  }
  return points;
}

size_t TableReader::choice(std::string_view key, std::span<const std::string_view> choices) const {
  const std::string value = text(key);
  const auto found = std::ranges::find(choices, value);
  if (found == choices.end()) {
    fail(key, fmt::format("is '{}'", value), nearestKeyAdvice(value, choices));
  }
  return static_cast<size_t>(found - choices.begin());
}

std::optional<TableReader> TableReader::subtable(std::string_view key, std::span<const std::string_view> known) const {
  const toml::node* node = table_.get(key);
  if (node == nullptr) {
    return std::nullopt;
  }
  expect(node->is_table(), *node, key, "a table is needed");
  return TableReader(file_, fullKey(key), *node->as_table(), line(key), known);
}

std::vector<TableReader> TableReader::tables(std::string_view key, std::span<const std::string_view> known) const {
  std::vector<TableReader> readers;
  const toml::node* node = table_.get(key);
  if (node == nullptr) {
    return readers;
  }
  // Headers have no index or name of the table around them: [[case.expect]] in case[0].
  const std::string around = label_.substr(0, label_.find('['));
  const std::string right = fmt::format("write [[{}{}{}]] above each", around, around.empty() ? "" : ".", key);
  const toml::array* array = node->as_array();
  expect(array != nullptr, *node, key, right);
  for (size_t i = 0; i < array->size(); ++i) {
    const toml::node& element = (*array)[i];
    expect(element.is_table(), element, elementKey(key, i), right);
    const std::string name = (*element.as_table())["name"].value_or(std::string());
    std::string label = name.empty() ? elementKey(fullKey(key), i) : fmt::format("{}[{}]", fullKey(key), name);
    readers.emplace_back(file_, std::move(label), *element.as_table(), lineOf(element.source(), line_), known);
  }
  return readers;
}

}  // namespace speculum
