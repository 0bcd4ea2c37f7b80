#include "accuracy/sweep_planner.hpp"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "platform/files.hpp"
#include "scene/input_error.hpp"
#include "settings/setting_fields.hpp"

namespace speculum {

namespace {

constexpr size_t mostConfigurations = 1000;
constexpr int longestInterval = 16;  // frames; to see every image at every age takes 1.5 times its square of frames

// Returns a name made of the settings' labels in the panels, which all differ, and their values.
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

using Changes = SweepPlanner::Changes;
using Values = std::vector<std::string>;

constexpr const char* greatestDepth = "32";

Values texts(const std::vector<int>& values) {
  Values list;
  for (const int value : values) {
    list.push_back(std::to_string(value));
  }
  return list;
}

// Returns the values of a setting that a built-in sweep tries.
Values swept(std::string_view key, bool full) {
  const SweptValues& values = findSettingField(key)->swept;
  std::istringstream words{std::string(full ? values.full : values.quick)};
  Values list{std::istream_iterator<std::string>(words), {}};
  if (list.empty()) {
    throw std::logic_error("the description of " + std::string(key) + " has no values for sweeps");
  }
  return list;
}

Changes samples(const std::string& count) {
  return {{"reflection.samples", count}, {"view.samples", count}};
}

// Sets everything but the setting of a series to its best, because the main view's own sampling would hide the errors
// of a coarse mirror image.
Changes best(const SweepContext& context) {
  return joined(samples(std::to_string(context.sampleCounts.back())), {{"reflection.max_depth", greatestDepth}});
}

// Sets samples of the view, and of mirror images if the scene has mirrors.
Changes drawn(const SweepContext& context, const std::string& count) {
  return context.mirrors ? samples(count) : Changes{{"view.samples", count}};
}

// Adds drafts: the whole picture at a lower resolution.
void addViewScales(SweepPlanner& planner, const SweepContext& context, bool full) {
  const Values scales = swept("view.scale", full);
  planner.series({.key = "view.scale",
                  .name = "Resolution of the main view and of mirror images",
                  .note = "An edge is wrong over a width in proportion to the texel: squared error as 1/scale"},
                 scales, drawn(context, std::to_string(context.sampleCounts.back())));
  for (const std::string& scale : scales) {
    planner.add(joined({{"view.scale", scale}}, drawn(context, "1")));
  }
}

// Adds means of pictures, which converge to the reference. From 16 pictures on, each is drawn at one sample a pixel,
// whatever view.samples says. No mean removes the error of shadow maps.
void addMeans(SweepPlanner& planner, const SweepContext& context, bool full) {
  Changes exact = context.mirrors ? Changes{{"reflection.max_depth", greatestDepth}} : Changes{};
  const bool shadows = std::ranges::find(context.effects, "effects.shadows") != context.effects.end();
  if (shadows) {
    exact.push_back({"effects.shadow_lookup", "traced"});
  }
  planner.series({.key = "view.accumulate",
                  .name = "Pictures in a mean, one sample each",
                  .note = "Edges N^-0.75, and texture, highlights and shading edges with them"},
                 swept("view.accumulate", true), joined(drawn(context, "1"), exact));
  // Few pictures of many samples lie between one picture and such means. Their shadows need not be exact.
  const std::string most = std::to_string(context.sampleCounts.back());
  for (const std::string pictures : {"2", "4"}) {
    const Changes mean = joined(joined(drawn(context, most), exact), {{"view.accumulate", pictures}});
    planner.add(mean);
    for (const std::string& lookup : shadows ? swept("effects.shadow_lookup", full) : Values{}) {
      planner.add(joined(mean, {{"effects.shadow_lookup", lookup}}));
    }
  }
  for (const std::string& error : swept("view.accumulate_error", full)) {
    planner.add(
        joined(joined(drawn(context, "1"), exact), {{"view.accumulate", "64"}, {"view.accumulate_error", error}}));
  }
}

void addScaleSeries(SweepPlanner& planner, const SweepContext& context, bool full) {
  planner.series({.key = "reflection.scale",
                  .name = "Resolution of mirror images, up to the screen's",
                  .note = "An edge is wrong over a width in proportion to the texel: squared error as 1/scale. At 1 "
                          "nothing is resampled, which is another law"},
                 swept("reflection.scale", full), best(context));
  const Values fine = full ? Values{"1", "1.5", "2", "3", "4"} : Values{"1", "1.5", "2"};
  planner.series({.key = "reflection.scale",
                  .name = "Resolution above the screen's, one sample a texel",
                  .note = "Regular N samples an edge of any slope: N^-0.75, with N = scale^2"},
                 fine,
                 {{"reflection.samples", "1"},
                  {"view.samples", std::to_string(context.sampleCounts.back())},
                  {"reflection.max_depth", greatestDepth}});
}

void addRoughSeries(SweepPlanner& planner, const SweepContext& context, bool full) {
  // Fewer rays than samples draw the same picture, because each sample sends one at least.
  const int least = context.sampleCounts.back();
  Values rays;
  for (int count = least; count <= (full ? 256 : 128); count *= full ? 2 : 4) {
    rays.push_back(std::to_string(count));
  }
  planner.series({.key = "effects.rough_samples",
                  .name = "Rays a pixel of rough mirrors",
                  .note = "Random rays err by N^-0.5; a shifted lattice does better where what is seen is "
                          "smooth"},
                 rays, best(context));
  if (context.mirrors) {
    planner.grid({{"effects.rough_lookup", swept("effects.rough_lookup", full)},
                  {"effects.rough_samples", swept("effects.rough_samples", full)}});
  }
}

void addSeries(SweepPlanner& planner, const SweepContext& context, bool full) {
  const Values counts = texts(context.sampleCounts);
  SweepSeries msaa{.key = "view.samples",
                   .name = "Samples a pixel, of view and mirror images alike",
                   .note = "Edges N^-0.75; texture, highlights and shading edges gain nothing"};
  std::vector<Changes> each;
  for (const std::string& count : counts) {
    each.push_back(context.mirrors ? joined(samples(count), {{"reflection.max_depth", greatestDepth}})
                                   : Changes{{"view.samples", count}});
  }
  planner.series(std::move(msaa), counts, each);
  addViewScales(planner, context, full);
  addMeans(planner, context, full);
  if (context.rough) {
    addRoughSeries(planner, context, full);
  }
  if (!context.mirrors) {
    return;
  }
  addScaleSeries(planner, context, full);
  planner.series({.key = "reflection.max_depth",
                  .name = "Depth of mirrors in mirrors",
                  .axis = SweepSeries::Axis::linear,
                  .note = "Falls as the throughput of the light beyond, down to what else is wrong"},
                 swept("reflection.max_depth", full), samples(std::to_string(context.sampleCounts.back())));
}

void addSingles(SweepPlanner& planner, const SweepContext& context, bool full) {
  const std::string most = std::to_string(context.sampleCounts.back());
  const auto grid = [&](const std::vector<std::string>& keys) {
    SettingGrid axes;
    for (const std::string& key : keys) {
      axes.emplace_back(key, swept(key, full));
    }
    planner.grid(axes);
  };
  grid({"view.texture_filter"});
  for (const std::string& effect : context.effects) {
    planner.add({{effect, "false"}});
    if (effect == "effects.shadows") {
      grid({"effects.shadow_lookup", "effects.shadow_map_size"});
    }
    if (effect == "effects.ripple") {
      grid({"effects.ripple_lookup"});
    }
    if (effect == "effects.curved") {
      grid({"effects.curved_lookup", "effects.environment_size"});
    }
  }
  if (!context.effects.empty()) {
    grid({"effects.per_sample"});
  }
  if (!context.mirrors) {
    return;
  }
  planner.add({{"reflection.samples", "1"}, {"view.samples", most}});
  planner.add({{"reflection.samples", most}, {"view.samples", "1"}});
  grid({"reflection.clip"});
  grid({"reflection.min_throughput"});
  grid({"reflection.max_passes"});
  grid({"reflection.min_pixels"});
  if (context.animated) {
    grid({"reflection.update_interval"});
  }
}

SweepPlan builtIn(const std::string& name, const SweepContext& context) {
  const bool full = name == "full";
  SweepPlanner planner(name, context);
  addSeries(planner, context, full);
  addSingles(planner, context, full);
  if (!context.mirrors) {
    return std::move(planner.plan);
  }
  const Values scales = full ? Values{"0.25", "0.5", "0.75", "1", "1.5", "2"} : Values{"0.5", "1"};
  const Values depths = full ? Values{"1", "2", "3", "4", "8"} : Values{"1", "2", "4"};
  for (const std::string& count : texts(context.sampleCounts)) {
    planner.grid({{"reflection.scale", scales},
                  {"reflection.max_depth", depths},
                  {"reflection.samples", {count}},
                  {"view.samples", {count}}});
  }
  planner.add({{"reflection.scale", "0.25"},
               {"reflection.max_depth", "1"},
               {"reflection.samples", "1"},
               {"view.samples", "1"}});
  planner.add(joined(best(context), {{"reflection.scale", "2"}}));
  return std::move(planner.plan);
}

// Plans what a window trades for its pace: old mirror images, resolution, samples, and the motion controller, which
// chooses settings for each frame.
SweepPlan motionSweep(const SweepContext& context) {
  SweepPlanner planner("motion", context);
  planner.plan.repeats = 5;  // each is a mean over all frames
  for (const std::string& count : {texts(context.sampleCounts).front(), std::string("4")}) {
    SettingGrid axes{{"view.scale", {"0.25", "0.5", "1"}}, {"view.samples", {count}}};
    if (context.mirrors) {
      axes.insert(axes.begin(), {"reflection.update_interval", {"1", "2", "4"}});
      axes.emplace_back("reflection.samples", Values{count});
    }
    planner.grid(axes);
  }
  if (context.mirrors) {
    planner.grid({{"reflection.scale", {"0.25", "0.5"}}});
  }
  for (const std::string ms : {"5", "15", "50"}) {
    planner.add({{"quality.motion_ms", ms}}, "at most " + ms + " ms");
  }
  return std::move(planner.plan);
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

SweepPlanner::SweepPlanner(std::string name, const SweepContext& context)
    : base_(context.base), motion_(context.motion) {
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
    const bool quality = change.key.starts_with("quality.") && !(motion_ && change.key == "quality.motion_ms");
    if (quality || change.key.starts_with("debug.") || change.key.starts_with("ui.") || (field && field->subject)) {
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

SweepPlan viewSweep(const SweepContext& context) {
  SweepPlanner planner("view", context);
  for (const std::string& count : {texts(context.sampleCounts).front(), texts(context.sampleCounts).back()}) {
    if (!context.mirrors) {
      planner.add({{"view.samples", count}});
      continue;
    }
    planner.grid({{"reflection.scale", {"0.5", "1"}},
                  {"reflection.max_depth", {"1", "2", "4"}},
                  {"reflection.samples", {count}},
                  {"view.samples", {count}}});
  }
  if (context.mirrors) {
    planner.add(joined({{"reflection.scale", "0.25"}, {"reflection.max_depth", "1"}}, samples("1")));
    planner.add(joined(best(context), {{"reflection.scale", "2"}}));
  }
  return std::move(planner.plan);
}

SweepPlan sweepPlan(const std::string& wanted, const SweepContext& context) {
  if (wanted == "motion" && context.motion) {
    return motionSweep(context);
  }
  if (wanted == "quick" || wanted == "full") {
    return builtIn(wanted, context);
  }
  if (!wanted.ends_with(".toml") && !isFile(wanted)) {
    throw InputError("--sweep: '" + wanted + "' is no file (quick, full" + (context.motion ? ", motion" : "") +
                     ", or a TOML file)");
  }
  return readSweepPlan(wanted, context);
}

}  // namespace speculum
