#include "accuracy/sweep_plan.hpp"

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include "frame/setting_fields.hpp"

namespace speculum {

namespace {

using Changes = SweepPlanner::Changes;
using Theory = PlannedSeries::Theory;

constexpr size_t mostConfigurations = 1000;
constexpr int longestInterval = 16;  // it takes 1.5 times its square of frames to see every age of every image
constexpr const char* greatestDepth = "32";

std::string shortName(const Changes& changes) {
  std::string name;
  for (const SettingChange& change : changes) {
    const std::string_view key = change.key;
    const std::string_view reflection = "reflection.";
    std::string words(key.starts_with(reflection) ? key.substr(reflection.size()) : key);
    std::replace(words.begin(), words.end(), '.', ' ');
    std::replace(words.begin(), words.end(), '_', ' ');
    const bool whole = change.value.ends_with(".0");
    name += (name.empty() ? "" : ", ") + words + " " + change.value.substr(0, change.value.size() - (whole ? 2 : 0));
  }
  return name.empty() ? "base" : name;
}

std::vector<std::string> texts(const std::vector<int>& values) {
  std::vector<std::string> list;
  for (const int value : values) {
    list.push_back(std::to_string(value));
  }
  return list;
}

Changes samples(const std::string& count) {
  return {{"reflection.samples", count}, {"view.samples", count}};
}

Changes joined(Changes first, const Changes& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

// The picture's own sampling would hide what a coarse mirror image does: everything but the setting looked at is at its
// best.
Changes best(const SweepContext& context) {
  return joined(samples(std::to_string(context.sampleCounts.back())), {{"reflection.max_depth", greatestDepth}});
}

void addScaleSeries(SweepPlanner& planner, const SweepContext& context, bool full) {
  std::vector<std::string> coarse = {"0.125", "0.25", "0.5", "1"};
  if (full) {
    coarse = {"0.125", "0.177", "0.25", "0.354", "0.5", "0.707", "1"};
  }
  planner.series(
      {.series = {.key = "reflection.scale",
                  .name = "Resolution of mirror images, up to the screen's",
                  .note = "An edge is wrong over a width in proportion to the texel: squared error as 1/scale. At 1 "
                          "nothing is resampled, which is another law",
                  .theorySlope = -0.5},
       .theory = Theory::fixed,
       .fitUpTo = 0.99},
      coarse, best(context));
  std::vector<std::string> fine = {"1", "1.5", "2"};
  if (full) {
    fine = {"1", "1.5", "2", "3", "4"};
  }
  planner.series({.series = {.key = "reflection.scale",
                             .name = "Resolution above the screen's, one sample a texel",
                             .note = "Regular N samples an edge of any slope: N^-0.75, with N = scale^2",
                             .theorySlope = -1.5},
                  .theory = Theory::fixed},
                 fine,
                 {{"reflection.samples", "1"},
                  {"view.samples", std::to_string(context.sampleCounts.back())},
                  {"reflection.max_depth", greatestDepth}});
}

void addRoughSeries(SweepPlanner& planner, const SweepContext& context, bool full) {
  std::vector<std::string> rays = {"1", "4", "16", "64"};
  if (full) {
    rays = {"1", "2", "4", "8", "16", "32", "64", "128", "256"};
  }
  planner.series({.series = {.key = "effects.rough_samples",
                             .name = "Rays a pixel of rough mirrors",
                             .note = "Random rays err by N^-0.5; a shifted lattice does better where what is seen is "
                                     "smooth",
                             .theorySlope = -0.5},
                  .theory = Theory::fixed},
                 rays, best(context));
  if (context.mirrors) {
    for (const std::string& lookups : rays) {
      planner.add({{"effects.rough_lookup", "image"}, {"effects.rough_samples", lookups}});
    }
  }
}

void addSeries(SweepPlanner& planner, const SweepContext& context, bool full) {
  const std::vector<std::string> counts = texts(context.sampleCounts);
  PlannedSeries msaa{.series = {.key = "view.samples",
                                .name = "Samples a pixel, of view and mirror images alike",
                                .note = "Edges N^-0.75; texture, highlights and shading edges gain nothing",
                                .theorySlope = -0.75},
                     .theory = Theory::fixed};
  std::vector<Changes> each;
  for (const std::string& count : counts) {
    each.push_back(context.mirrors ? joined(samples(count), {{"reflection.max_depth", greatestDepth}})
                                   : Changes{{"view.samples", count}});
  }
  planner.series(std::move(msaa), counts, each);
  if (context.rough) {
    addRoughSeries(planner, context, full);
  }
  if (!context.mirrors) {
    return;
  }
  addScaleSeries(planner, context, full);
  std::vector<std::string> depths = {"0", "1", "2", "3", "4", "8", greatestDepth};
  if (full) {
    depths = {"0", "1", "2", "3", "4", "5", "6", "8", "12", "16", greatestDepth};
  }
  planner.series(
      {.series = {.key = "reflection.max_depth",
                  .name = "Depth of mirrors in mirrors",
                  .axis = SweepSeries::Axis::linear,
                  .note = "Root mean square throughput of the light beyond, from the mirrors in view; what is left at "
                          "the greatest depth is taken off as a square"},
       .theory = Theory::depth},
      depths, samples(std::to_string(context.sampleCounts.back())));
}

void addSingles(SweepPlanner& planner, const SweepContext& context, bool full) {
  const std::string most = std::to_string(context.sampleCounts.back());
  planner.add({{"view.texture_filter", "trilinear"}});
  for (const std::string& effect : context.effects) {
    planner.add({{effect, "false"}});
    if (effect == "effects.curved") {
      for (const char* size : {"64", "256"}) {
        planner.add({{"effects.curved_lookup", "environment"}, {"effects.environment_size", size}});
      }
    }
  }
  if (!context.effects.empty()) {
    planner.add({{"effects.per_sample", "true"}});
  }
  if (!context.mirrors) {
    return;
  }
  planner.add({{"reflection.samples", "1"}, {"view.samples", most}});
  planner.add({{"reflection.samples", most}, {"view.samples", "1"}});
  if (context.effects.empty()) {  // of scenes that may trace rays, where it changes nothing
    for (const char* texels : full ? std::vector{"0.25", "0.5", "1", "2", "4"} : std::vector{"0.5", "2"}) {
      planner.add({{"reflection.mesh_error", texels}});
    }
  }
  planner.add({{"reflection.clip", "oblique"}});
  planner.add({{"reflection.clip", "none"}});
  for (const char* throughput : {"0.2", "0.05", "0.01"}) {
    planner.add({{"reflection.min_throughput", throughput}});
  }
  for (const char* passes : {"1", "2", "4"}) {
    planner.add({{"reflection.max_passes", passes}});
  }
  for (const char* pixels : full ? std::vector{"64", "1024", "8192"} : std::vector{"1024"}) {
    planner.add({{"reflection.min_pixels", pixels}});
  }
  if (context.animated) {
    for (const char* interval : full ? std::vector{"2", "4", "8"} : std::vector{"2", "4"}) {
      planner.add({{"reflection.update_interval", interval}});
    }
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
  const std::vector<std::string> scales =
      full ? std::vector<std::string>{"0.25", "0.5", "0.75", "1", "1.5", "2"} : std::vector<std::string>{"0.5", "1"};
  const std::vector<std::string> depths =
      full ? std::vector<std::string>{"1", "2", "3", "4", "8"} : std::vector<std::string>{"1", "2", "4"};
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

}  // namespace

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
  SweepConfiguration configuration{.name = name};
  for (const SettingField& field : settingFields()) {
    const std::string value = settingValue(settings, field.key);
    if (value != settingValue(base_, field.key)) {
      configuration.changes.push_back({std::string(field.key), value});
    }
  }
  auto& all = plan.configurations;
  const auto same = std::find_if(all.begin(), all.end(),
                                 [&](const SweepConfiguration& c) { return c.changes == configuration.changes; });
  if (same != all.end()) {
    return static_cast<int>(same - all.begin());
  }
  if (name.empty()) {
    configuration.name = shortName(configuration.changes);
  }
  const auto taken = [&](const SweepConfiguration& c) { return c.name == configuration.name; };
  while (std::any_of(all.begin(), all.end(), taken)) {
    configuration.name += " (" + std::to_string(all.size()) + ")";
  }
  all.push_back(std::move(configuration));
  return static_cast<int>(all.size()) - 1;
}

void SweepPlanner::grid(const std::vector<std::pair<std::string, std::vector<std::string>>>& axes) {
  std::vector<Changes> combinations{{}};
  for (const auto& [key, values] : axes) {
    std::vector<Changes> next;
    if (combinations.size() * values.size() > mostConfigurations) {
      throw std::invalid_argument("more than " + std::to_string(mostConfigurations) + " combinations");
    }
    for (const Changes& combination : combinations) {
      for (const std::string& value : values) {
        next.push_back(joined(combination, {{key, value}}));
      }
    }
    combinations = std::move(next);
  }
  for (const Changes& combination : combinations) {
    add(combination);
  }
}

void SweepPlanner::series(PlannedSeries planned, const std::vector<std::string>& values, const Changes& fixed) {
  std::vector<Changes> each;
  for (const std::string& value : values) {
    each.push_back(joined(fixed, {{planned.series.key, value}}));
  }
  series(std::move(planned), values, each);
}

void SweepPlanner::series(PlannedSeries planned, const std::vector<std::string>& values,
                          const std::vector<Changes>& each) {
  for (size_t i = 0; i < values.size(); ++i) {
    double x = 0.0;
    std::from_chars(values[i].data(), values[i].data() + values[i].size(), x);
    const int point = add(each[i]);
    const auto& points = planned.series.points;
    if (std::find(points.begin(), points.end(), point) == points.end()) {
      planned.series.x.push_back(x);
      planned.series.points.push_back(point);
    }
  }
  if (planned.series.points.size() > 1) {
    plan.series.push_back(std::move(planned));
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
  return wanted == "quick" || wanted == "full" ? builtIn(wanted, context) : readSweepPlan(wanted, context);
}

}  // namespace speculum
