#pragma once

#include <glm/glm.hpp>

#include "geometry/mesh.hpp"

namespace speculum {

// Sets Kd, Ks and Ns of `material` from the metal-roughness model of glTF 2.0 (appendix B): linear base color, metal
// and roughness of 0 .. 1. Other values count as the nearest in range. `texture` is the mean color of the base color's
// texture, white without one.
//
//     Kd = (1 - metal) base,   Ks = 0.04 + metal (base texture - 0.04),
//     Ns = 2 / roughness^4 - 2, at least 1, at most 1e6
//
// Ns gives the lobe the width of a GGX lobe with alpha = roughness^2: Walter et al., "Microfacet Models for Refraction
// through Rough Surfaces" (2007), section 5.2. Ks is the reflectance at normal incidence: it does not grow towards
// grazing angles, and reflects lights alone. The texture itself multiplies Kd only, so the highlights of a textured
// metal have one color. A metal of 1 with a roughness of 0.05 or less says mirror, and nothing else does: the caller
// takes that back (Material::mirror) if the material is not opaque.
void setMetalRoughness(Material& material, glm::dvec3 baseColor, double metal, double roughness,
                       const glm::dvec3& texture = glm::dvec3(1.0));
// Returns the roughness that setMetalRoughness() turns into `shininess`.
double roughnessOf(double shininess);

}  // namespace speculum
