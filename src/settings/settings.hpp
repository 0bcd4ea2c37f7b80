#pragma once

#include <glm/glm.hpp>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "image/image.hpp"
#include "scene/scene.hpp"
#include "scene/value_range.hpp"

namespace speculum {

enum class ClipMethod { clipDistance, oblique, none };
enum class TextureFilter { bilinear, trilinear, nearest, anisotropic };

struct ReflectionSettings {
  ReflectionMethod method = ReflectionMethod::raster;
  double scale = 1.0;  // resolution of mirror images relative to the main view
  int samples = 4;
  int maxDepth = 4;
  double minPixels = 1.0;
  double minThroughput = 0.0005;
  int maxPasses = 64;
  int updateInterval = 1;     // frames
  bool skipUnchanged = true;  // reuses cached images that would come out the same
  ClipMethod clip = ClipMethod::clipDistance;

  bool operator==(const ReflectionSettings&) const = default;
};

struct ViewSettings {
  double scale = 1.0;  // resolution of the main view relative to the picture; mirror images follow it
  int samples = 4;
  int accumulate = 1;  // pictures whose mean is shown
  // Estimated error, in steps of 8 bits, below which parts of the mean are not drawn again; 0: all are.
  double accumulateError = 0.0;
  double exposure = 1.0;
  ToneMap toneMap = ToneMap::clamp;
  std::optional<glm::dvec3> clearColor;  // linear; replaces background and sky of the scene
  TextureFilter textureFilter = TextureFilter::bilinear;
  bool wireframe = false;
  double lineWidth = 1.0;   // of wireframe, pixels of the picture
  bool continuous = false;  // the window draws all the time

  DisplayCurve displayCurve() const { return {exposure, toneMap}; }
  // Factor on radiance in targets of 16 bits, a power of two: 1 unless the exposure is beyond 1/4096 to 4096.
  double radianceScale() const;
  bool operator==(const ViewSettings&) const = default;
};

// Source of the reflection of a rough or rippled mirror: traced rays, or the mirror's image, rendered as if the mirror
// were smooth.
enum class ReflectionSource { traced, image };

// Source of a curved mirror's reflection: traced rays, or an environment map.
enum class CurvedLookup { traced, environment };

// Source of the shadows of lights: traced rays, shadow maps, or maps with rays where a map does not decide (hybrid).
// automatic: traced or hybrid, whichever should be faster.
enum class ShadowLookup { automatic, traced, hybrid, map };

// What traces rays. automatic: as hardware, but shaders on CPU drivers; hardware: ray queries if the device has them,
// else shaders; software: shaders.
enum class RayMethod { automatic, hardware, software };

// Effects are drawn where the scene calls for them, unless they are switched off here.
struct EffectSettings {
  bool shadows = true;
  bool roughness = true;
  bool ripple = true;
  bool castsLight = true;
  bool curved = true;
  bool fresnel = true;
  bool textures = true;
  bool transparency = true;
  bool glyphs = true;
  ShadowLookup shadowLookup = ShadowLookup::traced;
  int shadowMapSize = 1024;  // texels of each side of a shadow map's faces; 0: as large as views ask for
  int roughSamples = 16;     // rays a pixel of rough mirrors
  ReflectionSource roughLookup = ReflectionSource::traced;
  ReflectionSource rippleLookup = ReflectionSource::traced;
  RayMethod rays = RayMethod::automatic;
  bool perSample = false;  // traces rays at each sample of a pixel, not once a pixel
  CurvedLookup curvedLookup = CurvedLookup::traced;
  int environmentSize = 256;    // texels of each side of an environment map's faces
  int environmentInterval = 1;  // frames
  bool environmentBox = true;   // corrects lookups as if the surroundings of the object were a box

