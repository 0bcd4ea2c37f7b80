#include "systems/gpu_conversion.hpp"

#include <algorithm>
#include <numbers>

#include "geometry/affine.hpp"
#include "scene/value_range.hpp"

namespace speculum {

glm::vec4 row(const glm::dmat3& m, int r, double w) {
  return glm::vec4(glm::dvec4(m[0][r], m[1][r], m[2][r], w));
}

glm::vec3 radiance(const glm::dvec3& product) {
  return glm::vec3(glm::min(product, kRadiance.high));
}

gpu::MaterialChange materialChange(const Object& object) {
  return {.diffuse = glm::vec3(object.color.value_or(glm::dvec3(0.0))),
          .replacesDiffuse = object.color.has_value(),
          .specular = glm::vec3(object.specular.value_or(glm::dvec3(0.0))),
          .replacesSpecular = object.specular.has_value(),
          .emission = glm::vec3(object.emission.value_or(glm::dvec3(0.0))),
          .replacesEmission = object.emission.has_value()};
}

gpu::DrawConstants drawConstants(const Material& material, const Object& object, float handedness) {
  return {.diffuse = glm::vec3(object.color.value_or(material.diffuse)),
          .shininess = static_cast<float>(object.shininess.value_or(material.shininess)),
          .specular = glm::vec3(object.specular.value_or(material.specular)),
          .handedness = handedness,
          .emission = glm::vec3(object.emission.value_or(material.emission))};
}

glm::dmat3 unitNormalMatrix(const glm::dmat3& linear) {
  const glm::dmat3 normals = normalMatrix(linear);
  const double size = std::max({glm::length(normals[0]), glm::length(normals[1]), glm::length(normals[2])});
  return size > 0.0 ? normals * (1.0 / size) : normals;
}

RippleConstants rippleConstants(const Ripple& ripple, double time) {
  const double k = 2.0 * std::numbers::pi / ripple.wavelength;
  constexpr double steepest = 1e15;  // its square is a float, and steeper slopes look the same
  // The phase is reduced in double: a float of it would have lost its fraction after hours.
  return {static_cast<float>(k), static_cast<float>(std::min(ripple.amplitude * k, steepest)),
          static_cast<float>(k * productModulo(ripple.speed, time, ripple.wavelength))};
}

}  // namespace speculum
