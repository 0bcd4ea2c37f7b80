#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace speculum {

// Finds flat convex faces of a triangle mesh, the largest first and at most `most`. Triangles are joined across common
// edges (equal positions, opposite directions) as long as the face stays convex and within 1e-6 of its size of one
// plane; a face that cannot grow is a triangle. The triangles of a face cover it without a gap. Returns none for a mesh
// of more than `mostTriangles`, whose faces are too small to hide a mirror.
std::vector<std::vector<glm::dvec3>> convexFaces(std::span<const glm::dvec3> positions,
                                                 std::span<const uint32_t> indices, size_t most, size_t mostTriangles);

}  // namespace speculum
