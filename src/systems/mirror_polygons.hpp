#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "plan/frame_plan.hpp"
#include "scene/scene_state.hpp"

// The polygons to draw for the mirrors of a pass.
namespace speculum {

using ClipPolygon = std::vector<glm::dvec4>;  // convex, in clip space

// Returns the polygons of each of pass.mirrors, several for a mirror that is not convex. `projection` takes view space
// to clip space.
std::vector<std::vector<ClipPolygon>> mirrorPolygons(const Pass& pass, const glm::dmat4& projection);

// Returns the polygons to draw for pass.mirrors[index]; `polygons` are those of mirrorPolygons(). Depth cannot order
// mirrors of one plane, because it is rounded in each triangle in its own way, so the parts that other mirrors cover
// are cut away. The whole mirror is drawn behind its parts: it fills gaps of one sample between them, and stands for
// parts that would be too many. `cuts` counts the cuts of all mirrors of the pass, whose number is limited.
std::vector<ClipPolygon> partsToDraw(const Pass& pass, const SceneState& state,
                                     std::span<const std::vector<ClipPolygon>> polygons, size_t index, size_t& cuts);

// Adds the triangles of a convex polygon in clip space.
void addFan(std::vector<glm::vec4>& vertices, std::span<const glm::dvec4> polygon);

// Adds a fringe around the polygon that is seen only instead of the background. Where mirrors share an edge, or end at
// a body, rounding may leave a gap of one sample; the fringe of one mirror fills the gap. Widening the mirror itself
// would be worse: it would hide the body it ends at, and its image has nothing to show beyond its edge. `size` is the
// viewport's, in pixels.
void addFringe(std::vector<glm::vec4>& vertices, std::span<const glm::dvec4> clip, const glm::dvec2& size);

}  // namespace speculum