  bool operator==(const EffectSettings&) const = default;
};

// Return how a mirror reflects, without the effects that the settings switch off: Fresnel, roughness and ripples.
MirrorOptics opticsOf(const Mirror& mirror, const EffectSettings& effects);
MirrorOptics opticsOf(const ObjectMirror& mirror, const EffectSettings& effects);
// Returns the rays that a pixel of a rough mirror sends: effects.rough_samples, rounded up to the same number at each
// of the pixel's samples, as shaders/shade.glsl does.
int roughRays(const EffectSettings& effects, int samples);
// Say whether a surface with the material, or some surface of the mesh, is drawn with coverage under these settings.
bool isTransparent(const Material& material, const EffectSettings& effects);
bool isTransparent(const Mesh& mesh, const EffectSettings& effects);
// Says whether the glyph of a light, its visible sphere, is drawn under these settings.
bool hasGlyph(const PointLight& light, const EffectSettings& effects);

// Bounds for the choice among measured settings (accuracy/pareto.hpp), and the window's pace (docs/window.md). The
// frame plan does not read them.
struct QualitySettings {
  double budgetMs = 0.0;           // GPU milliseconds a frame; 0: no bound
  double maxError = 0.0;           // mean FLIP; 0: no bound
  std::optional<double> motionMs;  // milliseconds a frame while anything moves; 0: no bound, empty: by the device
  int stillPictures = 64;          // pictures whose mean the window shows while the scene is still
  double stillError = 0.25;        // view.accumulate_error of that mean, unless that setting is larger

  bool operator==(const QualitySettings&) const = default;
};

struct DebugSettings {
  std::string omitBarrier;   // name of a barrier that is not recorded, so that validation must notice
  bool checkFinite = false;  // searches every target of radiance for values that are negative or not finite
  bool skipHidden = true;    // mirrors hidden by occluders have no pass
  bool cullClusters = true;  // draws only what a view may see of an object: clusters in it, and fronts of solids
  bool skipLights = true;    // passes over groups of lights that lie below a surface
  bool maskPasses = true;    // shades only the texels of a mirror image that are looked up
  bool encodeEarly = true;   // draws the main view into the display image if nothing else reads it

  bool operator==(const DebugSettings&) const = default;
};

struct UiSettings {
  double scale = 1.0;  // of panels and texts, beside the monitor's scale and Window > Text size

  bool operator==(const UiSettings&) const = default;
};

// Bounds the quality that mirrors ask for themselves (MirrorQuality). Code that lowers reflection.* lowers the limit
// too.
struct QualityLimit {
  double scale = imageScaleRange.high;
  int samples = static_cast<int>(samplesRange.high);
  int leastInterval = 1;  // frames
  int mostInterval = static_cast<int>(intervalRange.high);
  bool rays = true;
  ReflectionMethod automatic = ReflectionMethod::automatic;  // the method that `automatic` stands for on the device

  bool operator==(const QualityLimit&) const = default;
};

struct Settings {
  ReflectionSettings reflection;
  ViewSettings view;
  EffectSettings effects;
  QualitySettings quality;
  DebugSettings debug;
  UiSettings ui;
  QualityLimit limit;  // not a setting: users do not see the limit

  bool operator==(const Settings&) const = default;
};

// Returns `settings.reflection` with the mirror's own quality in its place, as far as `settings.limit` allows.
ReflectionSettings reflectionOf(const MirrorQuality& own, const Settings& settings);
// Returns `settings.reflection` with the largest scale, sample count and interval of all mirrors.
ReflectionSettings mostAsked(const Scene& scene, const Settings& settings);
// Lowers the limit to each value of `settings.reflection` that was lowered since `before`.
void lowerLimit(const ReflectionSettings& before, Settings& settings);

// Sets one key of settingFields(). The value is text as on a command line: numbers, true/false, names, colors as
// "r,g,b" or "[r, g, b]". Returns nothing or, if the key or value is bad, what is wrong and what would be right.
std::optional<std::string> setSetting(Settings& settings, std::string_view key, std::string_view value);
// Returns the value as setSetting() takes it; empty for an unknown key or a color that is not set.
std::string settingValue(const Settings& settings, std::string_view key);
// Returns "key=value" of every key, a line each. The text is equal for equal settings.
std::string settingsKey(const Settings& settings);

// A setting as `--set key=value` takes it. The value is empty for a color that is not set.
struct SettingChange {
  std::string key;
  std::string value;
  bool operator==(const SettingChange&) const = default;
};
// Returns the settings of `to` that differ from `from`, in the order of settingFields().
std::vector<SettingChange> settingChanges(const Settings& from, const Settings& to);

// Returns the defaults overlaid with the scene's [settings]. Throws InputError with FILE:LINE.
Settings settingsOf(const Scene& scene);

// Say whether all settings are equal that change mirror images, or that change mirror images or the main view
// (SettingField::changes).
bool sameMirrorImages(const Settings& a, const Settings& b);
bool sameMainView(const Settings& a, const Settings& b);

// Returns every key with its value, as numbers, booleans and strings.
nlohmann::ordered_json settingsJson(const Settings& settings);

}  // namespace speculum
