#include "frame/setting_fields.hpp"

#include <algorithm>
#include <array>
#include <cctype>

#include "scene/member_count.hpp"
#include "scene/value_range.hpp"

namespace speculum {

namespace {

using R = ReflectionSettings;
using V = ViewSettings;
using E = EffectSettings;
using Q = QualitySettings;
using D = DebugSettings;
using enum FramePart;

constexpr int anyCount = 1'000'000;

template <auto Group, auto Member>
constexpr auto& valueIn(Settings& settings) {
  return (settings.*Group).*Member;
}

// Finds the group of settings that a member pointer belongs to.
template <typename Group>
constexpr auto groupOf = nullptr;
template <>
constexpr auto groupOf<R> = &Settings::reflection;
template <>
constexpr auto groupOf<V> = &Settings::view;
template <>
constexpr auto groupOf<E> = &Settings::effects;
template <>
constexpr auto groupOf<Q> = &Settings::quality;
template <>
constexpr auto groupOf<D> = &Settings::debug;

template <typename Group, typename T>
Group ownerOf(T Group::*);
template <typename Group, typename T>
T typeOf(T Group::*);

template <auto Member>
constexpr SettingMember<decltype(typeOf(Member))> at{valueIn<groupOf<decltype(ownerOf(Member))>, Member>};

// `names` in the order of the enumerators.
template <auto Member>
constexpr ChoiceSetting choice(std::span<const std::string_view> names) {
  using Enum = decltype(typeOf(Member));
  return {[](const Settings& settings) { return static_cast<int>(at<Member>.of(settings)); },
          [](Settings& settings, int index) { at<Member>.of(settings) = static_cast<Enum>(index); }, names};
}

constexpr std::array<std::string_view, 3> reflectionMethods{"auto", "raster", "rays"};
constexpr std::array<std::string_view, 3> clipMethods{"clip_distance", "oblique", "none"};
constexpr std::array<std::string_view, 2> toneMaps{"clamp", "aces"};
constexpr std::array<std::string_view, 2> textureFilters{"bilinear", "trilinear"};
constexpr std::array<std::string_view, 2> reflectionSources{"traced", "image"};
constexpr std::array<std::string_view, 3> rayMethods{"auto", "hardware", "software"};
constexpr std::array<std::string_view, 2> curvedLookups{"traced", "environment"};
constexpr std::array<std::string_view, 2> shadowLookups{"traced", "map"};
constexpr SettingNeed environmentMaps{"effects.curved_lookup", "environment"};
constexpr SettingNeed shadowMaps{"effects.shadow_lookup", "map"};

constexpr SettingField fields[] = {
    {.key = "reflection.method",
     .kind = choice<&R::method>(reflectionMethods),
     .label = "Method",
     .text =
         "mirrors by images that passes render, or by rays; auto: rays for small ones on CPUs, and on GPUs for all if "
         "one covers much of a picture with one sample a pixel",
     .cost = "A ray costs more than a texel, but no pass for each mirror."},
    {.key = "reflection.scale",
     .kind = NumberSetting{at<&R::scale>, 0.125, 4.0},
     .label = "Mirror resolution",
     .text = "resolution of mirror images relative to the main view",
     .cost = "Pixels grow with its square. Below 1 reflections blur, above 1 edges smooth.",
     .slider = SettingSlider{0.125, 4.0, "%.3f"}},
    {.key = "reflection.samples",
     .kind = IntegerSetting{at<&R::samples>, 1, 8, true},
     .label = "Samples",
     .text = "samples a pixel of mirror images",
     .cost = "Shading grows with it."},
    {.key = "reflection.max_depth",
     .kind = IntegerSetting{at<&R::maxDepth>, 0, 32},
     .label = "Max. depth",
     .text = "depth of mirror images; 1: only mirrors seen directly",
     .cost = "Each adds passes.",
     .slider = SettingSlider{0, 32, "%d", false}},
    {.key = "reflection.min_pixels",
     .kind = NumberSetting{at<&R::minPixels>, 0.0, 1e12},
     .label = "Min. pixels",
     .text = "smallest visible mirror area worth a pass",
     .cost = "Saves passes.",
     .unit = "pixels",
     .slider = SettingSlider{0.0, 1e4, "%.1f"}},
    {.key = "reflection.min_throughput",
     .kind = NumberSetting{at<&R::minThroughput>, 0.0, 1.0},
     .label = "Min. throughput",
     .text = "smallest throughput worth a pass",
     .cost = "Saves passes.",
     .slider = SettingSlider{0.0, 1.0, "%.5f"}},
    {.key = "reflection.max_passes",
     .kind = IntegerSetting{at<&R::maxPasses>, 1, anyCount},
     .label = "Max. passes",
     .text = "most mirror passes a frame, best first",
     .cost = "Bounds the time.",
     .slider = SettingSlider{1, 256, "%d", false}},
    {.key = "reflection.update_interval",
     .kind = IntegerSetting{at<&R::updateInterval>, 1, anyCount},
     .label = "Update interval",
     .text = "mirrors seen directly are rendered every n-th frame and reprojected in between",
     .cost = "Saves passes; what moves in them moves in steps.",
     .unit = "frames",
     .changes = mainView,
     .slider = SettingSlider{1, 16, "%d", false}},
    {.key = "reflection.skip_unchanged",
     .kind = BooleanSetting{at<&R::skipUnchanged>},
     .label = "Reuse unchanged images",
     .text = "reuses a cached mirror image that would come out the same",
     .cost = "Saves its pass.",
     .changes = mainView},
    {.key = "reflection.mesh_error",
     .kind = NumberSetting{at<&R::meshError>, 0.0, 16.0},
     .label = "Mesh error",
     .text = "largest error of simplified objects in mirror images; 0: all triangles",
     .cost = "Saves vertices; shading shifts a little. Ignored while shadows or curved mirrors are traced.",
     .unit = "texels",
     .slider = SettingSlider{0.0, 16.0}},
    {.key = "reflection.clip",
     .kind = choice<&R::clip>(clipMethods),
     .label = "Clipping",
     .text = "how geometry behind a mirror is cut",
     .cost = "oblique loses depth precision near a mirror; none shows what is behind it."},

    {.key = "view.scale",
     .kind = NumberSetting{at<&V::scale>, 0.125, 1.0},
     .label = "Resolution",
     .text = "resolution of the main view relative to the picture; mirror images follow it",
     .cost = "Pixels grow with its square; below 1 the picture is softer.",
     .slider = SettingSlider{0.125, 1.0, "%.3f"}},
    {.key = "view.samples",
     .kind = IntegerSetting{at<&V::samples>, 1, 8, true},
     .label = "Samples",
     .text = "samples a pixel of the main view",
     .cost = "Shading grows with it.",
     .changes = mainView},
    {.key = "view.accumulate",
     .kind = IntegerSetting{at<&V::accumulate>, 1, 1024},
     .label = "Accumulate",
     .text = "pictures whose mean is shown, each offset within a pixel",
     .cost = "Time grows with it. From 16 on each has one sample.",
     .unit = "pictures",
     .slider = SettingSlider{1, 1024, "%d"}},
    {.key = "view.mesh_error",
     .kind = NumberSetting{at<&V::meshError>, 0.0, 16.0},
     .label = "Mesh error",
     .text = "largest error of simplified objects in the main view; 0: all triangles",
     .cost = "Saves vertices; shading shifts a little. Ignored while shadows or curved mirrors are traced.",
     .unit = "texels",
     .changes = mainView,
     .slider = SettingSlider{0.0, 16.0}},
    {.key = "view.exposure",
     .kind = NumberSetting{at<&V::exposure>, 0.0, 1e6},
     .label = "Exposure",
     .text = "factor on radiance before the tone curve",
     .cost = "Costs nothing.",
     .changes = display,
     .slider = SettingSlider{0.01, 100.0}},
    {.key = "view.tone_map",
     .kind = choice<&V::toneMap>(toneMaps),
     .label = "Tone curve",
     .text = "curve from radiance to display values",
     .cost = "Costs nothing.",
     .changes = display},
    {.key = "view.clear_color",
     .kind = ColorSetting{at<&V::clearColor>},
     .label = "Clear color",
     .text = "replaces the scene's background and sky",
     .cost = "Costs nothing.",
     .subject = true},
    {.key = "view.texture_filter",
     .kind = choice<&V::textureFilter>(textureFilters),
     .label = "Texture filter",
     .text = "how textures are sampled",
     .cost = "trilinear reads eight texels instead of four; far textures are calmer."},
    {.key = "view.wireframe",
     .kind = BooleanSetting{at<&V::wireframe>},
     .label = "Wireframe",
     .text = "edges of triangles only",
     .cost = "A device without wireframe fills triangles.",
     .subject = true},
    {.key = "view.continuous",
     .kind = BooleanSetting{at<&V::continuous>},
     .label = "Draw continuously",
     .text = "the window draws all the time, even without changes",
     .cost = "Uses power in still pictures.",
     .changes = mainView},

    {.key = "effects.shadows",
     .kind = BooleanSetting{at<&E::shadows>},
     .label = "Shadows",
     .text = "shadows of lights that cast them",
     .cost = "Traces rays wherever lights reach."},
    {.key = "effects.shadow_lookup",
     .kind = choice<&E::shadowLookup>(shadowLookups),
     .label = "Shadow look-up",
     .text = "shadows by rays, or from shadow maps",
     .cost = "map takes no rays, and renders only what changed."},
    {.key = "effects.shadow_map_size",
     .kind = IntegerSetting{at<&E::shadowMapSize>, 64, 4096, true},
     .label = "Shadow map size",
     .text = "side of a shadow map's images",
     .cost = "Memory grows with its square; edges get sharper.",
     .unit = "texels",
     .needs = shadowMaps},
    {.key = "effects.roughness",
     .kind = BooleanSetting{at<&E::roughness>},
     .label = "Roughness",
     .text = "blur of rough mirrors",
     .cost = "Traces rays there."},
    {.key = "effects.rough_samples",
     .kind = IntegerSetting{at<&E::roughSamples>, 1, 4096},
     .label = "Rough samples",
     .text = "rays or look-ups a pixel of rough mirrors; equally many rays at each sample, at least one",
     .cost = "Time grows with it, noise falls with its square root.",
     .slider = SettingSlider{1, 256, "%d"}},
    {.key = "effects.rough_lookup",
     .kind = choice<&E::roughLookup>(reflectionSources),
     .label = "Rough look-up",
     .text = "rough mirrors by rays, or from their image as if smooth",
     .cost = "image takes a fraction of the time."},
    {.key = "effects.rays",
     .kind = choice<&E::rays>(rayMethods),
     .label = "Rays",
     .text = "rays by ray queries of the GPU or by shaders; auto: ray queries, except on CPUs",
     .cost = "The picture is the same but for rounding."},
    {.key = "effects.per_sample",
     .kind = BooleanSetting{at<&E::perSample>},
     .label = "Rays at every sample",
     .text = "shadows and curved mirrors at every sample, not once a pixel",
     .cost = "Rays grow with samples."},
    {.key = "effects.ripple",
     .kind = BooleanSetting{at<&E::ripple>},
     .label = "Ripples",
     .text = "ripples of mirrors",
     .cost = "Traces rays where water is seen."},
    {.key = "effects.ripple_lookup",
     .kind = choice<&E::rippleLookup>(reflectionSources),
     .label = "Ripple look-up",
     .text = "rippled mirrors by rays, or from their image as if smooth",
     .cost = "image takes a fraction of the time."},
    {.key = "effects.casts_light",
     .kind = BooleanSetting{at<&E::castsLight>},
     .label = "Bounced light",
     .text = "light bounced off mirrors",
     .cost = "Traces rays near them."},
    {.key = "effects.curved",
     .kind = BooleanSetting{at<&E::curved>},
     .label = "Curved mirrors",
     .text = "objects that are mirrors",
     .cost = "Traces rays there."},
    {.key = "effects.fresnel",
     .kind = BooleanSetting{at<&E::fresnel>},
     .label = "Fresnel",
     .text = "mirrors that reflect more at grazing angles",
     .cost = "Costs next to nothing."},
    {.key = "effects.textures",
     .kind = BooleanSetting{at<&E::textures>},
     .label = "Textures",
     .text = "textures of objects",
     .cost = "Four texels a pixel, and memory for all while one is in view."},
    {.key = "effects.glyphs",
     .kind = BooleanSetting{at<&E::glyphs>},
     .label = "Glowing lights",
     .text = "spheres of lights that glow",
     .cost = "One draw in each pass that sees a light."},
    {.key = "effects.curved_lookup",
     .kind = choice<&E::curvedLookup>(curvedLookups),
     .label = "Curved look-up",
     .text = "curved mirrors by rays, or from environment maps",
     .cost = "environment takes no rays, and renders only what changed."},
    {.key = "effects.environment_size",
     .kind = IntegerSetting{at<&E::environmentSize>, 16, 1024, true},
     .label = "Map size",
     .text = "side of an environment map's images",
     .cost = "Time and memory grow with its square.",
     .unit = "texels",
     .needs = environmentMaps},
    {.key = "effects.environment_interval",
     .kind = IntegerSetting{at<&E::environmentInterval>, 1, anyCount},
     .label = "Map interval",
     .text = "environment maps are rendered at most every n-th frame",
     .cost = "What moves in them moves in steps.",
     .unit = "frames",
     .slider = SettingSlider{1, 60, "%d", false},
     .needs = environmentMaps},
    {.key = "effects.environment_box",
     .kind = BooleanSetting{at<&E::environmentBox>},
     .label = "Box around the map",
     .text = "takes the surroundings of environment maps for a box",
     .cost = "Costs nothing; without it they seem infinitely far.",
     .needs = environmentMaps},

    {.key = "quality.budget_ms",
     .kind = NumberSetting{at<&Q::budgetMs>, 0.0, 1e6},
     .label = "GPU budget (ms)",
     .text = "chooses the most accurate measured settings up to this GPU time; 0: off",
     .cost = "Costs nothing.",
     .changes = none},
    {.key = "quality.max_error",
     .kind = NumberSetting{at<&Q::maxError>, 0.0, 1.0},
     .label = "Max. mean FLIP",
     .text = "chooses the fastest measured settings up to this mean FLIP, the perceived error; 0: off",
     .cost = "Costs nothing.",
     .changes = none},
    {.key = "quality.motion_ms",
     .kind = AutomaticSetting{at<&Q::motionMs>, 0.0, 1e6},
     .label = "Full quality while moving",
     .text = "longest frame while anything moves; settings are lowered to keep it. auto: 50 ms on CPUs, elsewhere 0.8 "
             "of a refresh; 0: settings are not lowered",
     .cost = "At 0 movement may stutter.",
     .unit = "ms",
     .changes = none},
    {.key = "quality.still_pictures",
     .kind = IntegerSetting{at<&Q::stillPictures>, 1, 1024},
     .label = "Still pictures",
     .text = "pictures whose mean the window shows when nothing moves",
     .cost = "As many are drawn after each movement.",
     .changes = none,
     .slider = SettingSlider{1, 1024, "%d"}},

    {.key = "debug.omit_barrier",
     .kind = TextSetting{at<&D::omitBarrier>, "name of a barrier"},
     .label = "Omit barrier",
     .text = "omits a barrier; validation must notice",
     .cost = "The picture may be wrong.",
     .changes = mainView},
    {.key = "debug.check_finite",
     .kind = BooleanSetting{at<&D::checkFinite>},
     .label = "Check that radiance is finite",
     .text = "finds radiance that is NaN, infinite or negative",
     .cost = "Reads every sample once more.",
     .changes = mainView},
    {.key = "debug.skip_hidden",
     .kind = BooleanSetting{at<&D::skipHidden>},
     .label = "Skip hidden mirrors",
     .text = "mirrors hidden by occluders have no pass",
     .cost = "Saves passes.",
     .changes = mainView},
    {.key = "debug.cull_clusters",
     .kind = BooleanSetting{at<&D::cullClusters>},
     .label = "Cull clusters",
     .text = "clusters outside a view are not drawn",
     .cost = "Saves vertices; costs a few draw calls.",
     .changes = mainView},
    {.key = "debug.mask_passes",
     .kind = BooleanSetting{at<&D::maskPasses>},
     .label = "Mask passes",
     .text = "only visible regions of mirror images are shaded",
     .cost = "Saves shading.",
     .changes = mainView},
};

template <typename Group>
consteval bool describes(std::string_view prefix) {
  const auto described = std::count_if(std::begin(fields), std::end(fields),
                                       [&](const SettingField& field) { return field.key.starts_with(prefix); });
  return static_cast<size_t>(described) == memberCount<Group>();
}
static_assert(describes<R>("reflection."), "describe every member of ReflectionSettings above");
static_assert(describes<V>("view."), "describe every member of ViewSettings above");
static_assert(describes<E>("effects."), "describe every member of EffectSettings above");
static_assert(describes<Q>("quality."), "describe every member of QualitySettings above");
static_assert(describes<D>("debug."), "describe every member of DebugSettings above");
static_assert(memberCount<Settings>() == 5, "name the group of settings above");

}  // namespace

std::span<const SettingField> settingFields() {
  return fields;
}

const SettingField* findSettingField(std::string_view key) {
  const auto* found = std::ranges::find(fields, key, &SettingField::key);
  return found == std::end(fields) ? nullptr : found;
}

std::string settingRange(const SettingField& field) {
  struct Visitor {
    std::string operator()(const NumberSetting& n) const { return Range{n.low, n.high}.shortText(); }
    std::string operator()(const AutomaticSetting& n) const { return "auto | " + Range{n.low, n.high}.shortText(); }
    std::string operator()(const IntegerSetting& n) const {
      if (!n.powersOfTwo) {
        return std::to_string(n.low) + " .. " + std::to_string(n.high);
      }
      std::string powers = std::to_string(n.low);
      for (int power = 2 * n.low; power <= n.high; power *= 2) {
        powers += " " + std::to_string(power);
      }
      return powers;
    }
    std::string operator()(const BooleanSetting&) const { return "true | false"; }
    std::string operator()(const ChoiceSetting& choice) const {
      std::string names(choice.names.front());
      for (const std::string_view name : choice.names.subspan(1)) {
        names.append(" | ").append(name);
      }
      return names;
    }
    std::string operator()(const ColorSetting&) const { return "r,g,b (linear, " + kRadiance.shortText() + ")"; }
    std::string operator()(const TextSetting& text) const { return std::string(text.meaning); }
  };
  return std::visit(Visitor(), field.kind);
}

std::string settingRangeWithUnit(const SettingField& field) {
  return (field.unit.empty() ? "" : std::string(field.unit) + ", ") + settingRange(field);
}

bool sameSetting(const SettingField& field, const Settings& a, const Settings& b) {
  return std::visit(
      [&](const auto& kind) {
        if constexpr (std::is_same_v<std::decay_t<decltype(kind)>, ChoiceSetting>) {
          return kind.get(a) == kind.get(b);
        } else {
          return kind.value.of(a) == kind.value.of(b);
        }
      },
      field.kind);
}

void copySetting(const SettingField& field, const Settings& from, Settings& to) {
  std::visit(
      [&](const auto& kind) {
        if constexpr (std::is_same_v<std::decay_t<decltype(kind)>, ChoiceSetting>) {
          kind.set(to, kind.get(from));
        } else {
          kind.value.of(to) = kind.value.of(from);
        }
      },
      field.kind);
}

std::string settingHelp(std::string_view key) {
  const SettingField* field = findSettingField(key);
  if (!field) {
    return "";
  }
  std::string text = std::string(field->text) + ". " + std::string(field->cost);
  text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text + "\n" + std::string(key) + ": " + settingRangeWithUnit(*field);
}

}  // namespace speculum
