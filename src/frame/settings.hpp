#pragma once

#include <glm/glm.hpp>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "image/color.hpp"
#include "scene/scene.hpp"

namespace speculum {

enum class ClipMethod { clipDistance, oblique, none };
enum class TextureFilter { bilinear, trilinear };

struct ReflectionSettings {
  double scale = 1.0;  // resolution of mirror images relative to the screen
  int samples = 4;
  int maxDepth = 4;
  double minPixels = 1.0;
  double minThroughput = 0.0005;
  int maxPasses = 64;
  int updateInterval = 1;     // frames
  bool skipUnchanged = true;  // an image that would be the same again is not rendered
  double meshError = 0.0;     // texels that the outlines of objects in mirror images may be off by; 0: none
  ClipMethod clip = ClipMethod::clipDistance;

  bool operator==(const ReflectionSettings&) const = default;
};

struct ViewSettings {
  int samples = 4;
  double exposure = 1.0;
  ToneMap toneMap = ToneMap::clamp;
  std::optional<glm::dvec3> clearColor;  // linear; replaces background and sky of the scene
  TextureFilter textureFilter = TextureFilter::bilinear;
  bool wireframe = false;
  bool continuous = false;  // the window draws what does not change as well

  bool operator==(const ViewSettings&) const = default;
};

// What a rough mirror looks up: rays, or the image of the mirror as if it were smooth.
enum class RoughLookup { traced, image };

// What a curved mirror reflects: what rays meet, or six images about its centre.
enum class CurvedLookup { traced, environment };

// Effects are drawn where the scene calls for them, unless they are switched off here.
struct EffectSettings {
  bool shadows = true;
  bool roughness = true;
  bool ripple = true;
  bool castsLight = true;
  bool curved = true;
  bool fresnel = true;
  bool textures = true;
  bool glyphs = true;
  int roughSamples = 16;  // rays a pixel of rough mirrors
  RoughLookup roughLookup = RoughLookup::traced;
  bool perSample = false;  // rays at each sample of a pixel, not once
  CurvedLookup curvedLookup = CurvedLookup::traced;
  int environmentSize = 256;    // texels of each side of an environment map's faces
  int environmentInterval = 1;  // frames
  bool environmentBox = true;   // look-ups are corrected as if what surrounds the object were a box

  bool operator==(const EffectSettings&) const = default;
};

// What a mirror or a light of the scene asks for, as far as it is not switched off.
bool isSchlick(Fresnel fresnel, const EffectSettings& effects);
bool hasGlyph(const PointLight& light, const EffectSettings& effects);

// Bounds that a measured sweep is asked to keep; see accuracy/pareto.hpp. Nothing in the frame plan reads them.
struct QualitySettings {
  double budgetMs = 0.0;  // GPU milliseconds a frame; 0: no bound
  double maxError = 0.0;  // mean FLIP; 0: no bound
};

struct DebugSettings {
  std::string omitBarrier;   // name of a barrier that is not recorded, to show that validation notices; empty: none
  bool checkFinite = false;  // every render target of radiance is searched for values that are not finite or negative
  bool skipHidden = true;    // a mirror that others or objects hide has no pass
  bool cullClusters = true;  // of objects seen in part only what a view may see is drawn
  bool maskPasses = true;    // what no one looks up of a mirror's image is not shaded

  bool operator==(const DebugSettings&) const = default;
};

struct Settings {
  ReflectionSettings reflection;
  ViewSettings view;
  EffectSettings effects;
  QualitySettings quality;
  DebugSettings debug;
};

// Sets one key of settingFields(). The value is text as on a command line: numbers, true/false, names, colours as
// "r,g,b" or "[r, g, b]". Returns what is wrong and what would be right, or nothing.
std::optional<std::string> setSetting(Settings& settings, std::string_view key, std::string_view value);
std::string settingValue(const Settings& settings, std::string_view key);
// "key=value" of every key, a line each: equal for equal settings.
std::string settingsKey(const Settings& settings);

// Defaults, then the scene's [settings]. Throws InputError with FILE:LINE.
Settings settingsOf(const Scene& scene);

// Whether mirror images, or the main view, rendered under one of them could have been rendered under the other: all
// settings that change them (SettingField::changes) are equal.
bool sameMirrorImages(const Settings& a, const Settings& b);
bool sameMainView(const Settings& a, const Settings& b);

// Every key with its value, as numbers, booleans and strings.
nlohmann::ordered_json settingsJson(const Settings& settings);

// The environment with view.clear_color applied.
Environment effectiveEnvironment(const Scene& scene, const Settings& settings);

}  // namespace speculum
