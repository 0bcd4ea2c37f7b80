#include "accuracy/sweep_planner.hpp"

#include <array>
#include <limits>
#include <stdexcept>

#include "scene/input_error.hpp"
#include "scene/scene_sections.hpp"
#include "scene/toml_file.hpp"
#include "settings/setting_fields.hpp"

namespace speculum {

namespace {

using Key = std::string_view;
using Changes = SweepPlanner::Changes;

SettingGrid readGrid(const TableReader& table) {
  SettingGrid grid;
  if (const std::optional<TableReader> settings = table.subtable("settings")) {
    if (settings->table().size() > settingFields().size()) {
      table.fail("settings", "has " + std::to_string(settings->table().size()) + " keys",
                 "there are " + std::to_string(settingFields().size()) + " settings");
    }
    for (const auto& [key, node] : settings->table()) {
      grid.emplace_back(std::string(key.str()), settingTexts(*settings, key.str(), node));
    }
  }
  return grid;
}

Changes readChanges(const TableReader& table) {
  Changes changes;
  for (auto& [key, values] : readGrid(table)) {
    if (values.size() != 1) {
      table.fail("settings", key + " has several values", "one is needed here; [[grid]] takes several");
    }
    changes.push_back({key, values.front()});
  }
  return changes;
}

void readSeries(const TableReader& table, SweepPlanner& planner) {
  static constexpr std::array<Key, 2> axes{"logarithmic", "linear"};
  SweepSeries series;
  series.key = table.text("key");
  series.name = table.text("name", series.key);
  if (table.has("axis")) {
    series.axis = static_cast<SweepSeries::Axis>(table.choice("axis", axes));
  }
  series.note = table.text("note", "");
  const toml::node* values = table.table().get("values");
  if (values == nullptr || !values->is_array()) {
    table.fail("values", "is missing or no array", "numbers in ascending order are needed");
  }
  std::vector<std::string> texts = settingTexts(table, "values", *values);
  double last = -std::numeric_limits<double>::infinity();
  for (const toml::node& node : *values->as_array()) {
    const double value = node.value_or(std::numeric_limits<double>::quiet_NaN());
    if (!(value > last) || (series.axis == SweepSeries::Axis::logarithmic && value <= 0.0)) {
      table.failAt(node, "values", "is out of order or no number",
                   "numbers in ascending order are needed, above 0 on a logarithmic axis");
    }
    last = value;
  }
  const size_t before = planner.plan.series.size();
  planner.series(std::move(series), texts, readChanges(table));
  if (planner.plan.series.size() == before) {
    table.fail("values", "makes no two different configurations", "at least two are needed");
  }
}

// Adds the table's line to the message of setSetting() about a bad key or value.
template <typename Add>
void checked(const TableReader& table, const Add& add) {
  try {
    add();
  } catch (const std::invalid_argument& problem) {
    table.fail("settings", problem.what(), "keys and values as --set takes them are needed");
  }
}

}  // namespace

SweepPlan readSweepPlan(const std::filesystem::path& file, const SweepContext& context) {
  static constexpr std::array<Key, 4> keys{"repeats", "configuration", "grid", "series"};
  static constexpr std::array<Key, 2> configurationKeys{"name", "settings"};
  static constexpr std::array<Key, 1> gridKeys{"settings"};
  static constexpr std::array<Key, 6> seriesKeys{"key", "name", "values", "axis", "note", "settings"};
  const toml::table root = readToml(file, "sweep file");
  const TableReader reader(file, "", root, 1, keys);
  SweepPlanner planner(file.filename().string(), context);
  if (reader.has("repeats")) {
    planner.plan.repeats = static_cast<int>(reader.integer("repeats", {.low = SweepPlan::leastRepeats, .high = 1000}));
  }
  if (!reader.has("configuration") && !reader.has("grid") && !reader.has("series")) {
    throwInputError(file, 1, "configuration", "is missing", "[[configuration]], [[grid]] or [[series]] names settings");
  }
  for (const TableReader& table : reader.tables("configuration", configurationKeys)) {
    checked(table, [&] { planner.add(readChanges(table), table.text("name", "")); });
  }
  for (const TableReader& table : reader.tables("grid", gridKeys)) {
    checked(table, [&] { planner.grid(readGrid(table)); });
  }
  for (const TableReader& table : reader.tables("series", seriesKeys)) {
    checked(table, [&] { readSeries(table, planner); });
  }
  return std::move(planner.plan);
}

}  // namespace speculum
