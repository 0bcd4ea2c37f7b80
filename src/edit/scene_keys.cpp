#include "edit/scene_keys.hpp"

#include "edit/toml_text.hpp"

namespace speculum {

namespace {

class Keys {
 public:
  // The keys that follow are of the table `name` within.
  Keys& in(const std::string& name) {
    table_ = name;
    return *this;
  }

  template <typename T>
  Keys& needed(const std::string& key, const T& value) {
    list_.push_back({table_, key, tomlText(value), false});
    return *this;
  }

  template <typename T>
  Keys& add(const std::string& key, const T& value, const T& usual) {
    needed(key, value);
    list_.back().omissible = list_.back().text == tomlText(usual);
    return *this;
  }

  Keys& name(const std::string& name) { return add("name", std::string_view(name), std::string_view()); }

  Keys& fresnel(Fresnel fresnel) {
    return add("fresnel", std::string_view(fresnel == Fresnel::schlick ? "schlick" : "none"), std::string_view("none"));
  }

  Keys& text(const std::string& key, std::string value, bool omissible) {
    list_.push_back({table_, key, std::move(value), omissible});
    return *this;
  }

  std::vector<KeyText> take() { return std::move(list_); }

 private:
  std::vector<KeyText> list_;
  std::string table_;
};

std::string polygonText(const std::vector<glm::dvec3>& polygon) {
  std::string text;
  for (const glm::dvec3& point : polygon) {
    text += (text.empty() ? "" : ", ") + tomlText(point);
  }
  return "[" + text + "]";
}

void addShape(const Mirror& mirror, const Mirror& usual, Keys& keys) {
  if (!mirror.polygon.empty()) {
    keys.text("polygon", polygonText(mirror.polygon), false);
    return;
  }
  keys.add("position", mirror.position, usual.position)
      .add("rotation", mirror.rotation, usual.rotation)
      .needed("size", mirror.size)
      .add("spin", mirror.spin, usual.spin);
}

}  // namespace

std::vector<KeyText> keyTexts(const Environment& environment) {
  const Environment usual;
  Keys keys;
  keys.add("background", environment.background, usual.background);
  if (const auto& sky = environment.sky) {
    keys.in("sky").needed("zenith", sky->zenith).needed("horizon", sky->horizon).needed("ground", sky->ground).in("");
  }
  return keys.add("ambient", environment.ambient, usual.ambient).take();
}

std::vector<KeyText> keyTexts(const CameraSpec& camera) {
  const CameraSpec usual;
  return Keys()
      .needed("position", camera.position)
      .needed("target", camera.target)
      .add("up", camera.up, usual.up)
      .add("vertical_fov", camera.verticalFov, usual.verticalFov)
      .add("near", camera.near, usual.near)
      .add("orbit_speed", camera.orbitSpeed, usual.orbitSpeed)
      .take();
}

std::vector<KeyText> keyTexts(const Object& object) {
  const Object usual;
  const glm::dvec3& scale = object.scale;
  const bool uniform = scale.x == scale.y && scale.y == scale.z;
  Keys keys;
  keys.name(object.name)
      .needed("model", std::string_view(object.model))
      .add("position", object.position, usual.position)
      .add("rotation", object.rotation, usual.rotation)
      .text("scale", uniform ? tomlText(scale.x) : tomlText(scale), scale == usual.scale)
      .add("spin", object.spin, usual.spin);
  if (object.color) {
    keys.needed("color", *object.color);
  }
  if (object.specular) {
    keys.needed("specular", *object.specular);
  }
  if (object.shininess) {
    keys.needed("shininess", *object.shininess);
  }
  if (const auto& mirror = object.mirror) {
    const ObjectMirror plain;
    keys.in("mirror").needed("reflectance", mirror->reflectance).fresnel(mirror->fresnel);
    keys.add("base_color", mirror->baseColor, plain.baseColor);
  }
  return keys.in("copies")
      .add("count", static_cast<double>(object.copies.count), 1.0)
      .add("step", object.copies.step, usual.copies.step)
      .take();
}

std::vector<KeyText> keyTexts(const PointLight& light) {
  const PointLight usual;
  Keys keys;
  keys.name(light.name)
      .needed("position", light.position)
      .add("color", light.color, usual.color)
      .add("intensity", light.intensity, usual.intensity)
      .add("radius", light.radius, usual.radius)
      .add("glow", light.glow, usual.glow)
      .add("casts_shadow", light.castsShadow, usual.castsShadow);
  if (const auto& orbit = light.orbit) {
    const Orbit plain;
    keys.in("orbit").add("center", orbit->center, plain.center).add("axis", orbit->axis, plain.axis);
    keys.needed("speed", orbit->speed);
  }
  return keys.take();
}

std::vector<KeyText> keyTexts(const Mirror& mirror) {
  const Mirror usual;
  Keys keys;
  keys.name(mirror.name);
  addShape(mirror, usual, keys);
  keys.add("reflectance", mirror.reflectance, usual.reflectance)
      .fresnel(mirror.fresnel)
      .add("base_color", mirror.baseColor, usual.baseColor)
      .add("two_sided", mirror.twoSided, usual.twoSided)
      .add("back_color", mirror.backColor, usual.backColor)
      .add("roughness", mirror.roughness, usual.roughness);
  // The loader takes ripples without height for none.
  if (mirror.ripple && mirror.ripple->amplitude > 0.0) {
    const Ripple plain;
    keys.in("ripple").needed("amplitude", mirror.ripple->amplitude);
    keys.add("wavelength", mirror.ripple->wavelength, plain.wavelength);
    keys.add("speed", mirror.ripple->speed, plain.speed).in("");
  }
  return keys.add("casts_light", mirror.castsLight, usual.castsLight).take();
}

std::vector<KeyText> keyTexts(const Bookmark& bookmark) {
  Keys keys;
  keys.needed("name", std::string_view(bookmark.name))
      .needed("position", bookmark.position)
      .needed("target", bookmark.target);
  if (bookmark.up) {
    keys.needed("up", *bookmark.up);
  }
  if (bookmark.verticalFov) {
    keys.needed("vertical_fov", *bookmark.verticalFov);
  }
  return keys.take();
}

}  // namespace speculum
