#pragma once

#include "frame/frame_plan.hpp"
#include "geometry/mesh_levels.hpp"

namespace speculum {

// How far, in the mesh's own unit, points of its box may be displaced when it is placed like the instance, so that the
// view sees none of them moved by more than `texels` of its image; 0 where the box may reach the eye. A displacement d
// at view depth z is seen as no more than f d / (z cos a), with f the focal length in texels and a the angle between
// line of sight and axis.
double largestError(const View& view, const Projection& projection, const InstanceState& instance, const Mesh& mesh,
                    double texels);

// What is drawn in the place of the mesh.
struct LevelChoice {
  int level = -1;                  // index into MeshLevels::levels; -1: the mesh itself
  std::vector<IndexRange> ranges;  // of the level's indices, or the mesh's: what the view may see
};

// Of the mesh, of which the view sees `seen`, and of the levels whose error is no more than `largestError`, the one
// with the fewest triangles to draw.
LevelChoice chooseLevel(const View& view, double largestError, const InstanceState& instance, const Mesh& mesh,
                        std::vector<IndexRange> seen);

// Chooses what is drawn of each of the pass's instances, by reflection.mesh_error; of objects that are mirrors, whose
// reflections follow their normals, all triangles. `readable`: the pass's view with what is read around it.
void simplifyPass(PlannedPass& pass, const View& readable, const Projection& projection, const Settings& settings,
                  const Scene& scene, const SceneState& state);

// Indices into Scene::meshes of which any pass of the plan draws levels, or one whose image of an earlier frame is
// shown; each once.
std::vector<int> meshesWithLevels(const FramePlan& plan, const SceneState& state);

// In the pass: index into MeshLevels::levels, -1 for the mesh itself.
int levelOf(const PlannedPass& pass, int instance);

}  // namespace speculum
