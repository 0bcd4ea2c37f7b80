#pragma once

#include <glm/glm.hpp>

#include "geometry/mesh.hpp"

namespace speculum {

// Sets Kd, Ks and Ns of `material` from the metal-roughness model of glTF 2.0 (appendix B): linear base color, metal
// and roughness of 0 .. 1. Other values count as the nearest in range.
//
//     Kd = (1 - metal) base,   Ks = 0.04 + metal (base - 0.04),   Ns = 2 / roughness^4 - 2, at least 1, at most 1e6
//
// Ns gives the lobe the width of a GGX lobe with alpha = roughness^2: Walter et al., "Microfacet Models for Refraction
// through Rough Surfaces" (2007), section 5.2. Ks is the reflectance at normal incidence: it does not grow towards
// grazing angles, and reflects lights alone. A texture of the base color multiplies Kd only, so a textured metal has
// highlights of one color.
void setMetalRoughness(Material& material, const glm::dvec3& baseColor, double metal, double roughness);

}  // namespace speculum
