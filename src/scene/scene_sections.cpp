#include "scene/scene_sections.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "geometry/polygon.hpp"
#include "scene/scene_state.hpp"

namespace speculum {

namespace {

using Key = std::string_view;

// Bounds the time to check a polygon, which grows with the square of its vertices.
constexpr size_t mostVertices = 1000;

template <typename Value, typename Field>
Value readValue(const TableReader& table, const Field& field) {
  if constexpr (std::is_same_v<Value, double>) {
    return std::clamp(table.number(field.key, field.range), field.floor, field.ceiling);
  } else if constexpr (std::is_same_v<Value, int>) {
    return static_cast<int>(table.integer(field.key, field.range));
  } else if constexpr (std::is_same_v<Value, bool>) {
    return table.boolean(field.key);
  } else if constexpr (std::is_same_v<Value, std::string>) {
    return table.text(field.key);
  } else if constexpr (std::is_same_v<Value, glm::dvec2>) {
    return table.vec2(field.key, field.range);
  } else if constexpr (std::is_same_v<Value, glm::dvec3>) {
    return field.uniform ? table.numberOrVec3(field.key) : table.vec3(field.key, field.range);
  } else if constexpr (std::is_same_v<Value, std::vector<glm::dvec3>>) {
    return table.points(field.key);
  } else {
    return static_cast<Value>(table.choice(field.key, choicesOf(Value())));
  }
}

template <Described Node>
void readFields(const TableReader& table, Node& node) {
  forEachField<Node>([&](const auto& field) {
    if (!field.appliesTo(node) || (!field.required && !table.has(field.key))) {
      return;
    }
    using Value = typename std::decay_t<decltype(field)>::Value;
    Value& value = node.*field.member;
    if constexpr (Described<Value>) {
      readFields(*table.subtable(field.key, keysOf<Value>()), value);
    } else if constexpr (!IsOptional<Value>::value) {
      value = readValue<Value>(table, field);
    } else if constexpr (Described<typename Value::value_type>) {
      readFields(*table.subtable(field.key, keysOf<typename Value::value_type>()), value.emplace());
    } else {
      value = readValue<typename Value::value_type>(table, field);
    }
  });
}

std::optional<std::string> shapeDefect(std::span<const glm::dvec3> polygon) {
  const std::optional<std::string> defect = polygonDefect(polygon);
  if (!defect && !(glm::length(newellVector(polygon)) >= shortestLength * shortestLength)) {
    return "has no area that can be computed with";
  }
  return defect;
}

constexpr Key goodShape = "a planar, convex polygon with an area of at least 1e-8 of its squared diameter is needed";

std::string vertexCountText(size_t count) {
  return "has " + std::to_string(count) + " vertices";
}

constexpr Key goodCount = "3 .. 1000 are needed";

void checkShape(const TableReader& table, Key key, std::span<const glm::dvec3> polygon) {
  if (const std::optional<std::string> defect = shapeDefect(polygon)) {
    table.fail(key, *defect, goodShape);
  }
}

// Reads the polygon before the other fields, because it decides which of them apply.
void readPolygon(const TableReader& table, Mirror& mirror) {
  for (const Key other : {"size", "position", "rotation", "spin"}) {
    if (table.has(other)) {
      table.fail(other, "does not go with polygon", "give either polygon or position, rotation, spin and size");
    }
  }
  mirror.polygon = table.points("polygon");
  if (mirror.polygon.size() > mostVertices) {
    table.fail("polygon", vertexCountText(mirror.polygon.size()), goodCount);
  }
  checkShape(table, "polygon", mirror.polygon);
}

void checkRectangle(const TableReader& table, const Mirror& mirror) {
  const glm::dvec2 half = 0.5 * mirror.size;
  const std::array<glm::dvec3, 4> corners{glm::dvec3(-half, 0.0), glm::dvec3(half.x, -half.y, 0.0),
                                          glm::dvec3(half, 0.0), glm::dvec3(-half.x, half.y, 0.0)};
  checkShape(table, "size", corners);
  // Vertices are rounded to 2^-53 of their distance from the origin, which must be small against the mirror.
  if (std::min(mirror.size.x, mirror.size.y) < 1e-10 * glm::length(mirror.position)) {
    table.fail("position", "is too far from the origin for the mirror's size",
               "at most 1e10 times its width and height are needed");
  }
}

// Why a camera gives no view.
struct CameraDefect {
  Key key;
  const char* wrong;
  const char* right;
};

std::optional<CameraDefect> cameraDefect(const CameraSpec& camera) {
  if (!hasDirection(camera.target - camera.position)) {
    return CameraDefect{"target", "has no direction from position", "a point away from position is needed"};
  }
  if (!hasDirection(camera.up)) {
    return CameraDefect{"up", "has no direction", "a vector that is not zero, such as [0, 1, 0], is needed"};
  }
  try {
    lookAt(camera.position, camera.target, camera.up, camera.verticalFov, camera.near);
  } catch (const std::invalid_argument&) {
    return CameraDefect{"up", "the view direction is parallel to up", "up and target - position must not be parallel"};
  }
  return std::nullopt;
}

void checkDirections(const TableReader& table, const CameraSpec& camera) {
  if (const std::optional<CameraDefect> defect = cameraDefect(camera)) {
    table.fail(table.has(defect->key) ? defect->key : "target", defect->wrong, defect->right);
  }
}

// Returns a boolean, number or string as --set takes it; nothing for any other value.
std::optional<std::string> plainText(const toml::node& node) {
  if (const toml::value<std::string>* text = node.as_string()) {
    return text->get();
  }
  if (const toml::value<bool>* flag = node.as_boolean()) {
    return flag->get() ? "true" : "false";
  }
  if (const toml::value<int64_t>* integer = node.as_integer()) {
    return std::to_string(integer->get());
  }
  const toml::value<double>* number = node.as_floating_point();
  return number ? std::optional(nlohmann::json(number->get()).dump()) : std::nullopt;
}

// Returns the text of a boolean, number, string or array of numbers.
std::string settingText(const TableReader& settings, const toml::node& node, const std::string& key) {
  const Key wanted = "a boolean, number, string or array of numbers is needed";
  if (node.is_floating_point() && !std::isfinite(node.as_floating_point()->get())) {
    settings.failAt(node, key, "is not finite", wanted);
  }
  if (const std::optional<std::string> text = plainText(node)) {
    return *text;
  }
  const toml::array* array = node.as_array();
  if (!array) {
    settings.failAt(node, key, "is " + std::string(typeName(node)), wanted);
  }
  std::vector<double> values;
  for (const toml::node& element : *array) {
    const std::optional<double> value = numberIn(element);
    if (!value || !std::isfinite(*value)) {
      settings.failAt(element, key, "has an element that is not a finite number", wanted);
    }
    values.push_back(*value);
  }
  return nlohmann::json(values).dump();
}

// Adds the values of nested tables with dotted keys. `depth`: number of tables around `table` within [settings].
void flatten(const TableReader& settings, const toml::table& table, const std::string& prefix, int tableLine, int depth,
             std::map<std::string, SettingEntry>& entries) {
  constexpr int deepest = 7;
  for (const auto& [key, node] : table) {
    const std::string full = prefix + std::string(key.str());
    const int line = key.source().begin.line > 0 ? static_cast<int>(key.source().begin.line) : tableLine;
    if (node.is_table() && depth == deepest) {
      settings.failAt(node, full, "has too many parts", "no setting has more than 2");
    }
    if (node.is_table()) {
      flatten(settings, *node.as_table(), full + ".", line, depth + 1, entries);
      continue;
    }
    if (entries.contains(full)) {
      settings.failAt(node, full, "is set twice", "set it once, either quoted or nested");
    }
    entries[full] = {full, settingText(settings, node, full), line, node.is_string()};
  }
}

}  // namespace

Environment readEnvironment(const TableReader& file) {
  Environment environment;
  if (const std::optional<TableReader> table = file.subtable("environment", keysOf<Environment>())) {
    readFields(*table, environment);
  }
  return environment;
}

CameraSpec readCamera(const TableReader& file) {
  const std::optional<TableReader> table = file.subtable("camera", keysOf<CameraSpec>());
  if (!table) {
    file.fail("camera", "is missing", "[camera] with position and target is needed");
  }
  CameraSpec camera;
  readFields(*table, camera);
  checkDirections(*table, camera);
  return camera;
}

std::vector<SettingEntry> readSettings(const TableReader& file, Key key) {
  std::vector<SettingEntry> entries;
  const std::optional<TableReader> settings = file.subtable(key);
  if (!settings) {
    return entries;
  }
  std::map<std::string, SettingEntry> byKey;
  flatten(*settings, settings->table(), "", settings->line(), 0, byKey);
  for (auto& [key, entry] : byKey) {
    entries.push_back(std::move(entry));
  }
  std::ranges::stable_sort(entries, [](const SettingEntry& a, const SettingEntry& b) { return a.line < b.line; });
  return entries;
}

std::vector<std::string> settingTexts(const TableReader& table, Key key, const toml::node& node) {
  std::vector<std::string> texts;
  const toml::array* array = node.as_array();
  for (size_t i = 0; i < (array ? array->size() : 1); ++i) {
    texts.push_back(settingText(table, array ? (*array)[i] : node, std::string(key)));
  }
  if (texts.empty()) {
    table.failAt(node, key, "is empty", "at least one value is needed");
  }
  return texts;
}

Object readObject(const TableReader& table) {
  Object object;
  readFields(table, object);
  for (int i = 0; i < 3; ++i) {
    if (object.scale[i] == 0.0) {
      table.fail("scale", "is zero along an axis", "scales other than 0 are needed, negative ones mirror");
    }
  }
  if (!std::isnormal(object.scale.x * object.scale.y * object.scale.z)) {
    table.fail("scale", "leaves the range of double precision", "scales nearer to 1 are needed");
  }
  return object;
}

PointLight readLight(const TableReader& table) {
  PointLight light;
  readFields(table, light);
  if (light.orbit && !hasDirection(light.orbit->axis)) {
    table.subtable("orbit")->fail("axis", "has no direction",
                                  "a vector that is not zero, such as [0, 1, 0], is needed");
  }
  return light;
}

Mirror readMirror(const TableReader& table) {
  Mirror mirror;
  if (table.has("polygon")) {
    readPolygon(table, mirror);
  } else if (!table.has("size")) {
    table.fail("size", "is missing", "size = [width, height] or polygon = [[x, y, z], ...] is needed");
  }
  readFields(table, mirror);
  if (isRectangle(mirror)) {
    checkRectangle(table, mirror);
  }
  if (mirror.ripple && mirror.ripple->amplitude == 0.0) {
    mirror.ripple.reset();
  }
  return mirror;
}

std::optional<std::string> cameraProblem(const CameraSpec& camera) {
  const std::optional<CameraDefect> defect = cameraDefect(camera);
  return defect ? std::optional(std::string(defect->key) + ": " + defect->wrong + " (" + defect->right + ")")
                : std::nullopt;
}

std::optional<std::string> mirrorPolygonProblem(std::span<const glm::dvec3> polygon) {
  const auto line = [](const std::string& wrong, Key right) {
    return "the polygon " + wrong + " (" + std::string(right) + ")";
  };
  if (polygon.size() > mostVertices) {
    return line(vertexCountText(polygon.size()), goodCount);
  }
  for (const glm::dvec3& p : polygon) {
    if (!coordinateRange.contains(p.x) || !coordinateRange.contains(p.y) || !coordinateRange.contains(p.z)) {
      return line("has a vertex that is too far away", coordinateRange.text() + " is needed for each coordinate");
    }
  }
  const std::optional<std::string> defect = shapeDefect(polygon);
  return defect ? std::optional(line(*defect, "its corners must lie in one plane, without dents, and not on a line"))
                : std::nullopt;
}

Bookmark readBookmark(const TableReader& table, const CameraSpec& camera) {
  if (table.text("name").empty()) {
    table.fail("name", "is empty", "a name to choose the bookmark by is needed");
  }
  Bookmark bookmark;
  readFields(table, bookmark);
  checkDirections(table, cameraOf(bookmark, camera));
  return bookmark;
}

}  // namespace speculum
