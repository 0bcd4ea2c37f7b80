#include "scene/fresnel.hpp"

#include <algorithm>
#include <cmath>

namespace speculum {

glm::dvec3 mirrorReflectance(const glm::dvec3& reflectance, Fresnel fresnel, double cosine) {
  if (fresnel == Fresnel::none) {
    return reflectance;
  }
  const double grazing = 1.0 - std::clamp(cosine, 0.0, 1.0);
  return reflectance + (1.0 - reflectance) * std::pow(grazing, 5.0);
}

}  // namespace speculum
