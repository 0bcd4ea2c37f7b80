#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace speculum {

constexpr size_t mostSolidTriangles = 1 << 18;

// Says whether no view from outside the mesh's box can see the back of a triangle, so that backs need not be drawn.
// True for meshes whose components (triangles joined by edges)
// - are closed: at each edge, two triangles run in opposite directions,
// - do not cross or touch themselves, except at shared vertices,
// - are wound counter-clockwise seen from outside.
// Such a component winds once around what is inside it and not at all around what is outside. Components may cross or
// contain each other: winding numbers add up, and where a line of sight first meets a surface, the sum rises from 0.
//
// Vertices at equal positions are one. Parts nearer to each other than 1e-7 of the longest side of the box touch. A
// mesh of more than `mostSolidTriangles` does not count as solid, nor does one for which more than 256 boxes and
// triangles were looked at for each triangle: many lie close together, or more than 65 536 follow each other in an
// order that has nothing to do with their places.
bool isSolid(std::vector<glm::dvec3> positions, std::vector<uint32_t> indices);

}  // namespace speculum
