#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <tuple>

#include "scene/scene.hpp"
#include "scene/value_range.hpp"

namespace speculum {

// Stands for an initializer of any type; never converted while the program runs.
struct AnyInitializer {
  template <typename T>
  operator T() const;
};

// Number of members of an aggregate: the most initializers that it takes. A description that lists the members of a
// type compares their number with memberCount() in a static_assert, so that a missing member does not compile.
template <typename T, typename... Initializers>
consteval size_t memberCount(Initializers... initializers) {
  if constexpr (requires { T{initializers..., AnyInitializer{}}; }) {
    return memberCount<T>(initializers..., AnyInitializer{});
  } else {
    return sizeof...(Initializers);
  }
}

// Use of a field's value: it is read where the node is drawn (appearance), evaluated into SceneState (placement), or
// for users only (label). Beside SceneState, only appearance belongs to the content of a mirror image.
enum class FieldUse { appearance, placement, label };

template <typename Owner, typename Value>
struct FieldTraits {
  std::string_view unit = {};
  std::string_view label = {};     // in the inspector; made from the key if empty
  Range range = anyRange;          // of each number
  double floor = anyRange.low;     // smaller numbers count as this one
  double ceiling = anyRange.high;  // larger numbers count as this one
  bool required = false;           // a file must have it
  bool alwaysSaved = false;        // saved even at its default, because the table exists for this key
  bool color = false;              // linear RGB
  bool uniform = false;            // one number stands for three equal ones
  FieldUse use = FieldUse::appearance;
  double step = 0.01;                            // change for a pixel of a drag in the inspector
  bool (*applies)(const Owner& node) = nullptr;  // if false, the field is neither read nor saved
  bool (*shown)(const Owner& node) = nullptr;    // if false, the inspector has no row for the field
  Value start = {};                              // first value of an optional field that a user switches on
};

// One key of a scene file's table and the member that it stands for; the default is the member's initializer.
template <typename OwnerType, typename ValueType>
struct Field : FieldTraits<OwnerType, ValueType> {
  using Owner = OwnerType;
  using Value = ValueType;

  ValueType OwnerType::*member;
  std::string_view key;
  std::string_view text;  // what the key means, for tooltips and docs/scene_format.md

