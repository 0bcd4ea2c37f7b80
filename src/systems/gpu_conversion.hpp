#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scene/scene.hpp"
#include "shaders/gpu_data.h"

namespace speculum {

// Conversions from the scene's doubles to the buffers of a frame.

// Returns row `r` of a matrix with `w` as fourth component.
glm::vec4 row(const glm::dmat3& m, int r, double w);
// Rounds a product of radiances to floats, at most kRadiance.high.
glm::vec3 radiance(const glm::dvec3& product);
// Returns the colors that replace those of the object's material.
gpu::MaterialChange materialChange(const Object& object);
// Returns the constants for drawing a part of an object; the caller sets firstTriangle.
gpu::DrawConstants drawConstants(const Material& material, const Object& object, float handedness);
// Returns the normal matrix of a linear map, scaled so that its longest column has length 1: unscaled it may overflow a
// float. The scale does not matter, because shaders normalise normals.
glm::dmat3 unitNormalMatrix(const glm::dmat3& linear);

struct RippleConstants {
  float waveNumber;  // 1/m
  float slope;
  float phase;  // radians
};
RippleConstants rippleConstants(const Ripple& ripple, double time);

}  // namespace speculum
