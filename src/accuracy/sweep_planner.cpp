#include "accuracy/sweep_planner.hpp"

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include "frame/setting_fields.hpp"

namespace speculum {

namespace {

constexpr size_t mostConfigurations = 1000;
constexpr int longestInterval = 16;  // to see every image at every age takes 1.5 times its square of frames

// Says what the settings are in the words of the panels, whose labels differ.
std::string shortName(const SweepPlanner::Changes& changes) {
  std::string name;
  for (const SettingChange& change : changes) {
    std::string value = change.value;
    std::ranges::replace(value, '_', ' ');
    value = value == "true" ? "on" : value == "false" ? "off" : value;
    value.resize(value.size() - (value.ends_with(".0") ? 2 : 0));
    name += (name.empty() ? "" : ", ") + std::string(findSettingField(change.key)->label) + " " + value;
  }
  return name.empty() ? "base" : name;
}

}  // namespace

std::optional<std::vector<std::vector<SettingChange>>> combinations(const SettingGrid& grid, size_t most) {
  std::vector<std::vector<SettingChange>> all{{}};
  for (const auto& [key, values] : grid) {
    std::vector<std::vector<SettingChange>> next;
    if (all.size() * values.size() > most) {
      return std::nullopt;
    }
    for (const std::vector<SettingChange>& combination : all) {
      for (const std::string& value : values) {
        next.push_back(joined(combination, {{key, value}}));
      }
    }
    all = std::move(next);
  }
  return all;
}

SweepPlanner::Changes joined(SweepPlanner::Changes first, const SweepPlanner::Changes& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

Settings settingsWith(const Settings& base, const std::vector<SettingChange>& changes) {
  Settings settings = base;
  for (const SettingChange& change : changes) {
    if (const auto problem = setSetting(settings, change.key, change.value)) {
      throw std::invalid_argument(*problem);
    }
  }
  return settings;
}

SweepPlanner::SweepPlanner(std::string name, const SweepContext& context) : base_(context.base) {
  plan.name = std::move(name);
  add({});
  if (context.interval > longestInterval) {
    throw std::invalid_argument("quality.update_interval of a mirror: a sweep takes intervals up to " +
                                std::to_string(longestInterval));
  }
}

int SweepPlanner::add(const Changes& changes, const std::string& name) {
  for (const SettingChange& change : changes) {
    const SettingField* field = findSettingField(change.key);
    if (change.key.starts_with("quality.") || change.key.starts_with("debug.") || (field && field->subject)) {
      throw std::invalid_argument(change.key + ": cannot be swept");
    }
  }
  if (plan.configurations.size() >= mostConfigurations) {
    throw std::invalid_argument("more than " + std::to_string(mostConfigurations) + " configurations");
  }
  const Settings settings = settingsWith(base_, changes);
  if (settings.reflection.updateInterval > longestInterval) {
    throw std::invalid_argument("reflection.update_interval: a sweep takes intervals up to " +
                                std::to_string(longestInterval));
  }
  SweepConfiguration configuration{.name = name, .changes = settingChanges(base_, settings)};
  auto& all = plan.configurations;
  const auto same = std::ranges::find(all, configuration.changes, &SweepConfiguration::changes);
  if (same != all.end()) {
    return static_cast<int>(same - all.begin());
  }
  if (name.empty()) {
    configuration.name = shortName(configuration.changes);
  }
  const auto taken = [&](const SweepConfiguration& c) { return c.name == configuration.name; };
  while (std::ranges::any_of(all, taken)) {
    configuration.name += " (" + std::to_string(all.size()) + ")";
  }
  all.push_back(std::move(configuration));
  return static_cast<int>(all.size()) - 1;
}

void SweepPlanner::grid(const SettingGrid& axes) {
  const auto all = combinations(axes, mostConfigurations);
  if (!all) {
    throw std::invalid_argument("more than " + std::to_string(mostConfigurations) + " combinations");
  }
  for (const Changes& combination : *all) {
    add(combination);
  }
}

void SweepPlanner::series(SweepSeries series, const std::vector<std::string>& values, const Changes& fixed) {
  std::vector<Changes> each;
  for (const std::string& value : values) {
    each.push_back(joined(fixed, {{series.key, value}}));
  }
  this->series(std::move(series), values, each);
}

void SweepPlanner::series(SweepSeries series, const std::vector<std::string>& values,
                          const std::vector<Changes>& each) {
  for (size_t i = 0; i < values.size(); ++i) {
    double x = 0.0;
    std::from_chars(values[i].data(), values[i].data() + values[i].size(), x);
    const int point = add(each[i]);
    if (std::ranges::find(series.points, point) == series.points.end()) {
      series.x.push_back(x);
      series.points.push_back(point);
    }
  }
  if (series.points.size() > 1) {
    plan.series.push_back(std::move(series));
  }
}

}  // namespace speculum
