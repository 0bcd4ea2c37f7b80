#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace speculum {

// Splits a simple polygon, convex or not, into polygon.size() - 2 triangles of its vertices, wound like the polygon, by
// ear clipping (Meisters 1975). Convex polygons become fans about their first vertex. A quad is cut along its shorter
// diagonal inside, on a tie that from the second to the fourth vertex, as tinyobjloader does. A polygon without area or
// crossing itself still gives that many triangles; some of them are then degenerate or overlap. Takes time in the
// square of the number of vertices.
std::vector<std::array<int, 3>> triangulate(std::span<const glm::dvec3> polygon);

}  // namespace speculum
