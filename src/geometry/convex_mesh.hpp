#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace speculum {

// How far a vertex of a mesh that counts as convex may lie outside the plane of one of its triangles, as a part of the
// longest side of the mesh's bounding box. Models are written with four decimals: a ball of 1 m is off by 6e-5.
constexpr double convexTolerance = 1e-4;

// The places of the vertices of a triangle mesh that is closed (each edge, by position, has two triangles) and convex:
// whatever lies within their outline is covered by it, from everywhere outside. Empty for any other mesh, and for one
// of more than `mostTriangles`.
std::vector<glm::dvec3> convexVertices(std::span<const glm::dvec3> positions, std::span<const uint32_t> indices,
                                       size_t mostTriangles);

}  // namespace speculum
