#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "geometry/mesh.hpp"

namespace speculum {

// The types below hold the content of a scene file with defaults applied, before any time is chosen. Metres, degrees,
// linear RGB, world space right-handed with +Y up, as in docs/scene_format.md.

struct Sky {
  glm::dvec3 zenith, horizon, ground;

  bool operator==(const Sky&) const = default;
};

struct Environment {
  glm::dvec3 background{0.0};
  std::optional<Sky> sky;
  glm::dvec3 ambient{0.0};

  // Returns the radiance of a ray of unit direction `d` (world) that hits nothing.
  glm::dvec3 radiance(const glm::dvec3& d) const;
  // Returns a copy with `color`, if it has a value, in the place of background and sky.
  Environment cleared(const std::optional<glm::dvec3>& color) const;

  bool operator==(const Environment&) const = default;
};

struct CameraSpec {
  glm::dvec3 position{0.0};
  glm::dvec3 target{0.0};
  glm::dvec3 up{0.0, 1.0, 0.0};
  double verticalFov = 60.0;  // degrees
  double near = 0.001;        // metres; depth precision only
  double orbitSpeed = 0.0;    // degrees per second about `up` around `target`

  bool operator==(const CameraSpec&) const = default;
};

struct Copies {
  int count = 1;
  glm::dvec3 step{0.0};

  bool operator==(const Copies&) const = default;
};

// Where an object or a light's glyph is seen: everywhere, only directly, or only in mirrors. Objects cast shadows
// wherever they are seen.
enum class Visibility { everywhere, eye, mirrors };

// What a view or a ray is for: the eye, the reflection of a mirror, flat or curved, or the shadows of a light.
enum class Onlooker { eye, mirror, light };

// Says whether the onlooker sees what has this visibility.
constexpr bool sees(Onlooker onlooker, Visibility visibility) {
  return (onlooker != Onlooker::eye || visibility != Visibility::mirrors) &&
         (onlooker != Onlooker::mirror || visibility != Visibility::eye);
}

enum class Fresnel { none, schlick };

// Properties of an object that is a curved mirror.
struct ObjectMirror {
  glm::dvec3 reflectance{0.95};
  Fresnel fresnel = Fresnel::none;
  glm::dvec3 baseColor{0.0};

  bool operator==(const ObjectMirror&) const = default;
};

// The axis of a model that points up.
enum class UpAxis { y, z };

struct Object {
  std::string name;
  std::string model;  // path as it stands in the scene file
  int mesh = -1;      // index into Scene::meshes
  glm::dvec3 position{0.0};
  glm::dvec3 rotation{0.0};  // degrees: pitch, yaw, roll; R = Ry Rx Rz
  glm::dvec3 scale{1.0};
  UpAxis up = UpAxis::y;  // z: the model is turned by -90 degrees about X before all else
  glm::dvec3 spin{0.0};   // degrees per second added to rotation
  std::optional<glm::dvec3> color;
  std::optional<glm::dvec3> specular;
  std::optional<double> shininess;
  std::optional<glm::dvec3> emission;
  Visibility visible = Visibility::everywhere;
  Copies copies;
  std::optional<ObjectMirror> mirror;
  bool mirrorsFromMaterials = true;

  bool operator==(const Object&) const = default;
};

struct Orbit {
  glm::dvec3 center{0.0};
  glm::dvec3 axis{0.0, 1.0, 0.0};
  double speed = 0.0;  // degrees per second, right-hand rule

  bool operator==(const Orbit&) const = default;
};

struct PointLight {
  std::string name;
  glm::dvec3 position{0.0};
  glm::dvec3 color{1.0};
  double intensity = 1.0;  // irradiance at 1 m on a surface that faces the light
  double radius = 0.05;    // metres, of the glyph; also the floor of the inverse square law
  double glow = 1.0;       // radiance of the glyph by `color`; 0: no glyph
  bool castsShadow = false;
  Visibility visible = Visibility::everywhere;  // of the glyph
  std::optional<Orbit> orbit;

  bool operator==(const PointLight&) const = default;
};

// The content of a model file, in model space.
struct Model {
  Mesh mesh;
  std::optional<CameraSpec> camera;
  std::vector<PointLight> lights;
};

struct Ripple {
  double amplitude = 0.0;   // metres
  double wavelength = 0.5;  // metres
  double speed = 0.2;       // of the waves, metres per second

