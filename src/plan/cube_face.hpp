#pragma once

#include <span>

#include "geometry/bvh.hpp"
#include "geometry/recycled_memory.hpp"
#include "plan/frame_plan.hpp"

namespace speculum {

// Axes of one of the six images about a point, the faces of a cube. faceAxes() lists them: +x, -x, +y, -y, +z, -z.
struct FaceAxes {
  const char* name;
  glm::dvec3 forward;  // world
  glm::dvec3 up;
};
std::span<const FaceAxes> faceAxes();

// Largest product of the scene's instances and the faces of its shadow maps, or of its environment maps: bounds the
// time and memory of planning.
inline constexpr size_t mostFaceTests = 20'000'000;

// Returns axis-aligned bounding boxes in world space relative to `origin`: one per instance, then one per mirror, in
// the order of `state`.
RecycledVector<Bounds> boxesOf(const Scene& scene, const SceneState& state, const glm::dvec3& origin = glm::dvec3(0.0));

// Adds to the pass the instances that the onlooker may see in the view, except `without` (-1: none). With
// `cullClusters`, adds only their visible clusters.
void addVisibleInstances(const View& view, Onlooker onlooker, const Scene& scene, const SceneState& state,
                         bool cullClusters, int without, Pass& pass);

// Adds to the pass the lights whose glyphs the onlooker may see in the view.
void addVisibleLights(const View& view, Onlooker onlooker, const Scene& scene, const SceneState& state,
                      const EffectSettings& effects, Pass& pass);

// Eye, axes and projection of the view that renders a face.
struct CubeFace {
  glm::dvec3 center;  // world
  FaceAxes axes;
  Projection projection;
  int size = 0;  // texels of each side
};

View viewOf(const CubeFace& face);

// Cubes whose faces are not in a plan yet: `faces` holds six for each cube, in the order of `cubes` and faceAxes().
struct PlannedCubes {
  RecycledVector<Cube> cubes;
  RecycledVector<Pass> faces;
};

// Plans the pass of a face: its instances, except `without` (-1: none), and its mirrors, which have no image, as at
// reflection.max_depth.
Pass planFace(const CubeFace& face, Onlooker onlooker, const Scene& scene, const SceneState& state, bool cullClusters,
              int without = -1);

// Texels on each side beyond a face's edges, so that bilinear lookups need no other face.
inline constexpr int environmentBorder = 1;
// Largest number of curved mirrors that have an environment map; scenes of more than 100 000 objects and copies have
// fewer maps. Those that cover the widest angle have one, the others show the background.
inline constexpr size_t mostEnvironmentMaps = 32;

struct EnvironmentMaps : PlannedCubes {
  size_t omitted = 0;  // curved mirrors that are drawn and have no map
};

// Plans environment maps for the curved mirrors that these passes draw, with all faces to be rendered. Returns no map
// unless effects.curved is on and effects.curved_lookup is `environment`.
EnvironmentMaps environmentMaps(const Scene& scene, const SceneState& state, const Settings& settings,
                                std::span<const Pass* const> passes);

}  // namespace speculum
