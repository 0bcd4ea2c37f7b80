#include "geometry/convex_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "geometry/polygon.hpp"
#include "geometry/weld.hpp"

namespace speculum {

namespace {

bool isClosed(std::span<const uint32_t> points) {
  std::map<std::pair<uint32_t, uint32_t>, int> triangles;  // by edge
  for (size_t i = 0; i + 2 < points.size(); i += 3) {
    for (const auto& [a, b] : {std::pair(points[i], points[i + 1]), std::pair(points[i + 1], points[i + 2]),
                               std::pair(points[i + 2], points[i])}) {
      ++triangles[std::minmax(a, b)];
    }
  }
  return std::all_of(triangles.begin(), triangles.end(), [](const auto& edge) { return edge.second == 2; });
}

// The points in a box whose longest side is 1; none if it has no such side.
std::vector<glm::dvec3> unitSized(const std::vector<glm::dvec3>& points) {
  glm::dvec3 low = points[0];
  glm::dvec3 high = points[0];
  for (const glm::dvec3& p : points) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const double side = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
  std::vector<glm::dvec3> scaled;
  if (std::isnormal(side)) {
    for (const glm::dvec3& p : points) {
      scaled.push_back((p - low) / side);
    }
  }
  return scaled;
}

using Triangle = std::array<glm::dvec3, 3>;

// Whether `inside` lies on one side of the triangle, and no point on the other. One without area bounds nothing.
bool bounds(const Triangle& triangle, const glm::dvec3& inside, std::span<const glm::dvec3> points, double tolerance) {
  const glm::dvec3 area = newellVector(triangle);
  if (!(glm::length(area) > tolerance * tolerance)) {
    return true;
  }
  Plane plane{triangle[0], glm::normalize(area)};
  if (plane.distance(inside) < 0.0) {
    plane.normal = -plane.normal;
  }
  return plane.distance(inside) > tolerance && std::all_of(points.begin(), points.end(), [&](const glm::dvec3& p) {
           return plane.distance(p) >= -tolerance;
         });
}

double volume(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  return glm::dot(a, glm::cross(b, c));
}

// Whether a ray from `inside` meets one triangle only. Where each edge has two triangles, all rays meet an odd number
// of them or all an even one: after one that meets one triangle, none finds a gap. Sheets with two sides, which enclose
// nothing, are met an even number of times.
bool isMetOnce(std::span<const Triangle> triangles, const glm::dvec3& inside) {
  const Triangle& largest =
      *std::max_element(triangles.begin(), triangles.end(),
                        [](const Triangle& a, const Triangle& b) { return polygonArea(a) < polygonArea(b); });
  // Off the lines through corners and middles, along which other triangles are likely to be cut.
  const glm::dvec3 ray = 0.51 * largest[0] + 0.31 * largest[1] + 0.18 * largest[2] - inside;
  int met = 0;
  for (const Triangle& triangle : triangles) {
    const glm::dvec3 a = triangle[0] - inside;
    const glm::dvec3 b = triangle[1] - inside;
    const glm::dvec3 c = triangle[2] - inside;
    const double whole = volume(a, b, c);
    const std::array parts{volume(ray, b, c), volume(a, ray, c), volume(a, b, ray)};
    met += whole != 0.0 && std::all_of(parts.begin(), parts.end(), [&](double part) { return part * whole >= 0.0; });
  }
  return met == 1;
}

}  // namespace

std::vector<glm::dvec3> convexVertices(std::span<const glm::dvec3> positions, std::span<const uint32_t> indices,
                                       size_t mostTriangles) {
  if (indices.empty() || indices.size() > 3 * mostTriangles) {
    return {};
  }
  PointWelder welder;
  std::vector<uint32_t> points;
  points.reserve(indices.size());
  for (const uint32_t index : indices) {
    points.push_back(welder.weld(positions[index]));
  }
  const std::vector<glm::dvec3> places = unitSized(welder.points());
  if (places.empty() || !isClosed(points)) {
    return {};
  }
  const glm::dvec3 inside = vertexMean(places);
  std::vector<Triangle> triangles;
  for (size_t i = 0; i + 2 < points.size(); i += 3) {
    triangles.push_back({places[points[i]], places[points[i + 1]], places[points[i + 2]]});
    if (!bounds(triangles.back(), inside, places, convexTolerance)) {
      return {};
    }
  }
  return isMetOnce(triangles, inside) ? welder.points() : std::vector<glm::dvec3>{};
}

}  // namespace speculum
