#include "settings/settings.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "platform/text.hpp"
#include "scene/input_error.hpp"
#include "scene/text_lines.hpp"
#include "settings/setting_fields.hpp"

namespace speculum {

namespace {

using nlohmann::ordered_json;
using Problem = std::optional<std::string>;

std::optional<double> parseNumber(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
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
    const std::optional<double> value = parseNumber(trimmed(text.substr(0, comma)));
    if (!value || !radianceRange.contains(*value)) {
      return std::nullopt;
    }
    color[channel] = *value;
    text.remove_prefix(channel < 2 ? comma + 1 : comma);
  }
  return color;
}

// Sets the value of a setting from text; returns what is wrong with the text.
struct Parser {
  Settings& settings;
  const SettingField& field;
  std::string_view text;

  Problem wrong(std::string_view what) const {
    return "'" + std::string(text) + "' is not " + std::string(what) + " (" + settingRange(field) + ")";
  }

  Problem operator()(const NumberSetting& number) const {
    const std::optional<double> value = parseNumber(text);
    if (!value || *value < number.low || *value > number.high) {
      return wrong("a number in range");
    }
    number.value.of(settings) = *value;
    return std::nullopt;
  }

  Problem operator()(const AutomaticSetting& number) const {
    const std::optional<double> value = parseNumber(text);
    if (text != "auto" && (!value || *value < number.low || *value > number.high)) {
      return wrong("auto or a number in range");
    }
    number.value.of(settings) = value;
    return std::nullopt;
  }

  Problem operator()(const IntegerSetting& integer) const {
    const std::optional<double> value = parseNumber(text);
    const bool whole = value && *value >= integer.low && *value <= integer.high && *value == std::floor(*value);
    const int n = whole ? static_cast<int>(*value) : 0;
    const bool automatic = integer.automatic && text == "auto";
    if (!automatic && (!whole || (integer.powersOfTwo && (n & (n - 1)) != 0))) {
      return wrong("one of the whole numbers allowed");
    }
    integer.value.of(settings) = n;
    return std::nullopt;
  }

  Problem operator()(const BooleanSetting& boolean) const {
    if (text != "true" && text != "false") {
      return wrong("a choice");
    }
    boolean.value.of(settings) = text == "true";
    return std::nullopt;
  }

  Problem operator()(const ChoiceSetting& choice) const {
    const auto found = std::ranges::find(choice.names, text);
    if (found == choice.names.end()) {
      return wrong("a choice");
    }
    choice.set(settings, static_cast<int>(found - choice.names.begin()));
    return std::nullopt;
  }

  Problem operator()(const ColorSetting& color) const {
    const std::optional<glm::dvec3> value = parseColor(text);
    if (!value && !text.empty() && text != "[]") {
      return "'" + std::string(text) + "' is not a color (three linear values " + radianceRange.shortText() +
             ", such as 0.1,0.2,0.3)";
    }
    color.value.of(settings) = value;
    return std::nullopt;
  }

  Problem operator()(const TextSetting& kind) const {
    kind.value.of(settings) = text;
    return std::nullopt;
  }
};

struct JsonValue {
  const Settings& settings;

  ordered_json operator()(const ChoiceSetting& choice) const { return choice.names[choice.get(settings)]; }
  ordered_json operator()(const AutomaticSetting& number) const {
    const std::optional<double>& value = number.value.of(settings);
    return value ? ordered_json(*value) : ordered_json("auto");
  }
  ordered_json operator()(const IntegerSetting& integer) const {
    const int value = integer.value.of(settings);
    return integer.automatic && value == 0 ? ordered_json("auto") : ordered_json(value);
  }
  ordered_json operator()(const ColorSetting& color) const {
    const std::optional<glm::dvec3>& c = color.value.of(settings);
    return c ? ordered_json::array({c->x, c->y, c->z}) : ordered_json();
  }
  ordered_json operator()(const auto& kind) const { return kind.value.of(settings); }
};

ordered_json jsonOf(const SettingField& field, const Settings& settings) {
  return std::visit(JsonValue{settings}, field.kind);
}

std::string unknownKey(std::string_view key) {
  std::vector<std::string_view> keys;
  for (const SettingField& field : settingFields()) {
    keys.push_back(field.key);
  }
  return "unknown setting (" + nearestKeyAdvice(key, keys) + ")";
}

bool takesText(const SettingField& field) {
  const auto* integer = std::get_if<IntegerSetting>(&field.kind);
  return (integer && integer->automatic) || std::holds_alternative<ChoiceSetting>(field.kind) ||
         std::holds_alternative<TextSetting>(field.kind) || std::holds_alternative<AutomaticSetting>(field.kind) ||
         std::holds_alternative<ColorSetting>(field.kind);
}

// Says whether all settings are equal that change the part `last` of a frame or an earlier part.
bool sameUpTo(FramePart last, const Settings& a, const Settings& b) {
  const auto same = [&](const SettingField& field) { return field.changes > last || sameSetting(field, a, b); };
  return a.limit == b.limit && a.view.radianceScale() == b.view.radianceScale() &&
         std::ranges::all_of(settingFields(), same);
}

MirrorOptics withEffects(MirrorOptics optics, const EffectSettings& effects) {
  optics.fresnel = effects.fresnel ? optics.fresnel : Fresnel::none;
  optics.alpha = effects.roughness ? optics.alpha : 0.0;
  optics.ripple = effects.ripple ? optics.ripple : std::nullopt;
  optics.map = effects.textures ? optics.map : -1;
  return optics;
}

}  // namespace

