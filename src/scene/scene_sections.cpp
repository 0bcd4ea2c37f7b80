#include "scene/scene_sections.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>

#include "geometry/polygon.hpp"
#include "scene/scene_state.hpp"

namespace speculum {

namespace {

using Key = std::string_view;

// Shorter vectors could be told from zero, but squares of products with them are no doubles any more.
constexpr double kShortest = 1e-30;

bool hasDirection(const glm::dvec3& v) {
  return glm::length(v) >= kShortest;
}

constexpr Range kFieldOfView{.low = 1.0, .high = 170.0};  // degrees

// Checking a polygon takes time in the square of this.
constexpr size_t kMostVertices = 1000;

Fresnel readFresnel(const TableReader& table) {
  static constexpr std::array<Key, 2> kFresnel{"none", "schlick"};
  return table.choice("fresnel", 0, kFresnel) == 1 ? Fresnel::schlick : Fresnel::none;
}

std::optional<ObjectMirror> readObjectMirror(const TableReader& object) {
  static constexpr std::array<Key, 3> kKeys{"reflectance", "fresnel", "base_color"};
  const std::optional<TableReader> table = object.subtable("mirror", kKeys);
  if (!table) {
    return std::nullopt;
  }
  ObjectMirror mirror;
  mirror.reflectance = table->vec3("reflectance", mirror.reflectance, kUnit);
  mirror.fresnel = readFresnel(*table);
  mirror.baseColor = table->vec3("base_color", mirror.baseColor, kNotNegative);
  return mirror;
}

Copies readCopies(const TableReader& object) {
  static constexpr std::array<Key, 2> kKeys{"count", "step"};
  Copies copies;
  if (const std::optional<TableReader> table = object.subtable("copies", kKeys)) {
    copies.count = static_cast<int>(table->integer("count", copies.count, 1, 1'000'000));
    copies.step = table->vec3("step", copies.step, kCoordinate);
  }
  return copies;
}

std::optional<Orbit> readOrbit(const TableReader& light) {
  static constexpr std::array<Key, 3> kKeys{"center", "axis", "speed"};
  const std::optional<TableReader> table = light.subtable("orbit", kKeys);
  if (!table) {
    return std::nullopt;
  }
  Orbit orbit;
  orbit.center = table->vec3("center", orbit.center, kCoordinate);
  orbit.axis = table->vec3("axis", orbit.axis, kCoordinate);
  orbit.speed = table->number("speed", orbit.speed, kTurn);
  if (!hasDirection(orbit.axis)) {
    table->fail("axis", "has no direction", "a vector that is not zero, such as [0, 1, 0], is needed");
  }
  return orbit;
}

std::optional<Ripple> readRipple(const TableReader& mirror) {
  static constexpr std::array<Key, 3> kKeys{"amplitude", "wavelength", "speed"};
  const std::optional<TableReader> table = mirror.subtable("ripple", kKeys);
  if (!table) {
    return std::nullopt;
  }
  Ripple ripple;
  ripple.amplitude = table->number("amplitude", ripple.amplitude, kNotNegative);
  ripple.wavelength = table->number("wavelength", ripple.wavelength, kPositive);
  ripple.speed = table->number("speed", ripple.speed);
  return ripple.amplitude > 0.0 ? std::optional(ripple) : std::nullopt;
}

std::optional<std::string> shapeDefect(std::span<const glm::dvec3> polygon) {
  const std::optional<std::string> defect = polygonDefect(polygon);
  if (!defect && !(glm::length(newellVector(polygon)) >= kShortest * kShortest)) {
    return "has no area that can be computed with";
  }
  return defect;
}

constexpr Key kGoodShape = "a planar, convex polygon with an area of at least 1e-8 of its squared diameter is needed";

std::string vertexCountText(size_t count) {
  return "has " + std::to_string(count) + " vertices";
}

constexpr Key kGoodCount = "3 .. 1000 are needed";

void checkShape(const TableReader& table, Key key, std::span<const glm::dvec3> polygon) {
  if (const std::optional<std::string> defect = shapeDefect(polygon)) {
    table.fail(key, *defect, kGoodShape);
  }
}

// Vertices are rounded to 2^-53 of their distance from the origin: little must be left of that in the mirror.
void checkSizeAtPosition(const TableReader& table, const Mirror& mirror) {
  if (std::min(mirror.size.x, mirror.size.y) < 1e-10 * glm::length(mirror.position)) {
    table.fail("position", "is too far from the origin for the mirror's size",
               "at most 1e10 times its width and height are needed");
  }
}

void readShape(const TableReader& table, Mirror& mirror) {
  if (table.has("polygon")) {
    for (const Key other : {"size", "position", "rotation", "spin"}) {
      if (table.has(other)) {
        table.fail(other, "does not go with polygon", "give either polygon or position, rotation, spin and size");
      }
    }
    mirror.polygon = table.points("polygon");
    if (mirror.polygon.size() > kMostVertices) {
      table.fail("polygon", vertexCountText(mirror.polygon.size()), kGoodCount);
    }
    checkShape(table, "polygon", mirror.polygon);
    return;
  }
  if (!table.has("size")) {
    table.fail("size", "is missing", "size = [width, height] or polygon = [[x, y, z], ...] is needed");
  }
  mirror.size = table.vec2("size", kLength);
  const glm::dvec2 half = 0.5 * mirror.size;
  const std::array<glm::dvec3, 4> corners{glm::dvec3(-half, 0.0), glm::dvec3(half.x, -half.y, 0.0),
                                          glm::dvec3(half, 0.0), glm::dvec3(-half.x, half.y, 0.0)};
  checkShape(table, "size", corners);
  mirror.position = table.vec3("position", mirror.position, kCoordinate);
  mirror.rotation = table.vec3("rotation", mirror.rotation, kCoordinate);
  mirror.spin = table.vec3("spin", mirror.spin, kTurn);
  checkSizeAtPosition(table, mirror);
}

void checkDirections(const TableReader& table, const CameraSpec& camera) {
  if (!hasDirection(camera.target - camera.position)) {
    table.fail("target", "has no direction from position", "a point away from position is needed");
  }
  if (!hasDirection(camera.up)) {
    table.fail("up", "has no direction", "a vector that is not zero, such as [0, 1, 0], is needed");
  }
  try {
    lookAt(camera.position, camera.target, camera.up, camera.verticalFov, camera.near);
  } catch (const std::invalid_argument&) {
    table.fail(table.has("up") ? "up" : "target", "the view direction is parallel to up",
               "up and target - position must not be parallel");
  }
}

SettingEntry readSetting(const TableReader& settings, const toml::node& node, const std::string& key, int line) {
  const Key wanted = "a boolean, number, string or array of numbers is needed";
  SettingEntry entry{.key = key, .value = false, .line = line};
  if (node.is_boolean()) {
    entry.value = node.as_boolean()->get();
  } else if (node.is_integer()) {
    entry.value = node.as_integer()->get();
  } else if (node.is_string()) {
    entry.value = node.as_string()->get();
  } else if (node.is_floating_point() && std::isfinite(node.as_floating_point()->get())) {
    entry.value = node.as_floating_point()->get();
  } else if (node.is_floating_point()) {
    settings.failAt(node, key, "is not finite", wanted);
  } else if (const toml::array* array = node.as_array()) {
    std::vector<double> values;
    for (const toml::node& element : *array) {
      const std::optional<double> value = element.is_number() ? element.value<double>() : std::nullopt;
      if (!value || !std::isfinite(*value)) {
        settings.failAt(element, key, "has an element that is not a finite number", wanted);
      }
      values.push_back(*value);
    }
    entry.value = std::move(values);
  } else {
    settings.failAt(node, key, "is " + std::string(typeName(node)), wanted);
  }
  return entry;
}

// `depth` tables stand around the table within [settings].
void flatten(const TableReader& settings, const toml::table& table, const std::string& prefix, int tableLine, int depth,
             std::map<std::string, SettingEntry>& entries) {
  constexpr int kDeepest = 7;
  for (const auto& [key, node] : table) {
    const std::string full = prefix + std::string(key.str());
    const int line = key.source().begin.line > 0 ? static_cast<int>(key.source().begin.line) : tableLine;
    if (node.is_table() && depth == kDeepest) {
      settings.failAt(node, full, "has too many parts", "no setting has more than 2");
    }
    if (node.is_table()) {
      flatten(settings, *node.as_table(), full + ".", line, depth + 1, entries);
      continue;
    }
    if (entries.contains(full)) {
      settings.failAt(node, full, "is set twice", "set it once, either quoted or nested");
    }
    entries.emplace(full, readSetting(settings, node, full, line));
  }
}

}  // namespace

Environment readEnvironment(const TableReader& file) {
  static constexpr std::array<Key, 3> kKeys{"background", "sky", "ambient"};
  static constexpr std::array<Key, 3> kSkyKeys{"zenith", "horizon", "ground"};
  Environment environment;
  const std::optional<TableReader> table = file.subtable("environment", kKeys);
  if (!table) {
    return environment;
  }
  environment.background = table->vec3("background", environment.background, kNotNegative);
  environment.ambient = table->vec3("ambient", environment.ambient, kNotNegative);
  if (const std::optional<TableReader> sky = table->subtable("sky", kSkyKeys)) {
    environment.sky = Sky{.zenith = sky->vec3("zenith", kNotNegative),
                          .horizon = sky->vec3("horizon", kNotNegative),
                          .ground = sky->vec3("ground", kNotNegative)};
  }
  return environment;
}

CameraSpec readCamera(const TableReader& file) {
  static constexpr std::array<Key, 6> kKeys{"position", "target", "up", "vertical_fov", "near", "orbit_speed"};
  const std::optional<TableReader> table = file.subtable("camera", kKeys);
  if (!table) {
    file.fail("camera", "is missing", "[camera] with position and target is needed");
  }
  CameraSpec camera;
  camera.position = table->vec3("position", kCoordinate);
  camera.target = table->vec3("target", kCoordinate);
  camera.up = table->vec3("up", camera.up, kCoordinate);
  camera.verticalFov = table->number("vertical_fov", camera.verticalFov, kFieldOfView);
  camera.near = table->number("near", camera.near, kPositive);
  camera.orbitSpeed = table->number("orbit_speed", camera.orbitSpeed, kTurn);
  checkDirections(*table, camera);
  return camera;
}

std::vector<SettingEntry> readSettings(const TableReader& file) {
  std::vector<SettingEntry> entries;
  const std::optional<TableReader> settings = file.subtable("settings");
  if (!settings) {
    return entries;
  }
  std::map<std::string, SettingEntry> byKey;
  flatten(*settings, settings->table(), "", settings->line(), 0, byKey);
  for (auto& [key, entry] : byKey) {
    entries.push_back(std::move(entry));
  }
  std::stable_sort(entries.begin(), entries.end(),
                   [](const SettingEntry& a, const SettingEntry& b) { return a.line < b.line; });
  return entries;
}

Object readObject(const TableReader& table) {
  Object object;
  object.name = table.text("name", "");
  object.model = table.text("model");
  object.position = table.vec3("position", object.position, kCoordinate);
  object.rotation = table.vec3("rotation", object.rotation, kCoordinate);
  object.scale = table.numberOrVec3("scale", object.scale);
  object.spin = table.vec3("spin", object.spin, kTurn);
  for (int i = 0; i < 3; ++i) {
    if (object.scale[i] == 0.0) {
      table.fail("scale", "is zero along an axis", "scales other than 0 are needed, negative ones mirror");
    }
  }
  if (!std::isnormal(object.scale.x * object.scale.y * object.scale.z)) {
    table.fail("scale", "leaves the range of double precision", "scales nearer to 1 are needed");
  }
  if (table.has("color")) {
    object.color = table.vec3("color", kNotNegative);
  }
  if (table.has("specular")) {
    object.specular = table.vec3("specular", kNotNegative);
  }
  if (table.has("shininess")) {
    object.shininess = std::max(1.0, table.number("shininess", 1.0));
  }
  object.copies = readCopies(table);
  object.mirror = readObjectMirror(table);
  return object;
}

PointLight readLight(const TableReader& table) {
  PointLight light;
  light.name = table.text("name", "");
  light.position = table.vec3("position", kCoordinate);
  light.color = table.vec3("color", light.color, kNotNegative);
  light.intensity = table.number("intensity", light.intensity, kNotNegative);
  light.radius = table.number("radius", light.radius, kLength);
  light.glow = table.number("glow", light.glow, kNotNegative);
  light.castsShadow = table.boolean("casts_shadow", light.castsShadow);
  light.orbit = readOrbit(table);
  return light;
}

Mirror readMirror(const TableReader& table) {
  Mirror mirror;
  mirror.name = table.text("name", "");
  readShape(table, mirror);
  mirror.reflectance = table.vec3("reflectance", mirror.reflectance, kUnit);
  mirror.fresnel = readFresnel(table);
  mirror.baseColor = table.vec3("base_color", mirror.baseColor, kNotNegative);
  mirror.roughness = table.number("roughness", mirror.roughness, kUnit);
  mirror.ripple = readRipple(table);
  mirror.twoSided = table.boolean("two_sided", mirror.twoSided);
  mirror.backColor = table.vec3("back_color", mirror.backColor, kNotNegative);
  mirror.castsLight = table.boolean("casts_light", mirror.castsLight);
  return mirror;
}

std::optional<std::string> mirrorPolygonProblem(std::span<const glm::dvec3> polygon) {
  const auto line = [](const std::string& wrong, Key right) {
    return "polygon: " + wrong + " (" + std::string(right) + ")";
  };
  if (polygon.size() > kMostVertices) {
    return line(vertexCountText(polygon.size()), kGoodCount);
  }
  for (const glm::dvec3& p : polygon) {
    if (!kCoordinate.contains(p.x) || !kCoordinate.contains(p.y) || !kCoordinate.contains(p.z)) {
      return line("has a vertex that is too far away", kCoordinate.text() + " is needed for each coordinate");
    }
  }
  const std::optional<std::string> defect = shapeDefect(polygon);
  return defect ? std::optional(line(*defect, kGoodShape)) : std::nullopt;
}

Bookmark readBookmark(const TableReader& table, const CameraSpec& camera) {
  Bookmark bookmark{.name = table.text("name")};
  if (bookmark.name.empty()) {
    table.fail("name", "is empty", "a name to choose the bookmark by is needed");
  }
  bookmark.position = table.vec3("position", kCoordinate);
  bookmark.target = table.vec3("target", kCoordinate);
  if (table.has("up")) {
    bookmark.up = table.vec3("up", kCoordinate);
  }
  if (table.has("vertical_fov")) {
    bookmark.verticalFov = table.number("vertical_fov", camera.verticalFov, kFieldOfView);
  }
  checkDirections(table, cameraOf(bookmark, camera));
  return bookmark;
}

std::span<const std::string_view> objectKeys() {
  static constexpr std::array<Key, 11> kKeys{"name",  "model",    "position",  "rotation", "scale", "spin",
                                             "color", "specular", "shininess", "copies",   "mirror"};
  return kKeys;
}

std::span<const std::string_view> lightKeys() {
  static constexpr std::array<Key, 8> kKeys{"name",   "position", "color",        "intensity",
                                            "radius", "glow",     "casts_shadow", "orbit"};
  return kKeys;
}

std::span<const std::string_view> mirrorKeys() {
  static constexpr std::array<Key, 14> kKeys{"name",    "position",    "rotation",   "spin",       "size",
                                             "polygon", "reflectance", "fresnel",    "base_color", "roughness",
                                             "ripple",  "two_sided",   "back_color", "casts_light"};
  return kKeys;
}

std::span<const std::string_view> bookmarkKeys() {
  static constexpr std::array<Key, 5> kKeys{"name", "position", "target", "up", "vertical_fov"};
  return kKeys;
}

}  // namespace speculum