  bool operator==(const Ripple&) const = default;
};

// How a planar mirror's reflection is drawn. raster: a pass renders an image. rays: rays are traced. automatic:
// whichever is likely to be faster.
enum class ReflectionMethod { automatic, raster, rays };

// Quality of a mirror's images. A member without a value follows the setting reflection.*.
struct MirrorQuality {
  std::optional<double> scale;  // resolution relative to the main view
  std::optional<int> samples;
  std::optional<int> updateInterval;  // frames
  std::optional<ReflectionMethod> method;

  bool operator==(const MirrorQuality&) const = default;
};

struct Mirror {
  std::string name;
  glm::dvec3 position{0.0};
  glm::dvec3 rotation{0.0};
  glm::dvec3 spin{0.0};
  glm::dvec2 size{0.0};
  std::vector<glm::dvec3> polygon;  // world; empty when position, rotation, size are used
  glm::dvec3 reflectance{0.95};
  Fresnel fresnel = Fresnel::none;
  std::string reflectanceMap;  // path as it stands in the scene file; empty: none
  int map = -1;                // its index into Scene::textures
  glm::dvec3 baseColor{0.0};
  double roughness = 0.0;
  std::optional<Ripple> ripple;
  bool twoSided = false;
  glm::dvec3 backColor{0.1};
  bool castsLight = false;
  MirrorQuality quality;

  bool operator==(const Mirror&) const = default;
};

// How a mirror reflects: the properties that images, rays and the reference tracer read.
struct MirrorOptics {
  glm::dvec3 reflectance{0.0};
  Fresnel fresnel = Fresnel::none;
  glm::dvec3 baseColor{0.0};
  glm::dvec3 backColor{0.0};
  bool twoSided = false;
  double alpha = 0.0;  // width of the GGX distribution of microfacet normals; 0: smooth
  std::optional<Ripple> ripple;
  int map = -1;  // index into Scene::textures of the picture that multiplies the reflectance; -1: none

  // Returns the reflectance, without the map, for `cosine`, the cosine of the angle between normal and viewer: the same
  // at every angle or, with Fresnel, by Schlick, "An Inexpensive BRDF Model for Physically-based Rendering" (1994).
  glm::dvec3 reflectanceAt(double cosine) const;
};
MirrorOptics opticsOf(const Mirror& mirror);
MirrorOptics opticsOf(const ObjectMirror& mirror);

// A view that the user can return to.
struct Bookmark {
  std::string name;  // not empty, and unique
  glm::dvec3 position{0.0};
  glm::dvec3 target{0.0};
  std::optional<glm::dvec3> up;       // the camera's unless given
  std::optional<double> verticalFov;  // degrees; the camera's unless given

  bool operator==(const Bookmark&) const = default;
};

// One entry of the scene's [settings] table, not interpreted: settings/setting_fields.hpp describes the keys.
struct SettingEntry {
  std::string key;
  std::string value;  // as --set takes it
  int line = 0;
  bool quoted = false;  // the value is a string in the file
};

// The part of a scene that can be edited.
struct SceneContent {
  // Index of each node in the file that the scene was loaded from, -1 if it was added since. Loaded nodes come first,
  // in their order. Empty until a SceneDocument edits the scene.
  struct Origins {
    std::vector<int> objects, lights, mirrors, bookmarks;

    bool operator==(const Origins&) const = default;
  };

  Environment environment;
  CameraSpec camera;
  std::vector<Object> objects;
  std::vector<PointLight> lights;
  std::vector<Mirror> mirrors;
  std::vector<Bookmark> bookmarks;
  Origins origins;

  bool operator==(const SceneContent&) const = default;
};

// A planar mirror that a model's material makes, one for each copy of its object.
struct MaterialMirror {
  Mirror mirror;  // without a place, which follows from the object
  int object = 0;
  int copy = 0;
  int flat = 0;  // index into MirrorParts::flat of the object's mesh

  bool operator==(const MaterialMirror&) const = default;
};

struct Scene : SceneContent {
  std::filesystem::path file;
  std::string text;  // content of the file, as it was read
  std::string title;
  std::vector<SettingEntry> settings;
  std::vector<Mesh> meshes;       // each model file once, and meshes that MirrorParts names
  std::vector<Texture> textures;  // each picture file once
  // The planar mirrors that objects' materials make; see placeMaterialMirrors().
  std::vector<MaterialMirror> materialMirrors;

  // Mirrors by the index that SceneState and plans use: those of the file, then those that materials make.
  size_t mirrorCount() const { return mirrors.size() + materialMirrors.size(); }
  const Mirror& mirror(size_t index) const {
    return index < mirrors.size() ? mirrors[index] : materialMirrors[index - mirrors.size()].mirror;
  }
};

}  // namespace speculum
