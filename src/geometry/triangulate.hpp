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
// square of the number of vertices, but see isFan().
std::vector<std::array<int, 3>> triangulate(std::span<const glm::dvec3> polygon);

// Says whether the triangles between the first vertex and each edge cover the polygon once, as in a convex one. Then
// triangulate() takes them, in time linear in the number of vertices, if there are more than 1000.
bool isFan(std::span<const glm::dvec3> polygon);

}  // namespace speculum