double ViewSettings::radianceScale() const {
  constexpr double most = 4096.0;
  constexpr double least = 0x1p-100;  // radiance times this is still a float
  const bool ordinary = exposure == 0.0 || (exposure >= 1.0 / most && exposure <= most);
  return ordinary ? 1.0 : std::exp2(std::floor(std::log2(std::max(exposure, least))));
}

MirrorOptics opticsOf(const Mirror& mirror, const EffectSettings& effects) {
  return withEffects(opticsOf(mirror), effects);
}

MirrorOptics opticsOf(const ObjectMirror& mirror, const EffectSettings& effects) {
  return withEffects(opticsOf(mirror), effects);
}

int roughRays(const EffectSettings& effects, int samples) {
  return (effects.roughSamples + samples - 1) / samples * samples;
}

bool isTransparent(const Material& material, const EffectSettings& effects) {
  return effects.transparency && (material.opacity < 1.0 || material.cutoff > 1.0 || material.vertexAlpha ||
                                  (material.opacityTexture >= 0 && effects.textures));
}

bool isTransparent(const Mesh& mesh, const EffectSettings& effects) {
  return std::ranges::any_of(mesh.parts, [&](const MeshPart& part) { return isTransparent(part.material, effects); });
}

bool hasGlyph(const PointLight& light, const EffectSettings& effects) {
  return effects.glyphs && light.glow > 0.0;
}

ReflectionSettings reflectionOf(const MirrorQuality& own, const Settings& settings) {
  ReflectionSettings asked = settings.reflection;
  const QualityLimit& limit = settings.limit;
  asked.scale = own.scale ? std::min(*own.scale, limit.scale) : asked.scale;
  asked.samples = own.samples ? std::min(*own.samples, limit.samples) : asked.samples;
  if (own.updateInterval) {
    asked.updateInterval = std::min(std::max(*own.updateInterval, limit.leastInterval), limit.mostInterval);
  }
  if (own.method) {
    asked.method = !limit.rays                                  ? ReflectionMethod::raster
                   : *own.method == ReflectionMethod::automatic ? limit.automatic
                                                                : *own.method;
  }
  return asked;
}

ReflectionSettings mostAsked(const Scene& scene, const Settings& settings) {
  ReflectionSettings most = settings.reflection;
  for (const Mirror& mirror : scene.mirrors) {
    const ReflectionSettings asked = reflectionOf(mirror.quality, settings);
    most.scale = std::max(most.scale, asked.scale);
    most.samples = std::max(most.samples, asked.samples);
    most.updateInterval = std::max(most.updateInterval, asked.updateInterval);
  }
  return most;
}

void lowerLimit(const ReflectionSettings& before, Settings& settings) {
  const ReflectionSettings& now = settings.reflection;
  QualityLimit& limit = settings.limit;
  limit.scale = now.scale < before.scale ? std::min(limit.scale, now.scale) : limit.scale;
  limit.samples = now.samples < before.samples ? std::min(limit.samples, now.samples) : limit.samples;
  if (now.updateInterval > before.updateInterval) {
    limit.leastInterval = std::max(limit.leastInterval, now.updateInterval);
  }
  limit.rays = limit.rays && (now.method == before.method || now.method != ReflectionMethod::raster);
}

std::optional<std::string> setSetting(Settings& settings, std::string_view key, std::string_view value) {
  const SettingField* field = findSettingField(key);
  const Problem problem = field ? std::visit(Parser{settings, *field, value}, field->kind) : unknownKey(key);
  return problem ? std::string(key) + ": " + *problem : Problem();
}

std::string settingValue(const Settings& settings, std::string_view key) {
  const SettingField* field = findSettingField(key);
  const ordered_json value = field ? jsonOf(*field, settings) : ordered_json();
  return value.is_string() ? value.get<std::string>() : value.is_null() ? std::string() : value.dump();
}

std::string settingsKey(const Settings& settings) {
  std::string text;
  for (const SettingField& field : settingFields()) {
    text += std::string(field.key) + "=" + jsonOf(field, settings).dump() + "\n";
  }
  return text;
}

std::vector<SettingChange> settingChanges(const Settings& from, const Settings& to) {
  std::vector<SettingChange> changes;
  for (const SettingField& field : settingFields()) {
    if (!sameSetting(field, from, to)) {
      changes.push_back({std::string(field.key), settingValue(to, field.key)});
    }
  }
  return changes;
}

Settings settingsOf(const Scene& scene) {
  Settings settings;
  for (const SettingEntry& entry : scene.settings) {
    const SettingField* field = findSettingField(entry.key);
    const Problem problem = field && entry.quoted && !takesText(*field)
                                ? entry.key + ": a string is the wrong type (" + settingRange(*field) + ")"
                                : setSetting(settings, entry.key, entry.value);
    if (problem) {
      throw InputError(oneLine(scene.file.string() + ":" + std::to_string(entry.line) + ": " + *problem));
    }
  }
  return settings;
}

bool sameMirrorImages(const Settings& a, const Settings& b) {
  return sameUpTo(FramePart::mirrorImages, a, b);
}

bool sameMainView(const Settings& a, const Settings& b) {
  return sameUpTo(FramePart::mainView, a, b);
}

ordered_json settingsJson(const Settings& settings) {
  ordered_json json = ordered_json::object();
  for (const SettingField& field : settingFields()) {
    json[std::string(field.key)] = jsonOf(field, settings);
  }
  return json;
}

}  // namespace speculum
