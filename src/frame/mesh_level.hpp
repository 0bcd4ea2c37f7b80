#pragma once

#include "frame/frame_plan.hpp"
#include "geometry/mesh_levels.hpp"
#include "geometry/recycled_memory.hpp"

namespace speculum {

// Returns the largest displacement of the mesh's points, in the mesh's unit, that moves nothing by more than `texels`
// in the view's image; 0 if the visible part of the mesh's box may reach the eye. A displacement d at view depth z
// moves a point in the image by at most f d / (z cos a), with f the focal length in texels and a the angle between line
// of sight and axis.
double largestError(const View& view, const Projection& projection, const InstanceState& instance, const Mesh& mesh,
                    double texels);

// Mesh level that is drawn instead of the mesh.
struct LevelChoice {
  int level = -1;                     // index into MeshLevels::levels; -1: the mesh itself
  RecycledVector<IndexRange> ranges;  // indices of the level, or of the mesh, that the view may see
};

// Chooses the fewest triangles: the ranges `seen` of the mesh, or a level whose error is no more than `largestError`.
LevelChoice chooseLevel(const View& view, double largestError, const InstanceState& instance, const Mesh& mesh,
                        RecycledVector<IndexRange> seen);

// Texels by which simplified objects may be off in the view: view.mesh_error or reflection.mesh_error.
double meshErrorIn(const View& view, const Settings& settings);

// A pass to simplify, or one that draws a shadow map, and its view with what lookups read around it.
struct SimplifiedPass {
  Pass* pass = nullptr;
  View readable;
  const Projection* projection = nullptr;
  double texels = 0.0;  // by which simplified objects may be off
  bool drawn = true;    // else it only bounds the levels that others draw
};

// Chooses a mesh level for each instance of the pass. Curved mirrors keep all triangles, since reflections follow their
// normals.
void simplifyPass(const SimplifiedPass& simplified, const Settings& settings, const Scene& scene,
                  const SceneState& state);

// Chooses one mesh level for each instance in all of the passes, off by at most the texels of each. Shadow maps need
// that: otherwise one level of an object would cast shadows on another. A pass bounds the level of all instances whose
// bounds its view may see, whether it draws a cluster of them or not. Without debug.cull_clusters, passes draw all of
// these levels.
void simplifyAlike(std::span<const SimplifiedPass> passes, const Settings& settings, const Scene& scene,
                   const SceneState& state);

// Returns the indices into Scene::meshes of meshes drawn as a level, each once. Passes that cached images replace count
// too.
std::vector<int> meshesWithLevels(const FramePlan& plan, const SceneState& state);

// Index into MeshLevels::levels of what the pass draws for the instance; -1 for the mesh itself.
int levelOf(const Pass& pass, int instance);

}  // namespace speculum
