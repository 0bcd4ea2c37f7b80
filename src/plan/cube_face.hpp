#pragma once

#include <span>

#include "geometry/bvh.hpp"
#include "geometry/recycled_memory.hpp"
#include "plan/frame_plan.hpp"

namespace speculum {

// Directions in which the six images about a point look: +x, -x, +y, -y, +z, -z.
struct FaceAxes {
  const char* name;
  glm::dvec3 forward;  // world
  glm::dvec3 up;
};
std::span<const FaceAxes> faceAxes();

// Corner of a cube's face among the six, three to a row, in texels.
glm::ivec2 faceCorner(int size, size_t face);

// Axis-aligned boxes relative to a point in the world: one per instance, then one per mirror, in the state's order.
RecycledVector<Bounds> boxesOf(const Scene& scene, const SceneState& state, const glm::dvec3& origin = glm::dvec3(0.0));

// Adds the instances that the view may see, except `without`. With `cullClusters`, adds only their visible clusters.
void addVisibleInstances(const View& view, const Scene& scene, const SceneState& state, bool cullClusters, int without,
                         Pass& pass);

// Adds the lights whose glyphs the view may see.
void addVisibleLights(const View& view, const Scene& scene, const SceneState& state, const EffectSettings& effects,
                      Pass& pass);

// Point and projection from which a face is seen.
struct CubeFace {
  glm::dvec3 center;  // world
  FaceAxes axes;
  Projection projection;
  int size = 0;  // texels of each side
};

View viewOf(const CubeFace& face);

// Cubes before their faces stand in a plan: six for each, in order.
struct PlannedCubes {
  RecycledVector<Cube> cubes;
  RecycledVector<Pass> faces;
};

// Plans a face with its instances, except `without`, and with mirrors that have no image, as at reflection.max_depth.
Pass planFace(const CubeFace& face, const Scene& scene, const SceneState& state, bool cullClusters, int without = -1);

}  // namespace speculum
