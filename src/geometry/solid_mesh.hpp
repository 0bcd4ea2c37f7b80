#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

namespace speculum {

// Says whether no view from outside the mesh's box can see the back of a triangle, so that it need not be drawn. True
// for meshes whose components (triangles joined by edges)
// - are closed: at each edge, two triangles run in opposite directions,
// - do not cross or touch themselves, except at shared vertices,
// - are wound counter-clockwise seen from outside.
// Such a component winds once around what is inside and not at all around what is outside. The components may cross or
// contain each other: winding numbers add up, and where a line of sight first meets a surface, the sum must rise.
//
// Vertices at equal positions are one. What is nearer to itself than 1e-7 of the longest
// side of the box counts as touching. A mesh of more than `mostSolidTriangles`, or one where too many triangles lie
// close together to be tested in time n log n, counts as no solid.
bool isSolid(std::span<const glm::dvec3> positions, std::span<const uint32_t> indices);

constexpr size_t mostSolidTriangles = 65536;

}  // namespace speculum
