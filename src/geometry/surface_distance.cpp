#include "geometry/surface_distance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace speculum {

namespace {

constexpr size_t leafTriangles = 4;
constexpr double infinity = std::numeric_limits<double>::infinity();

double square(const glm::dvec3& v) {
  return glm::dot(v, v);
}

double toBox(const glm::dvec3& point, const glm::dvec3& low, const glm::dvec3& high) {
  return square(glm::max(glm::max(low - point, point - high), glm::dvec3(0.0)));
}

double toSegment(const glm::dvec3& point, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 along = b - a;
  const double length = square(along);
  const double t = length > 0.0 ? std::clamp(glm::dot(point - a, along) / length, 0.0, 1.0) : 0.0;
  return square(point - (a + t * along));
}

// To its plane where the foot of the perpendicular lies inside all edges, else to the nearest edge.
double toTriangle(const glm::dvec3& point, const glm::dvec3* corner) {
  const glm::dvec3 normal = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
  const double area = square(normal);
  bool inside = area > 0.0;
  double edges = infinity;
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3& a = corner[i];
    const glm::dvec3& b = corner[(i + 1) % 3];
    inside = inside && glm::dot(glm::cross(normal, b - a), point - a) >= 0.0;
    edges = std::min(edges, toSegment(point, a, b));
  }
  const double height = glm::dot(normal, point - corner[0]);
  return inside ? height * height / area : edges;
}

}  // namespace

SurfaceDistance::SurfaceDistance(std::vector<glm::dvec3> corners) {
  std::vector<uint32_t> triangles(corners.size() / 3);
  std::iota(triangles.begin(), triangles.end(), 0);
  if (triangles.empty()) {
    return;
  }
  build(triangles, 0, corners);
  corners_.reserve(corners.size());
  for (const uint32_t triangle : triangles) {
    const auto first = corners.begin() + 3 * static_cast<std::ptrdiff_t>(triangle);
    corners_.insert(corners_.end(), first, first + 3);
  }
}

uint32_t SurfaceDistance::build(std::span<uint32_t> triangles, uint32_t first, const std::vector<glm::dvec3>& corners) {
  Node node{.low = glm::dvec3(infinity), .high = glm::dvec3(-infinity)};
  for (const uint32_t triangle : triangles) {
    for (size_t i = 0; i < 3; ++i) {
      node.low = glm::min(node.low, corners[3 * size_t{triangle} + i]);
      node.high = glm::max(node.high, corners[3 * size_t{triangle} + i]);
    }
  }
  const auto place = static_cast<uint32_t>(nodes_.size());
  nodes_.push_back(node);
  if (triangles.size() <= leafTriangles) {
    nodes_[place].first = first;
    nodes_[place].count = static_cast<uint32_t>(triangles.size());
    return place;
  }
  const glm::dvec3 size = node.high - node.low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto center = [&](uint32_t t) {
    return corners[3 * size_t{t}][axis] + corners[3 * size_t{t} + 1][axis] + corners[3 * size_t{t} + 2][axis];
  };
  const size_t half = triangles.size() / 2;
  std::nth_element(triangles.begin(), triangles.begin() + static_cast<std::ptrdiff_t>(half), triangles.end(),
                   [&](uint32_t a, uint32_t b) { return center(a) < center(b); });
  build(triangles.first(half), first, corners);
  const uint32_t second = build(triangles.subspan(half), first + static_cast<uint32_t>(half), corners);
  nodes_[place].first = second;
  return place;
}

double SurfaceDistance::nearest(const glm::dvec3& point, double best, double enough) const {
  std::array<uint32_t, 64> stack{};  // of a balanced tree
  size_t size = nodes_.empty() ? 0 : 1;
  while (size > 0 && best > enough) {
    const uint32_t place = stack[--size];
    const Node& node = nodes_[place];
    if (toBox(point, node.low, node.high) >= best) {
      continue;
    }
    for (uint32_t i = node.first; i < node.first + node.count; ++i) {
      best = std::min(best, toTriangle(point, &corners_[3 * size_t{i}]));
    }
    if (node.count == 0) {
      const std::array<uint32_t, 2> children{place + 1, node.first};
      const bool firstIsNearer = toBox(point, nodes_[children[0]].low, nodes_[children[0]].high) <=
                                 toBox(point, nodes_[children[1]].low, nodes_[children[1]].high);
      stack[size++] = children[firstIsNearer ? 1 : 0];
      stack[size++] = children[firstIsNearer ? 0 : 1];
    }
  }
  return best;
}

bool SurfaceDistance::within(const glm::dvec3& point, double distance) const {
  return nearest(point, infinity, distance * distance) <= distance * distance;
}

double SurfaceDistance::to(const glm::dvec3& point) const {
  return std::sqrt(nearest(point, infinity, -1.0));
}

}  // namespace speculum
