#include "scene/metal_roughness.hpp"

#include <algorithm>
#include <cmath>

#include "scene/value_range.hpp"

namespace speculum {

void setMetalRoughness(Material& material, glm::dvec3 baseColor, double metal, double roughness,
                       const glm::dvec3& texture) {
  const double share = std::clamp(metal, 0.0, 1.0);
  const double alpha = std::pow(std::clamp(roughness, 0.0, 1.0), 2.0);
  material.diffuse = (1.0 - share) * baseColor;
  material.specular = glm::mix(glm::dvec3(0.04), baseColor * texture, share);
  material.mirror.reset();
  if (share == 1.0 && roughness <= 0.05 + 1e-9) {  // tinyobjloader does not round to the nearest double
    material.mirror = glm::clamp(material.specular, 0.0, 1.0);
  }
  material.shininess = std::clamp(2.0 / std::max(alpha * alpha, 1e-9) - 2.0, leastShininess, mostShininess);
}

double roughnessOf(double shininess) {
  return std::pow(2.0 / (shininess + 2.0), 0.25);
}

}  // namespace speculum