  bool appliesTo(const Owner& node) const { return this->applies == nullptr || this->applies(node); }
};

template <typename Owner, typename Value>
Field<Owner, Value> field(Value Owner::*member, std::string_view key, std::string_view text,
                          const FieldTraits<Owner, Value>& traits = {}) {
  return {traits, member, key, text};
}

// The fields of each type, in the order in which they are saved. A member that is missing here does not compile.
// Reader, writer, the content of mirror images, the inspector, docs/scene_format.md and the fuzzers' dictionary follow
// from these lists. nullptr: T is a value without fields.
template <typename T>
inline constexpr auto fieldsOf = nullptr;

template <>
inline const auto fieldsOf<Sky> = std::tuple{
    field(&Sky::zenith, "zenith", "straight up", {.range = radianceRange, .required = true, .color = true}),
    field(&Sky::horizon, "horizon", "at the horizon", {.range = radianceRange, .required = true, .color = true}),
    field(&Sky::ground, "ground", "below the horizon", {.range = radianceRange, .required = true, .color = true})};

template <>
inline const auto fieldsOf<Environment> = std::tuple{
    field(&Environment::background, "background", "radiance of rays that hit nothing",
          {.range = radianceRange, .color = true}),
    field(&Environment::sky, "sky", "replaces the background"),
    field(&Environment::ambient, "ambient", "light from all sides: radiance of a surface with the diffuse color 1",
          {.range = radianceRange, .color = true})};

template <>
inline const auto fieldsOf<CameraSpec> = std::tuple{
    field(&CameraSpec::position, "position", "the eye", {.unit = "m", .range = coordinateRange, .required = true}),
    field(&CameraSpec::target, "target", "what it looks at; differs from `position`",
          {.unit = "m", .range = coordinateRange, .required = true}),
    field(&CameraSpec::up, "up", "what is up in the picture; not along the view direction", {.range = coordinateRange}),
    field(&CameraSpec::verticalFov, "vertical_fov", "vertical field of view",
          {.unit = "deg", .range = fieldOfViewRange}),
    field(&CameraSpec::near, "near", "sets the precision of depth alone; nothing is cut there",
          {.unit = "m", .range = positiveRange}),
    field(&CameraSpec::orbitSpeed, "orbit_speed", "the eye circles the target about `up`, by the right-hand rule",
          {.unit = "deg/s", .range = turnRange})};

template <>
inline const auto fieldsOf<Copies> =
    std::tuple{field(&Copies::count, "count", "instances of the object",
                     {.label = "Number of copies", .range = copiesRange, .use = FieldUse::placement, .step = 0.1}),
               field(&Copies::step, "step", "from one instance to the next",
                     {.unit = "m",
                      .label = "Step between copies",
                      .range = coordinateRange,
                      .use = FieldUse::placement,
                      .shown = [](const Copies& copies) { return copies.count > 1; }})};

template <>
inline const auto fieldsOf<ObjectMirror> =
    std::tuple{field(&ObjectMirror::reflectance, "reflectance", "share of light reflected, the tint",
                     {.label = "Reflectance (tint)", .range = unitRange, .alwaysSaved = true, .color = true}),
               field(&ObjectMirror::fresnel, "fresnel", "schlick: reflects more at grazing angles"),
               field(&ObjectMirror::baseColor, "base_color", "diffuse layer under the reflection",
                     {.label = "Diffuse color", .range = surfaceColorRange, .color = true})};

template <>
inline const auto fieldsOf<Object> = std::tuple{
    field(&Object::name, "name", "shown in lists and messages", {.use = FieldUse::label}),
    field(&Object::model, "model", "model file, relative to the scene file",
          {.required = true, .use = FieldUse::label, .shown = [](const Object&) { return false; }}),
    field(&Object::position, "position", "of the model's origin",
          {.unit = "m", .range = coordinateRange, .use = FieldUse::placement}),
    field(&Object::rotation, "rotation", "pitch about X, yaw about Y, roll about Z; R = Ry Rx Rz",
          {.unit = "deg", .range = coordinateRange, .use = FieldUse::placement, .step = 0.5}),
    field(&Object::scale, "scale",
          "along the object's axes, after `up` and before `rotation`; negative mirrors it, zero is an error",
          {.uniform = true, .use = FieldUse::placement}),
    field(&Object::up, "up", "the model's axis that points up; z: it is turned by -90 degrees about X first",
          {.use = FieldUse::placement}),
    field(&Object::spin, "spin", "added to the rotation each second",
          {.unit = "deg/s", .range = turnRange, .use = FieldUse::placement, .step = 0.5}),
    field(&Object::color, "color", "replaces the model's diffuse color (Kd); textures and vertex colors multiply it",
          {.range = surfaceColorRange, .color = true, .start = glm::dvec3(0.6)}),
    field(&Object::specular, "specular", "replaces the model's specular color (Ks)",
          {.range = surfaceColorRange, .color = true, .start = glm::dvec3(0.2)}),
    field(&Object::shininess, "shininess", "replaces the model's exponent of highlights (Ns); clamped to 1 .. 1e6",
          {.floor = leastShininess, .ceiling = mostShininess, .step = 1.0, .start = 50.0}),
    field(&Object::emission, "emission", "replaces the model's emission (Ke): radiance that lights nothing else",
          {.range = radianceRange, .color = true, .start = glm::dvec3(1.0)}),
    field(&Object::visible, "visible", "eye: in no mirror; mirrors: only in mirrors; it casts its shadows either way"),
    field(&Object::mirror, "mirror", "makes the object a curved mirror", {.start = ObjectMirror()}),
    field(&Object::mirrorsFromMaterials, "mirrors_from_materials", "parts whose material says mirror become mirrors"),
    field(&Object::copies, "copies", "the k-th instance is moved by k times the step", {.use = FieldUse::placement})};

template <>
inline const auto fieldsOf<Orbit> = std::tuple{
    field(&Orbit::center, "center", "point on the axis",
          {.unit = "m", .range = coordinateRange, .use = FieldUse::placement}),
    field(&Orbit::axis, "axis", "direction of the axis, not zero",
          {.range = coordinateRange, .use = FieldUse::placement, .shown = [](const Orbit&) { return false; }}),
    field(&Orbit::speed, "speed", "by the right-hand rule",
          {.unit = "deg/s", .range = turnRange, .alwaysSaved = true, .use = FieldUse::placement, .step = 0.5})};

template <>
inline const auto fieldsOf<PointLight> = std::tuple{
    field(&PointLight::name, "name", "shown in lists and messages", {.use = FieldUse::label}),
    field(&PointLight::position, "position", "of the centre",
          {.unit = "m", .range = coordinateRange, .required = true, .use = FieldUse::placement}),
    field(&PointLight::color, "color", "of light and sphere", {.range = radianceRange, .color = true}),
    field(&PointLight::intensity, "intensity", "irradiance at 1 m on a surface that faces the light",
          {.range = radianceRange, .step = 0.1}),
    field(&PointLight::radius, "radius", "of the visible sphere; nearer than this the light gets no brighter",
          {.unit = "m", .range = lengthRange, .step = 0.002}),
    field(&PointLight::glow, "glow", "radiance of the sphere is this times color; 0: no sphere",
          {.range = radianceRange}),
    field(&PointLight::castsShadow, "casts_shadow", "objects and mirrors cast its shadows"),
    field(&PointLight::visible, "visible", "eye: its sphere is in no mirror; mirrors: only in mirrors"),
    field(&PointLight::orbit, "orbit", "circles around an axis", {.use = FieldUse::placement})};

template <>
inline const auto fieldsOf<Ripple> =
    std::tuple{field(&Ripple::amplitude, "amplitude", "0: no ripple",
                     {.unit = "m", .range = amplitudeRange, .alwaysSaved = true, .step = 0.0002}),
               field(&Ripple::wavelength, "wavelength", "of both trains of waves",
                     {.unit = "m", .range = wavelengthRange, .step = 0.005}),
               field(&Ripple::speed, "speed", "of the waves", {.unit = "m/s", .range = waveSpeedRange, .step = 0.005})};

template <>
inline const auto fieldsOf<MirrorQuality> =
    std::tuple{field(&MirrorQuality::scale, "scale", "`reflection.scale` of its images", {.range = imageScaleRange}),
               field(&MirrorQuality::samples, "samples", "`reflection.samples` of its images", {.range = samplesRange}),
               field(&MirrorQuality::updateInterval, "update_interval", "`reflection.update_interval` of its image",
                     {.unit = "frames", .range = intervalRange}),
               field(&MirrorQuality::method, "method", "`reflection.method` of the mirror")};

inline bool isRectangle(const Mirror& mirror) {
  return mirror.polygon.empty();
}

template <>
inline const auto fieldsOf<Mirror> = std::tuple{
    field(&Mirror::name, "name", "shown in lists and messages; its index from 0 unless given",
          {.use = FieldUse::label}),
    field(&Mirror::polygon, "polygon",
          "instead of a rectangle: world-space vertices, planar, convex, counter-clockwise from the front",
          {.unit = "m",
           .range = coordinateRange,
           .use = FieldUse::placement,
           .applies = [](const Mirror& mirror) { return !isRectangle(mirror); }}),
    field(&Mirror::position, "position", "of the centre of a rectangle",
          {.unit = "m", .range = coordinateRange, .use = FieldUse::placement, .applies = isRectangle}),
    field(&Mirror::rotation, "rotation", "as that of an object; without it the mirror faces +Z",
          {.unit = "deg", .range = coordinateRange, .use = FieldUse::placement, .step = 0.5, .applies = isRectangle}),
    field(&Mirror::size, "size", "width and height",
          {.unit = "m", .range = lengthRange, .required = true, .use = FieldUse::placement, .applies = isRectangle}),
    field(&Mirror::spin, "spin", "added to the rotation each second",
          {.unit = "deg/s", .range = turnRange, .use = FieldUse::placement, .step = 0.5, .applies = isRectangle}),
    field(&Mirror::reflectance, "reflectance", "share of light reflected, the tint; with Fresnel at normal incidence",
          {.label = "Reflectance (tint)", .range = unitRange, .color = true}),
    field(&Mirror::fresnel, "fresnel", "schlick: reflects more at grazing angles"),
    field(&Mirror::reflectanceMap, "reflectance_map", "PNG over the mirror that multiplies the reflectance; linear",
          {.shown = [](const Mirror&) { return false; }}),
    field(&Mirror::baseColor, "base_color", "diffuse layer under the reflection",
          {.label = "Diffuse color", .range = surfaceColorRange, .color = true}),
    field(&Mirror::twoSided, "two_sided", "reflects on its back too"),
    field(&Mirror::backColor, "back_color", "diffuse color of the back of a one-sided mirror",
          {.range = surfaceColorRange, .color = true, .shown = [](const Mirror& mirror) { return !mirror.twoSided; }}),
    field(&Mirror::roughness, "roughness", "spread of the reflection: GGX with alpha = roughness squared",
          {.range = unitRange, .step = 0.002}),
    // The loader drops ripples without height.
    field(&Mirror::ripple, "ripple", "two trains of waves run over the mirror",
          {.applies = [](const Mirror& mirror) { return !mirror.ripple || mirror.ripple->amplitude > 0.0; },
           .start = Ripple{.amplitude = 0.002}}),
    field(&Mirror::castsLight, "casts_light", "light bounced by the mirror reaches the scene"),
    // The inspector has rows of its own for the quality.
    field(&Mirror::quality, "quality", "replaces settings for this mirror",
          {.shown = [](const Mirror&) { return false; }})};

template <>
inline const auto fieldsOf<Bookmark> = std::tuple{
    field(&Bookmark::name, "name", "differs from other bookmarks' names", {.required = true, .use = FieldUse::label}),
    field(&Bookmark::position, "position", "as the camera's",
          {.unit = "m", .range = coordinateRange, .required = true}),
    field(&Bookmark::target, "target", "as the camera's", {.unit = "m", .range = coordinateRange, .required = true}),
    field(&Bookmark::up, "up", "the camera's unless given", {.range = coordinateRange}),
    field(&Bookmark::verticalFov, "vertical_fov", "the camera's unless given",
          {.unit = "deg", .range = fieldOfViewRange})};

template <typename T>
concept Described = !std::is_null_pointer_v<std::remove_cvref_t<decltype(fieldsOf<T>)>>;

template <typename T>
inline constexpr size_t fieldCount = std::tuple_size_v<std::remove_cvref_t<decltype(fieldsOf<T>)>>;

template <typename T>
struct IsOptional : std::false_type {};
template <typename T>
struct IsOptional<std::optional<T>> : std::true_type {};

// Calls `visit` with each Field of the type `Node`.
template <Described Node, typename Visitor>
void forEachField(const Visitor& visit) {
  // Object::mesh stands for the model, Mirror::map for the reflectance map.
  constexpr size_t withoutField = std::is_same_v<Node, Object> || std::is_same_v<Node, Mirror> ? 1 : 0;
  static_assert(fieldCount<Node> + withoutField == memberCount<Node>(), "a member is missing in fieldsOf");
  std::apply([&](const auto&... field) { (visit(field), ...); }, fieldsOf<Node>);
}

// Calls visit(part) with each part of a value: of a node, the fields for which counts(field) is true; of a list, its
// length and its elements; of an optional value, whether there is one, and it; of a vector or matrix, its elements.
template <typename Value, typename Counts, typename Visitor>
void visitParts(const Value& value, const Counts& counts, const Visitor& visit) {
  if constexpr (Described<Value>) {
    forEachField<Value>([&](const auto& field) {
      if (counts(field)) {
        visit(value.*field.member);
      }
    });
  } else if constexpr (IsOptional<Value>::value) {
    visit(value.has_value());
    if (value) {
      visit(*value);
    }
  } else if constexpr (requires { value.begin(); }) {
    visit(value.size());
    for (const auto& element : value) {
      visit(element);
    }
  } else {
    for (int i = 0; i < value.length(); ++i) {
      visit(value[i]);
    }
  }
}

// Return the names of an enumeration's values in scene files, in the order of the enumerators.
constexpr auto choicesOf(Fresnel) {
  return std::array<std::string_view, 2>{"none", "schlick"};
}

constexpr auto choicesOf(UpAxis) {
  return std::array<std::string_view, 2>{"y", "z"};
}

constexpr auto choicesOf(Visibility) {
  return std::array<std::string_view, 3>{"everywhere", "eye", "mirrors"};
}

constexpr auto choicesOf(ReflectionMethod) {
  return std::array<std::string_view, 3>{"auto", "raster", "rays"};
}

}  // namespace speculum
