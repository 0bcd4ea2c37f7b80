#include "scene/metal_roughness.hpp"

#include <algorithm>

#include "scene/value_range.hpp"

namespace speculum {

void setMetalRoughness(Material& material, const glm::dvec3& baseColor, double metal, double roughness) {
  const double share = std::clamp(metal, 0.0, 1.0);
  const double rough = std::clamp(roughness, 0.0, 1.0);
  material.diffuse = (1.0 - share) * baseColor;
  material.specular = glm::mix(glm::dvec3(0.04), baseColor, share);
  material.shininess =
      std::clamp(2.0 / std::max(rough * rough * rough * rough, 1e-9) - 2.0, leastShininess, mostShininess);
}

}  // namespace speculum
