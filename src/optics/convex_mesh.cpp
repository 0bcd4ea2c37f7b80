#include "optics/convex_mesh.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "optics/polygon.hpp"
#include "optics/weld.hpp"

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

double sizeOf(std::span<const glm::dvec3> points) {
  glm::dvec3 low = points[0];
  glm::dvec3 high = points[0];
  for (const glm::dvec3& p : points) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  return glm::length(high - low);
}

// Whether no point lies on the other side of the triangle than `inside`.
bool bounds(const std::array<glm::dvec3, 3>& triangle, const glm::dvec3& inside, std::span<const glm::dvec3> points,
            double tolerance) {
  const glm::dvec3 area = newellVector(triangle);
  if (!(glm::length(area) > tolerance * tolerance)) {
    return true;
  }
  Plane plane{triangle[0], glm::normalize(area)};
  if (plane.distance(inside) < 0.0) {
    plane.normal = -plane.normal;
  }
  return std::all_of(points.begin(), points.end(),
                     [&](const glm::dvec3& p) { return plane.distance(p) >= -tolerance; });
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
  const std::vector<glm::dvec3>& places = welder.points();
  const double tolerance = convexTolerance * sizeOf(places);
  const glm::dvec3 inside = vertexMean(places);
  for (size_t i = 0; i + 2 < points.size(); i += 3) {
    if (!bounds({places[points[i]], places[points[i + 1]], places[points[i + 2]]}, inside, places, tolerance)) {
      return {};
    }
  }
  return isClosed(points) ? places : std::vector<glm::dvec3>{};
}

}  // namespace speculum
