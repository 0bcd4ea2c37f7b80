#include "settings/setting_fields.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "scene/scene_fields.hpp"

namespace speculum {

namespace {

using R = ReflectionSettings;
using V = ViewSettings;
using E = EffectSettings;
using Q = QualitySettings;
using D = DebugSettings;
using U = UiSettings;
using enum FramePart;
using enum Cheaper;

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
template <>
constexpr auto groupOf<U> = &Settings::ui;

template <typename Group, typename T>
Group ownerOf(T Group::*);
template <typename Group, typename T>
T typeOf(T Group::*);

template <auto Member>
constexpr MemberSetting<decltype(typeOf(Member))> at{{valueIn<groupOf<decltype(ownerOf(Member))>, Member>}};

// `names` in the order of the enumerators.
template <auto Member>
constexpr ChoiceSetting choice(std::span<const std::string_view> names) {
  using Enum = decltype(typeOf(Member));
  return {[](const Settings& settings) { return static_cast<int>(at<Member>.get(settings)); },
          [](Settings& settings, int index) { at<Member>.set(settings, static_cast<Enum>(index)); }, names};
}

constexpr SettingField setting(std::string_view key, const SettingKind& kind, const char* label, std::string_view text,
                               std::string_view cost, const SettingTraits& traits = {}) {
  return {traits, key, kind, label, text, cost};
}

constexpr auto reflectionMethods = choicesOf(ReflectionMethod());
constexpr std::array<std::string_view, 3> clipMethods{"clip_distance", "oblique", "none"};
constexpr std::array<std::string_view, 2> toneMaps{"clamp", "aces"};
constexpr std::array<std::string_view, 4> textureFilters{"bilinear", "trilinear", "nearest", "anisotropic"};
constexpr std::array<std::string_view, 2> reflectionSources{"traced", "image"};
constexpr std::array<std::string_view, 3> rayMethods{"auto", "hardware", "software"};
constexpr std::array<std::string_view, 2> curvedLookups{"traced", "environment"};
constexpr std::array<std::string_view, 4> shadowLookups{"auto", "traced", "hybrid", "map"};
constexpr SettingNeed environmentMaps{"effects.curved_lookup", "environment"};
constexpr SettingNeed shadowMaps{"effects.shadow_lookup", "traced", true};

// Returns the error of rough mirrors, shown by rays or by lookups in the mirror's image.
double roughError(const Settings& settings, size_t) {
  const EffectSettings& effects = settings.effects;
  const bool image = effects.roughLookup == ReflectionSource::image;
  const int samples = image ? effects.roughSamples : roughRays(effects, settings.view.samples);
  return std::hypot(image ? 0.13 : 0.0, 0.18 / std::sqrt(samples));
}

// Each row has key, value, label, text and cost, then the traits that differ from the default.
constexpr SettingField fields[] = {
    setting(
        "reflection.method", choice<&R::method>(reflectionMethods), "Method",
        "how mirrors are drawn; raster: a pass renders an image for each; rays: each pixel traces what it reflects; "
        "auto: whichever should be faster",
        "A ray costs more than a texel, but saves the mirror's pass."),
    setting("reflection.scale", NumberSetting{at<&R::scale>, imageScaleRange.low, imageScaleRange.high},
            "Mirror resolution", "resolution of mirror images relative to the main view",
            "Pixels grow with its square; below 1 reflections blur, above 1 edges smooth.",
            {.slider = SettingSlider{0.125, 4.0, "%.3f"},
             .cheaper = lower,
             .swept = {"0.125 0.25 0.5 1", "0.125 0.177 0.25 0.354 0.5 0.707 1"}}),
    setting("reflection.samples", IntegerSetting{at<&R::samples>, 1, 8, true}, "Mirror samples",
            "samples a pixel of mirror images", "Shading grows with it.",
            {.cheaper = lower, .error = [](const Settings& s, size_t) { return 0.009 / s.reflection.samples; }}),
    setting("reflection.max_depth", IntegerSetting{at<&R::maxDepth>, 0, 32}, "Max. depth",
            "depth of mirror images; 1: only mirrors seen directly", "Each adds passes.",
            {.slider = SettingSlider{0, 32, "%d", false},
             .cheaper = lower,
             .error = [](const Settings& s,
                         size_t) { return s.reflection.maxDepth == 0 ? 0.2 : 0.08 / s.reflection.maxDepth; },
             .swept = {"0 1 2 3 4 8 32", "0 1 2 3 4 5 6 8 12 16 32"}}),
    setting("reflection.min_pixels", NumberSetting{at<&R::minPixels>, 0.0, 1e12}, "Min. pixels",
            "smallest visible mirror area worth a pass", "Saves passes.",
            {.unit = "pixels",
             .slider = SettingSlider{0.0, 1e4, "%.1f"},
             .cheaper = higher,
             .error = [](const Settings& s, size_t) { return 3e-6 * s.reflection.minPixels; },
             .swept = {"1024", "64 1024 8192"}}),
    setting("reflection.min_throughput", NumberSetting{at<&R::minThroughput>, 0.0, 1.0}, "Min. throughput",
            "smallest throughput worth a pass", "Saves passes.",
            {.slider = SettingSlider{0.0, 1.0, "%.5f"}, .swept = {"0.2 0.05 0.01"}}),
    setting("reflection.max_passes", IntegerSetting{at<&R::maxPasses>, 1, anyCount}, "Max. passes",
            "most mirror passes a frame, best first", "Bounds the time.",
            {.slider = SettingSlider{1, 256, "%d", false},
             .cheaper = lower,
             .error =
                 [](const Settings& s, size_t mirrors) {
                   return 0.03 * std::min(1.0, static_cast<double>(mirrors) / 16.0) *
                          std::pow(8.0 / s.reflection.maxPasses, 1.6);
                 },
             .swept = {"1 2 4"}}),
    setting("reflection.update_interval", IntegerSetting{at<&R::updateInterval>, 1, anyCount}, "Update interval",
            "mirrors seen directly are rendered every n-th frame, and reprojected in between",
            "Saves passes; what moves in them moves in steps.",
            {.unit = "frames",
             .changes = mainView,
             .slider = SettingSlider{1, 16, "%d", false},
             .cheaper = higher,
             .swept = {"2 4", "2 4 8"}}),
    setting("reflection.skip_unchanged", BooleanSetting{at<&R::skipUnchanged>}, "Reuse unchanged images",
            "reuses cached mirror images that would come out the same", "Saves passes.", {.changes = mainView}),
    setting("reflection.clip", choice<&R::clip>(clipMethods), "Clipping", "how geometry behind a mirror is cut",
            "oblique loses depth precision near a mirror; none shows what is behind it.", {.swept = {"oblique none"}}),

    setting("view.scale", NumberSetting{at<&V::scale>, 0.125, 1.0}, "Resolution",
            "resolution of the main view relative to the picture; mirror images follow it",
            "Pixels grow with its square; below 1 the picture is softer.",
            {.slider = SettingSlider{0.125, 1.0, "%.3f"},
             .cheaper = lower,
             .error = [](const Settings& s, size_t) { return 0.055 * std::pow(1.0 / s.view.scale - 1.0, 0.62); },
             .swept = {"0.25 0.5 1", "0.125 0.177 0.25 0.354 0.5 0.707 1"}}),
    setting("view.samples", IntegerSetting{at<&V::samples>, 1, 8, true}, "Samples", "samples a pixel of the main view",
            "Shading grows with it.",
            {.changes = mainView,
             .cheaper = lower,
             .error = [](const Settings& s, size_t) { return 0.025 / s.view.samples; }}),
    setting("view.accumulate", IntegerSetting{at<&V::accumulate>, 1, 1024}, "Averaged pictures",
            "pictures whose mean is shown, each offset within a pixel; from 16 on, each has one sample a pixel",
            "Time grows with it.",
            {.unit = "pictures", .slider = SettingSlider{1, 1024, "%d"}, .swept = {"1 4 16 64"}}),
    setting("view.accumulate_error", NumberSetting{at<&V::accumulateError>, 0.0, 16.0}, "Error to stop at",
            "parts of a mean whose estimated error is below this are not drawn again; a step is 1/255; 0: off",
            "Saves time where a picture is smooth.",
            {.unit = "steps", .changes = display, .swept = {"0.25 1", "0.25 0.5 1 2"}}),
    setting("view.exposure", NumberSetting{at<&V::exposure>, 0.0, 1e6}, "Exposure",
            "factor on radiance before the tone curve", "Costs nothing.",
            {.changes = display, .slider = SettingSlider{0.01, 100.0}}),
    setting("view.tone_map", choice<&V::toneMap>(toneMaps), "Tone curve", "curve from radiance to display values",
            "Costs nothing.", {.changes = display}),
    setting("view.clear_color", ColorSetting{at<&V::clearColor>}, "Clear color",
            "replaces the scene's background and sky, unless it is empty", "Costs nothing.", {.subject = true}),
    setting("view.texture_filter", choice<&V::textureFilter>(textureFilters), "Texture filter",
            "how textures are sampled",
            "nearest reads a quarter of the texels; trilinear reads twice as many, anisotropic up to 32 times, and far "
            "textures are calmer.",
            {.swept = {"nearest trilinear anisotropic"}}),
    setting("view.wireframe", BooleanSetting{at<&V::wireframe>}, "Wireframe", "draws edges of triangles only",
            "A device without wireframe fills triangles.", {.subject = true}),
    setting("view.line_width", NumberSetting{at<&V::lineWidth>, 1.0, 64.0}, "Line width", "width of wireframe lines",
            "A device without wide lines draws them one pixel wide.",
            {.unit = "pixels",
             .subject = true,
             .slider = SettingSlider{1.0, 16.0, "%.1f", false},
             .needs = SettingNeed{"view.wireframe", "true"}}),
    setting("view.continuous", BooleanSetting{at<&V::continuous>}, "Draw continuously",
            "the window draws even without changes", "Uses power.", {.changes = mainView}),

    setting("effects.shadows", BooleanSetting{at<&E::shadows>}, "Shadows", "shadows of lights that cast them",
            "Traces rays wherever lights reach."),
    setting("effects.shadow_lookup", choice<&E::shadowLookup>(shadowLookups), "Shadow lookup",
            "how shadows are found; traced: by rays; map: in shadow maps; hybrid: in maps, and by rays where a map is "
            "not sure; auto: the way that should be fastest, in a mean of pictures no map if rays can be traced",
            "Maps render only what changed.", {.cheaper = higher, .swept = {"traced hybrid map"}}),
    setting("effects.shadow_map_size", IntegerSetting{at<&E::shadowMapSize>, 64, 4096, true, true}, "Shadow map size",
            "side of a shadow map's images; auto: texels about as large as the pixels that look them up",
            "Memory grows with its square; edges get sharper.",
            {.unit = "texels",
             .needs = shadowMaps,
             .cheaper = lower,
             .error =
                 [](const Settings& s, size_t) {
                   const int size = s.effects.shadowMapSize == 0 ? 1024 : s.effects.shadowMapSize;
                   const ShadowLookup lookup = s.effects.shadowLookup;
                   return lookup == ShadowLookup::map || lookup == ShadowLookup::automatic ? 15.0 / size : 0.0;
                 },
             .swept = {"auto 256 1024", "auto 256 1024 4096"}}),
    setting("effects.roughness", BooleanSetting{at<&E::roughness>}, "Roughness", "blur of rough mirrors",
            "Traces rays there."),
    setting("effects.rough_samples", IntegerSetting{at<&E::roughSamples>, 1, 4096}, "Rough samples",
            "rays or lookups a pixel of rough mirrors; each sample takes at least one",
            "Time grows with it, noise falls with its square root.",
            {.slider = SettingSlider{1, 256, "%d"},
             .cheaper = lower,
             .error = roughError,
             .swept = {"1 4 16 64", "1 2 4 8 16 32 64 128 256"}}),
    setting("effects.rough_lookup", choice<&E::roughLookup>(reflectionSources), "Rough lookup",
            "how rough mirrors are drawn; traced: by rays; image: from their image as if smooth",
            "image takes a fraction of the time.", {.cheaper = higher, .swept = {"image"}}),
    setting("effects.rays", choice<&E::rays>(rayMethods), "Rays",
            "how rays are traced; hardware: by ray queries of the GPU; software: by shaders; auto: hardware, except on "
            "CPUs",
            "Pictures differ by rounding only."),
    setting("effects.per_sample", BooleanSetting{at<&E::perSample>}, "Rays at every sample",
            "traces shadows and curved mirrors at every sample, not once a pixel", "Rays grow with samples.",
            {.cheaper = lower,
             .error = [](const Settings& s, size_t) { return s.effects.perSample ? 0.0 : 0.01; },
             .swept = {"true"}}),
    setting("effects.ripple", BooleanSetting{at<&E::ripple>}, "Ripples", "ripples of mirrors", "Traces rays there."),
    setting("effects.ripple_lookup", choice<&E::rippleLookup>(reflectionSources), "Ripple lookup",
            "how rippled mirrors are drawn; traced: by rays; image: from their image as if smooth",
            "image takes a fraction of the time.",
            {.cheaper = higher,
             .error = [](const Settings& s,
                         size_t) { return s.effects.rippleLookup == ReflectionSource::traced ? 0.0 : 0.03; },
             .swept = {"image"}}),
    setting("effects.casts_light", BooleanSetting{at<&E::castsLight>}, "Bounced light", "light bounced off mirrors",
            "Traces rays near them.",
            {.cheaper = lower, .error = [](const Settings& s, size_t) { return s.effects.castsLight ? 0.0 : 0.08; }}),
    setting("effects.curved", BooleanSetting{at<&E::curved>}, "Curved mirrors", "objects that are mirrors",
            "Traces rays there."),
    setting("effects.curved_lookup", choice<&E::curvedLookup>(curvedLookups), "Curved lookup",
            "how curved mirrors are drawn; traced: by rays; environment: from environment maps",
            "environment renders only what changed.",
            {.cheaper = higher,
             .error = [](const Settings& s,
                         size_t) { return s.effects.curvedLookup == CurvedLookup::traced ? 0.0 : 0.045; },
             .swept = {"environment"}}),
    setting("effects.environment_size", IntegerSetting{at<&E::environmentSize>, 16, 1024, true}, "Map size",
            "side of an environment map's images", "Time and memory grow with its square.",
            {.unit = "texels", .needs = environmentMaps, .cheaper = lower, .swept = {"64 256"}}),
    setting(
        "effects.environment_interval", IntegerSetting{at<&E::environmentInterval>, 1, anyCount}, "Map interval",
        "environment maps are rendered at most every n-th frame", "What moves in them moves in steps.",
        {.unit = "frames", .slider = SettingSlider{1, 60, "%d", false}, .needs = environmentMaps, .cheaper = higher}),
    setting("effects.environment_box", BooleanSetting{at<&E::environmentBox>}, "Box around the map",
            "takes the surroundings of an environment map for a box",
            "Costs nothing; without it the surroundings seem infinitely far.", {.needs = environmentMaps}),
    setting("effects.fresnel", BooleanSetting{at<&E::fresnel>}, "Fresnel",
            "mirrors that reflect more at grazing angles", "Costs next to nothing."),
    setting("effects.textures", BooleanSetting{at<&E::textures>}, "Textures", "textures of objects and maps of mirrors",
            "Takes memory for all while one is in view."),
    setting("effects.transparency", BooleanSetting{at<&E::transparency>}, "Transparency",
            "cut-outs and other materials that are not opaque", "Such objects hide nothing."),
    setting("effects.glyphs", BooleanSetting{at<&E::glyphs>}, "Glowing lights", "spheres of lights that glow",
            "One draw a pass."),

    setting("quality.budget_ms", NumberSetting{at<&Q::budgetMs>, 0.0, 1e6}, "GPU budget (ms)",
            "chooses the most accurate measured settings up to this GPU time; 0: off", "Costs nothing.",
            {.changes = none}),
    setting("quality.max_error", NumberSetting{at<&Q::maxError>, 0.0, 1.0}, "Max. mean FLIP",
            "chooses the fastest measured settings up to this mean FLIP, the perceived error; 0: off", "Costs nothing.",
            {.changes = none}),
    setting("quality.motion_ms", AutomaticSetting{at<&Q::motionMs>, 0.0, 1e6}, "Full quality while moving",
            "time of moving frames, for which settings are lowered; auto: 50 ms on CPUs, elsewhere 0.8 of a refresh; 0 "
            "(ticked in the panel): nothing is lowered",
            "At 0 movement may stutter.", {.unit = "ms", .changes = none}),
    setting("quality.still_pictures", IntegerSetting{at<&Q::stillPictures>, 1, 1024}, "Averaged when still",
            "pictures whose mean the window shows when nothing moves", "As many are drawn after each movement.",
            {.changes = none, .slider = SettingSlider{1, 1024, "%d"}}),
    setting("quality.still_error", NumberSetting{at<&Q::stillError>, 0.0, 16.0}, "Stops at (steps)",
            "view.accumulate_error of that mean, unless that setting is larger; 0: off",
            "Saves time where a picture is smooth.", {.unit = "steps", .changes = none}),

    setting("debug.omit_barrier", TextSetting{at<&D::omitBarrier>, "name of a barrier"}, "Omit barrier",
            "omits a barrier; validation must notice", "The picture may be wrong.", {.changes = mainView}),
    setting("debug.check_finite", BooleanSetting{at<&D::checkFinite>}, "Check that radiance is finite",
            "finds radiance that is NaN, infinite or negative", "Reads every sample once more.", {.changes = mainView}),
    setting("debug.skip_hidden", BooleanSetting{at<&D::skipHidden>}, "Skip hidden mirrors",
            "hidden mirrors have no pass", "Saves passes.", {.changes = mainView}),
    setting("debug.cull_clusters", BooleanSetting{at<&D::cullClusters>}, "Cull clusters",
            "clusters outside a view and backs of solids are not drawn",
            "Saves vertices and shading; costs draw calls.", {.changes = mainView}),
    setting("debug.skip_lights", BooleanSetting{at<&D::skipLights>}, "Skip lights below surfaces",
            "surfaces pass over groups of lights that lie below their plane", "Saves shading.", {.changes = mainView}),
    setting("debug.mask_passes", BooleanSetting{at<&D::maskPasses>}, "Mask passes",
            "only visible regions of mirror images are shaded", "Saves shading.", {.changes = mainView}),
    setting("debug.encode_early", BooleanSetting{at<&D::encodeEarly>}, "Encode early",
            "the main view is drawn into the display image at once if it has its size, one sample a pixel and no other "
            "reader",
            "Saves the display pass.", {.changes = mainView}),

    setting("ui.scale", NumberSetting{at<&U::scale>, 0.5, 4.0}, "Size of panels",
            "size of the window's panels and texts, times Window > Text size and the monitor's scale", "Costs nothing.",
            {.changes = none}),
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
static_assert(describes<U>("ui."), "describe every member of UiSettings above");
static_assert(memberCount<Settings>() == 7, "name the group of settings above; all but `limit` are settings");

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
      return (n.automatic ? "auto " : "") +
             (n.powersOfTwo ? Range{.low = 1.0 * n.low, .high = 1.0 * n.high, .powersOfTwo = true}.shortText()
                            : std::to_string(n.low) + " .. " + std::to_string(n.high));
    }
    std::string operator()(const BooleanSetting&) const { return "true | false"; }
    std::string operator()(const ChoiceSetting& choice) const {
      std::string names(choice.names.front());
      for (const std::string_view name : choice.names.subspan(1)) {
        names.append(" | ").append(name);
      }
      return names;
    }
    std::string operator()(const ColorSetting&) const { return "r,g,b (linear, " + radianceRange.shortText() + ")"; }
    std::string operator()(const TextSetting& text) const { return std::string(text.meaning); }
  };
  return std::visit(Visitor(), field.kind);
}

