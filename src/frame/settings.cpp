#include "frame/settings.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "scene/input_error.hpp"
#include "scene/nearest_key.hpp"

namespace speculum {

namespace {

using nlohmann::ordered_json;
using Problem = std::optional<std::string>;

// How one key is read from text and written as JSON.
struct Setting {
  SettingInfo info;
  std::function<Problem(Settings&, std::string_view)> set;
  std::function<ordered_json(const Settings&)> get;
};

std::optional<double> parseNumber(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

std::string quoted(std::string_view text) {
  return "'" + std::string(text) + "'";
}

template <typename Group>
Setting number(SettingInfo info, Group Settings::*group, double Group::*member, double low, double high) {
  return {info,
          [=](Settings& s, std::string_view text) -> Problem {
            const std::optional<double> value = parseNumber(text);
            if (!value || *value < low || *value > high) {
              return quoted(text) + " is not a number in range (" + std::string(info.range) + ")";
            }
            (s.*group).*member = *value;
            return std::nullopt;
          },
          [=](const Settings& s) -> ordered_json { return (s.*group).*member; }};
}

template <typename Group>
Setting integer(SettingInfo info, Group Settings::*group, int Group::*member, int low, int high,
                bool powerOfTwo = false) {
  return {info,
          [=](Settings& s, std::string_view text) -> Problem {
            const std::optional<double> value = parseNumber(text);
            const bool whole = value && *value >= low && *value <= high && *value == std::floor(*value);
            const int n = whole ? static_cast<int>(*value) : 0;
            if (!whole || (powerOfTwo && (n & (n - 1)) != 0)) {
              return quoted(text) + " is not one of the whole numbers allowed (" + std::string(info.range) + ")";
            }
            (s.*group).*member = n;
            return std::nullopt;
          },
          [=](const Settings& s) -> ordered_json { return (s.*group).*member; }};
}

template <typename Group, typename Enum>
Setting choice(SettingInfo info, Group Settings::*group, Enum Group::*member,
               std::vector<std::pair<std::string, Enum>> names) {
  return {info,
          [=](Settings& s, std::string_view text) -> Problem {
            for (const auto& [name, value] : names) {
              if (name == text) {
                (s.*group).*member = value;
                return std::nullopt;
              }
            }
            return quoted(text) + " is not a choice (" + std::string(info.range) + ")";
          },
          [=](const Settings& s) -> ordered_json {
            for (const auto& [name, value] : names) {
              if ((s.*group).*member == value) {
                return name;
              }
            }
            return nullptr;
          }};
}

template <typename Group>
Setting boolean(SettingInfo info, Group Settings::*group, bool Group::*member) {
  return {info,
          [=](Settings& s, std::string_view text) -> Problem {
            if (text != "true" && text != "false") {
              return quoted(text) + " is not a choice (true | false)";
            }
            (s.*group).*member = text == "true";
            return std::nullopt;
          },
          [=](const Settings& s) -> ordered_json { return (s.*group).*member; }};
}

std::optional<glm::dvec3> parseColor(std::string_view text) {
  if (!text.empty() && text.front() == '[' && text.back() == ']') {
    text = text.substr(1, text.size() - 2);
  }
  glm::dvec3 color(0.0);
  for (int channel = 0; channel < 3; ++channel) {
    const size_t comma = channel < 2 ? text.find(',') : text.size();
    if (comma == std::string_view::npos) {
      return std::nullopt;
    }
    std::string_view part = text.substr(0, comma);
    while (!part.empty() && part.front() == ' ') part.remove_prefix(1);
    while (!part.empty() && part.back() == ' ') part.remove_suffix(1);
    const std::optional<double> value = parseNumber(part);
    if (!value || *value < 0.0) {
      return std::nullopt;
    }
    color[channel] = *value;
    text.remove_prefix(channel < 2 ? comma + 1 : comma);
  }
  return color;
}

Setting clearColor(SettingInfo info) {
  return {info,
          [](Settings& s, std::string_view text) -> Problem {
            const std::optional<glm::dvec3> color = parseColor(text);
            if (!color) {
              return quoted(text) + " is not a colour (three linear values >= 0, such as 0.1,0.2,0.3)";
            }
            s.view.clearColor = color;
            return std::nullopt;
          },
          [](const Settings& s) -> ordered_json {
            if (!s.view.clearColor) {
              return nullptr;
            }
            const glm::dvec3& c = *s.view.clearColor;
            return ordered_json::array({c.x, c.y, c.z});
          }};
}

Setting text(SettingInfo info, std::string DebugSettings::*member) {
  return {info,
          [=](Settings& s, std::string_view value) -> Problem {
            s.debug.*member = value;
            return std::nullopt;
          },
          [=](const Settings& s) -> ordered_json { return s.debug.*member; }};
}

std::vector<Setting> reflectionTable() {
  using R = ReflectionSettings;
  const auto group = &Settings::reflection;
  return {
      number<R>({"reflection.scale", "0.125 .. 4", "resolution of mirror images relative to the screen"}, group,
                &R::scale, 0.125, 4.0),
      integer<R>({"reflection.samples", "1 2 4 8", "samples a pixel of mirror images"}, group, &R::samples, 1, 8, true),
      integer<R>({"reflection.max_depth", "0 .. 32", "mirrors seen directly need 1, mirrors in mirrors one more each"},
                 group, &R::maxDepth, 0, 32),
      number<R>({"reflection.min_pixels", "0 ..", "smallest visible mirror area worth a pass"}, group, &R::minPixels,
                0.0, 1e12),
      number<R>({"reflection.min_throughput", "0 .. 1", "a bounce that lets less through is dropped"}, group,
                &R::minThroughput, 0.0, 1.0),
      integer<R>({"reflection.max_passes", "1 ..", "most mirror passes a frame, best first"}, group, &R::maxPasses, 1,
                 1000000),
      integer<R>({"reflection.update_interval", "1 ..", "mirror images are rendered anew every n-th frame"}, group,
                 &R::updateInterval, 1, 1000000),
      boolean<R>(
          {"reflection.skip_unchanged", "true | false", "a mirror image that would be the same again is shown again"},
          group, &R::skipUnchanged),
      number<R>({"reflection.mesh_error", "0 .. 16",
                 "texels by which simplified objects in mirror images may be off; 0: all triangles are drawn"},
                group, &R::meshError, 0.0, 16.0),
      choice<R, ClipMethod>(
          {"reflection.clip", "clip_distance | oblique | none", "how geometry behind a mirror is cut"}, group, &R::clip,
          {{"clip_distance", ClipMethod::clipDistance}, {"oblique", ClipMethod::oblique}, {"none", ClipMethod::none}}),
  };
}

std::vector<Setting> viewTable() {
  using V = ViewSettings;
  const auto group = &Settings::view;
  return {
      integer<V>({"view.samples", "1 2 4 8", "samples a pixel of the main view"}, group, &V::samples, 1, 8, true),
      number<V>({"view.exposure", "0 .. 1e6", "factor on radiance before the tone curve"}, group, &V::exposure, 0.0,
                1e6),
      choice<V, ToneMap>({"view.tone_map", "clamp | aces", "tone curve"}, group, &V::toneMap,
                         {{"clamp", ToneMap::clamp}, {"aces", ToneMap::aces}}),
      clearColor({"view.clear_color", "r,g,b (linear, >= 0)", "replaces the scene's background and sky"}),
      choice<V, TextureFilter>({"view.texture_filter", "bilinear | trilinear", "lookup of textures"}, group,
                               &V::textureFilter,
                               {{"bilinear", TextureFilter::bilinear}, {"trilinear", TextureFilter::trilinear}}),
      boolean<V>({"view.wireframe", "true | false", "edges of triangles only"}, group, &V::wireframe),
      boolean<V>({"view.continuous", "true | false", "the window goes on drawing when nothing changes"}, group,
                 &V::continuous),
  };
}

std::vector<Setting> effectTable() {
  using E = EffectSettings;
  const auto group = &Settings::effects;
  return {
      boolean<E>({"effects.shadows", "true | false", "shadows of lights that cast them"}, group, &E::shadows),
      boolean<E>({"effects.roughness", "true | false", "blur of rough mirrors"}, group, &E::roughness),
      integer<E>({"effects.rough_samples", "1 .. 4096", "rays or look-ups a pixel of rough mirrors"}, group,
                 &E::roughSamples, 1, 4096),
      choice<E, RoughLookup>({"effects.rough_lookup", "traced | image",
                              "what rough mirrors look up: rays, or the image of the mirror as if it were smooth"},
                             group, &E::roughLookup, {{"traced", RoughLookup::traced}, {"image", RoughLookup::image}}),
      boolean<E>({"effects.per_sample", "true | false", "shadows and curved mirrors at every sample of a pixel"}, group,
                 &E::perSample),
      boolean<E>({"effects.ripple", "true | false", "ripples of mirrors"}, group, &E::ripple),
      boolean<E>({"effects.casts_light", "true | false", "light bounced off mirrors"}, group, &E::castsLight),
      boolean<E>({"effects.curved", "true | false", "objects that are mirrors"}, group, &E::curved),
      boolean<E>({"effects.fresnel", "true | false", "mirrors that reflect more towards grazing"}, group, &E::fresnel),
      boolean<E>({"effects.textures", "true | false", "textures of objects"}, group, &E::textures),
      boolean<E>({"effects.glyphs", "true | false", "the spheres of lights that glow"}, group, &E::glyphs),
      choice<E, CurvedLookup>({"effects.curved_lookup", "traced | environment",
                               "what curved mirrors look up: rays, or six images about the object's centre"},
                              group, &E::curvedLookup,
                              {{"traced", CurvedLookup::traced}, {"environment", CurvedLookup::environment}}),
      integer<E>({"effects.environment_size", "16 32 64 128 256 512 1024", "texels of a side of such an image"}, group,
                 &E::environmentSize, 16, 1024, true),
      integer<E>({"effects.environment_interval", "1 ..", "such images are rendered anew every n-th frame"}, group,
                 &E::environmentInterval, 1, 1000000),
      boolean<E>({"effects.environment_box", "true | false", "look-ups as if what is around the object were a box"},
                 group, &E::environmentBox),
  };
}

std::vector<Setting> qualityTable() {
  using Q = QualitySettings;
  const auto group = &Settings::quality;
  return {
      number<Q>({"quality.budget_ms", "0 ..", "the most accurate measured settings within so many GPU ms; 0: off"},
                group, &Q::budgetMs, 0.0, 1e6),
      number<Q>({"quality.max_error", "0 .. 1", "the fastest measured settings within this mean FLIP; 0: off"}, group,
                &Q::maxError, 0.0, 1.0),
  };
}

std::vector<Setting> debugTable() {
  return {
      text({"debug.omit_barrier", "name of a barrier", "leaves one barrier out; validation must notice"},
           &DebugSettings::omitBarrier),
      boolean<DebugSettings>(
          {"debug.check_finite", "true | false", "radiance that is NaN, infinite or negative is found"},
          &Settings::debug, &DebugSettings::checkFinite),
      boolean<DebugSettings>({"debug.skip_hidden", "true | false", "mirrors behind something flat have no pass"},
                             &Settings::debug, &DebugSettings::skipHidden),
      boolean<DebugSettings>(
          {"debug.cull_clusters", "true | false", "parts of objects that a view cannot see are not drawn"},
          &Settings::debug, &DebugSettings::cullClusters),
      boolean<DebugSettings>({"debug.mask_passes", "true | false", "only what is seen of a mirror image is shaded"},
                             &Settings::debug, &DebugSettings::maskPasses),
  };
}

const std::vector<Setting>& table() {
  static const std::vector<Setting> settings = [] {
    std::vector<Setting> all = reflectionTable();
    for (std::vector<Setting>& more : std::array{viewTable(), effectTable(), qualityTable(), debugTable()}) {
      std::move(more.begin(), more.end(), std::back_inserter(all));
    }
    return all;
  }();
  return settings;
}

const Setting* find(std::string_view key) {
  const auto& all = table();
  const auto it = std::find_if(all.begin(), all.end(), [&](const Setting& s) { return s.info.key == key; });
  return it == all.end() ? nullptr : &*it;
}

std::string unknownKey(std::string_view key) {
  std::vector<std::string_view> keys;
  for (const Setting& setting : table()) {
    keys.push_back(setting.info.key);
  }
  return "unknown setting (" + nearestKeyAdvice(key, keys) + ")";
}

std::string entryText(const SettingEntry& entry) {
  struct Visitor {
    std::string operator()(bool value) const { return value ? "true" : "false"; }
    std::string operator()(int64_t value) const { return std::to_string(value); }
    std::string operator()(double value) const { return ordered_json(value).dump(); }
    std::string operator()(const std::string& value) const { return value; }
    std::string operator()(const std::vector<double>& values) const { return ordered_json(values).dump(); }
  };
  return std::visit(Visitor{}, entry.value);
}

bool takesText(const Setting& setting) {
  return setting.get(Settings()).is_string();
}

}  // namespace

bool isSchlick(Fresnel fresnel, const EffectSettings& effects) {
  return effects.fresnel && fresnel == Fresnel::schlick;
}

bool hasGlyph(const PointLight& light, const EffectSettings& effects) {
  return effects.glyphs && light.glow > 0.0;
}

std::span<const SettingInfo> settingInfos() {
  static const std::vector<SettingInfo> infos = [] {
    std::vector<SettingInfo> list;
    for (const Setting& setting : table()) {
      list.push_back(setting.info);
    }
    return list;
  }();
  return infos;
}

std::optional<std::string> setSetting(Settings& settings, std::string_view key, std::string_view value) {
  const Setting* setting = find(key);
  if (!setting) {
    return std::string(key) + ": " + unknownKey(key);
  }
  if (const Problem problem = setting->set(settings, value)) {
    return std::string(key) + ": " + *problem;
  }
  return std::nullopt;
}

std::string settingValue(const Settings& settings, std::string_view key) {
  const Setting* setting = find(key);
  if (!setting) {
    return {};
  }
  const ordered_json value = setting->get(settings);
  return value.is_string() ? value.get<std::string>() : value.is_null() ? std::string() : value.dump();
}

std::string settingsKey(const Settings& settings) {
  std::string text;
  for (const Setting& setting : table()) {
    text += std::string(setting.info.key) + "=" + setting.get(settings).dump() + "\n";
  }
  return text;
}

Settings settingsOf(const Scene& scene) {
  Settings settings;
  for (const SettingEntry& entry : scene.settings) {
    const Setting* setting = find(entry.key);
    Problem problem = setting && std::holds_alternative<std::string>(entry.value) && !takesText(*setting)
                          ? entry.key + ": a string is the wrong type (" + std::string(setting->info.range) + ")"
                          : setSetting(settings, entry.key, entryText(entry));
    if (problem) {
      throw InputError(oneLine(scene.file.string() + ":" + std::to_string(entry.line) + ": " + *problem));
    }
  }
  return settings;
}

bool sameMirrorImages(const Settings& a, const Settings& b) {
  Settings c = b;
  c.reflection.updateInterval = a.reflection.updateInterval;
  c.reflection.skipUnchanged = a.reflection.skipUnchanged;
  c.view.samples = a.view.samples;
  c.view.exposure = a.view.exposure;
  c.view.toneMap = a.view.toneMap;
  c.view.continuous = a.view.continuous;
  return a.reflection == c.reflection && a.view == c.view && a.effects == c.effects;
}

bool sameMainView(const Settings& a, const Settings& b) {
  ViewSettings view = b.view;
  view.exposure = a.view.exposure;
  view.toneMap = a.view.toneMap;
  return a.reflection == b.reflection && a.view == view && a.effects == b.effects && a.debug == b.debug;
}

ordered_json settingsJson(const Settings& settings) {
  ordered_json json = ordered_json::object();
  for (const Setting& setting : table()) {
    json[std::string(setting.info.key)] = setting.get(settings);
  }
  return json;
}

Environment effectiveEnvironment(const Scene& scene, const Settings& settings) {
  Environment environment = scene.environment;
  if (settings.view.clearColor) {
    environment.background = *settings.view.clearColor;
    environment.sky.reset();
  }
  return environment;
}

}  // namespace speculum
