#include "geometry/surface_distance.hpp"

#include <algorithm>
#include <array>
#include <glm/gtx/norm.hpp>
#include <limits>
#include <span>

namespace speculum {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Distances below are squared.

double toBox(const glm::dvec3& point, const Bounds& box) {
  return glm::length2(glm::max(glm::max(box.low - point, point - box.high), glm::dvec3(0.0)));
}

double toSegment(const glm::dvec3& point, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 along = b - a;
  const double length = glm::length2(along);
  const double t = length > 0.0 ? std::clamp(glm::dot(point - a, along) / length, 0.0, 1.0) : 0.0;
  return glm::length2(point - (a + t * along));
}

// Returns the distance to the plane if the foot of the perpendicular lies inside all edges, else to the nearest edge.
double toTriangle(const glm::dvec3& point, const glm::dvec3* corner) {
  const glm::dvec3 normal = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
  const double area = glm::length2(normal);
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

SurfaceDistance::SurfaceDistance(const std::vector<glm::dvec3>& corners) {
  std::vector<Bounds> boxes(corners.size() / 3);
  for (size_t i = 0; i < corners.size(); ++i) {
    boxes[i / 3].add(corners[i]);
  }
  bvh_ = Bvh(boxes);
  corners_.reserve(corners.size());
  for (const uint32_t triangle : bvh_.order()) {
    const auto first = corners.begin() + 3 * static_cast<std::ptrdiff_t>(triangle);
    corners_.insert(corners_.end(), first, first + 3);
  }
}

double SurfaceDistance::nearest(const glm::dvec3& point, double enough) const {
  const std::span<const Bvh::Node> nodes = bvh_.nodes();
  std::array<uint32_t, Bvh::stackSize> stack{};
  size_t size = nodes.empty() ? 0 : 1;
  double best = infinity;
  while (size > 0 && best > enough) {
    const Bvh::Node& node = nodes[stack[--size]];
    if (toBox(point, node.box) >= best) {
      continue;
    }
    for (uint32_t i = node.first; i < node.first + node.count; ++i) {
      best = std::min(best, toTriangle(point, &corners_[3 * size_t{i}]));
    }
    if (node.count == 0) {
      const bool leftIsNearer = toBox(point, nodes[node.first].box) <= toBox(point, nodes[node.first + 1].box);
      stack[size++] = node.first + (leftIsNearer ? 1 : 0);
      stack[size++] = node.first + (leftIsNearer ? 0 : 1);
    }
  }
  return best;
}

bool SurfaceDistance::within(const glm::dvec3& point, double distance) const {
  return nearest(point, distance * distance) <= distance * distance;
}

}  // namespace speculum
