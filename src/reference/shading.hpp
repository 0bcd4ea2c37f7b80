#pragma once

#include <glm/glm.hpp>

#include "scene/trace_world.hpp"

namespace speculum {

// A point of a surface with everything that its radiance depends on. Positions are relative to the eye of the world's
// state.
struct ShadingPoint {
  glm::dvec3 position{0.0};
  glm::dvec3 normal{0.0};    // unit, on the viewer's side; zero if the model's normals cancel
  glm::dvec3 toViewer{0.0};  // unit
  glm::dvec3 facet{0.0};     // unit normal of the triangle itself, on the viewer's side; zero for mirrors
  glm::dvec3 diffuse{0.0};   // with texture and vertex colors applied
  glm::dvec3 specular{0.0};
  glm::dvec3 emission{0.0};
  double shininess = 1.0;
  Skip self;
};

// Returns the point at which `ray` met an object. The shading normal is negated when the triangle's geometric normal,
// by the winding in the model file, faces away from the viewer.
ShadingPoint objectPoint(const TraceWorld& world, const Ray& ray, const SceneHit& hit);

// Returns the sum of emission, ambient light, and Phong-Blinn from every light and its images in mirrors that cast
// light, with shadows.
glm::dvec3 surfaceRadiance(const TraceWorld& world, const ShadingPoint& point);

// Returns the share by which the mirror's map multiplies its reflectance at a position relative to the eye; 1 without a
// map.
glm::dvec3 mapShare(const Scene& scene, const Mirror& mirror, const MirrorState& state, const glm::dvec3& position);

// Returns the mirror's front normal at a world position relative to the eye: the normal of its plane or, with ripples,
// of the height field, which is the same from both sides.
glm::dvec3 mirrorNormal(const Mirror& mirror, const MirrorState& state, const glm::dvec3& position, double time);

}  // namespace speculum
