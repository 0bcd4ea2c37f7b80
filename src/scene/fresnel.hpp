#pragma once

#include <glm/glm.hpp>

#include "scene/scene.hpp"

namespace speculum {

// Reflectance F of a mirror for `cosine`, the cosine between its normal and the viewer: the same at every angle, or
// Schlick, "An Inexpensive BRDF Model for Physically-based Rendering" (1994).
glm::dvec3 mirrorReflectance(const glm::dvec3& reflectance, Fresnel fresnel, double cosine);

}  // namespace speculum
