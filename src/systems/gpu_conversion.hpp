#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scene/scene.hpp"
#include "shaders/gpu_data.h"

namespace speculum {

// Conversions from the scene's doubles to the buffers of a frame.

// Row `r` of a matrix, and `w`.
glm::vec4 row(const glm::dmat3& m, int r, double w);
// Returns products of radiances, which may leave the range of floats.
glm::vec3 radiance(const glm::dvec3& product);
// Returns the colors that replace those of the object's material.
gpu::MaterialChange materialChange(const Object& object);
// Returns the constants for drawing a part of an object; the caller sets firstTriangle.
gpu::DrawConstants drawConstants(const Material& material, const Object& object, float handedness);
// Returns the normal matrix of a linear map, scaled to unit size: shaders normalise normals, and unscaled it may
// overflow a float.
glm::dmat3 unitNormalMatrix(const glm::dmat3& linear);

struct RippleConstants {
  float waveNumber;  // 1/m
  float slope;
  float phase;  // radians
};
RippleConstants rippleConstants(const Ripple& ripple, double time);

}  // namespace speculum