std::string settingRangeWithUnit(const SettingField& field) {
  return (field.unit.empty() ? "" : std::string(field.unit) + ", ") + settingRange(field);
}

bool sameSetting(const SettingField& field, const Settings& a, const Settings& b) {
  return std::visit([&](const auto& kind) { return kind.get(a) == kind.get(b); }, field.kind);
}

bool isCheaper(const SettingField& field, const Settings& a, const Settings& b) {
  const Settings& low = field.cheaper == lower ? a : b;
  const Settings& high = field.cheaper == lower ? b : a;
  const auto less = [&](const auto& kind) {
    if constexpr (requires { kind.automatic; }) {
      const auto size = [&](const Settings& settings) {
        const int value = kind.get(settings);
        return kind.automatic && value == 0 ? kind.get(Settings()) : value;
      };
      return size(low) < size(high);
    } else if constexpr (requires { bool(kind.get(low) < kind.get(high)); }) {
      return kind.get(low) < kind.get(high);
    }
    return false;
  };
  return field.cheaper != neither && std::visit(less, field.kind);
}

void copySetting(const SettingField& field, const Settings& from, Settings& to) {
  std::visit([&](const auto& kind) { kind.set(to, kind.get(from)); }, field.kind);
}

std::string settingHelp(std::string_view key, const std::string& range) {
  const SettingField* field = findSettingField(key);
  if (!field) {
    return "";
  }
  std::string text = std::string(field->text) + ". " + std::string(field->cost);
  text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text + "\n" + std::string(key) + ": " + (range.empty() ? settingRangeWithUnit(*field) : range);
}

}  // namespace speculum
