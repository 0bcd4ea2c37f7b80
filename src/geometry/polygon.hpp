#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "geometry/recycled_memory.hpp"

namespace speculum {

// Vertices of a polygon that each frame builds anew.
using Polygon = RecycledVector<glm::dvec3>;

// Positive if b lies counter-clockwise of a, with y up.
inline double cross(const glm::dvec2& a, const glm::dvec2& b) {
  return a.x * b.y - a.y * b.x;
}

// Twice the signed area, positive for corners that run counter-clockwise with y up, clockwise with y down. corner(i) is
// corner number i, below `count`.
template <typename Corner>
double twiceArea(size_t count, const Corner& corner) {
  double twice = 0.0;
  for (size_t i = 1; i + 1 < count; ++i) {
    twice += cross(corner(i) - corner(0), corner(i + 1) - corner(0));
  }
  return twice;
}
inline double twiceArea(std::span<const glm::dvec2> corners) {
  return twiceArea(corners.size(), [&](size_t i) { return corners[i]; });
}

// Returns the convex hull, counter-clockwise with y up: Andrew, "Another Efficient Algorithm for Convex Hulls in Two
// Dimensions" (1979).
std::vector<glm::dvec2> convexHull(std::vector<glm::dvec2> points);

// A plane as a point on it and a unit normal. The form n.x = d would lose |d| * 2^-53 far from the origin.
struct Plane {
  glm::dvec3 point{0.0};
  glm::dvec3 normal{0.0, 0.0, 1.0};

  // Signed distance of p, metres, positive on the side the normal points to. Differences are taken first.
  double distance(const glm::dvec3& p) const { return glm::dot(normal, p - point); }
};

// Newell's area vector of a closed polygon (Sutherland, Sproull, Schumacker 1974), relative to the first vertex: twice
// the polygon's area as length, towards the side from which the vertices run counter-clockwise.
glm::dvec3 newellVector(std::span<const glm::dvec3> polygon);

// Mean of one or more vertices. Sums differences, so that a far-off origin costs no precision.
glm::dvec3 vertexMean(std::span<const glm::dvec3> polygon);

double polygonArea(std::span<const glm::dvec3> polygon);

// Distance from a point to the farthest of others; 0 without any.
double farthestDistance(const glm::dvec3& from, std::span<const glm::dvec3> points);

// Says why a polygon is unusable as a mirror, or nothing: fewer than 3 vertices, non-finite, area below 1e-8
// diameter^2, a vertex farther than 1e-4 diameters off the plane or 1e-5 diameters outside the line of an edge.
std::optional<std::string> polygonDefect(std::span<const glm::dvec3> polygon);

// Returns the vertices that are farther than `least` from the one before: two vertices within rounding of each other
// would give the edge between them any direction.
Polygon distinctVertices(std::span<const glm::dvec3> polygon, double least);

// Returns the polygon of a mirror, whose vertices may lie off its plane, moved into the plane through the first vertex.
// Vertices that then coincide are left out. An oblique eye and its mirror image would see vertices off the plane at
// different places.
std::vector<glm::dvec3> flattened(std::span<const glm::dvec3> polygon, const glm::dvec3& normal);

// Returns the part of a convex polygon with dot(normal, v - point) >= 0, by Sutherland-Hodgman (1974).
Polygon clipPolygon(std::span<const glm::dvec3> polygon, const Plane& keep);

// Splits a polygon, convex or not, into polygon.size() - 2 triangles of its vertices, wound like the polygon, by ear
// clipping (Meisters 1975). Its outline may touch itself, repeat vertices and run back along its own edges. Convex
// polygons become fans about their first vertex. A quad is cut along its shorter diagonal inside, on a tie that from
// the second to the fourth vertex, as tinyobjloader does. A polygon without area or crossing itself still gives that
// many triangles; some of them are then degenerate or overlap. Takes time in the square of the number of vertices, but
// see isFan().
std::vector<std::array<int, 3>> triangulate(std::span<const glm::dvec3> polygon);

// Says whether the triangles between the first vertex and each edge cover the polygon once, as in a convex one. Then
// triangulate() takes them, in time linear in the number of vertices, if there are more than 1000.
bool isFan(std::span<const glm::dvec3> polygon);

// Householder reflection I - 2 n n^T / (n.n): the linear part of the reflection about any plane with normal n. The
// division makes it exact for normals that are not of unit length.
inline glm::dmat3 reflectionLinear(const glm::dvec3& normal) {
  return glm::dmat3(1.0) - (2.0 / glm::dot(normal, normal)) * glm::outerProduct(normal, normal);
}

// The point's mirror image: p - 2 (n.(p - q)) n / (n.n) for a plane through q.
inline glm::dvec3 reflectPoint(const glm::dvec3& p, const Plane& plane) {
  return p - (2.0 * plane.distance(p) / glm::dot(plane.normal, plane.normal)) * plane.normal;
}

}  // namespace speculum
