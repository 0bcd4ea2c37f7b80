#include "geometry/solid_mesh.hpp"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <glm/gtx/component_wise.hpp>
#include <numeric>
#include <optional>
#include <vector>

#include "geometry/bvh.hpp"

namespace speculum {

namespace {

constexpr double touching = 1e-7;
constexpr size_t mostVisited = 256;  // boxes and triangles for each triangle, in the mean

using Triangle = std::array<uint32_t, 3>;  // vertices
using Corners = std::array<glm::dvec3, 3>;

struct SolidTester {
  std::vector<glm::dvec3> vertices;  // scaled: the longest side of their box is 1
  std::vector<Triangle> triangles;
  std::vector<uint32_t> parent;  // of each triangle in the forest of components

  uint32_t componentOf(uint32_t triangle) {
    while (parent[triangle] != triangle) {
      triangle = parent[triangle] = parent[parent[triangle]];
    }
    return triangle;
  }
  Corners cornersOf(const Triangle& t) const { return {vertices[t[0]], vertices[t[1]], vertices[t[2]]}; }

  bool weld(std::span<const glm::dvec3> corners);
  bool joinEdges();
  bool isWoundOutward();
  bool crossesItself();
};

// Makes vertices and triangles from three points for each triangle. Returns false if two points of a triangle are
// equal.
bool SolidTester::weld(std::span<const glm::dvec3> corners) {
  const Bounds box = Bounds::around(corners);
  const double side = glm::compMax(box.high - box.low);
  if (!std::isnormal(side)) {
    return false;
  }
  std::vector<glm::dvec3> scaled(corners.size());
  std::ranges::transform(corners, scaled.begin(), [&](const glm::dvec3& p) { return (p - box.low) / side; });
  std::vector<uint32_t> numbers(corners.size());
  vertices.resize(meshopt_generateVertexRemap(numbers.data(), nullptr, numbers.size(), scaled.data(), scaled.size(),
                                              sizeof(glm::dvec3)));
  for (size_t i = 0; i < numbers.size(); ++i) {
    vertices[numbers[i]] = scaled[i];
  }
  triangles.reserve(numbers.size() / 3);
  for (size_t i = 0; i + 2 < numbers.size(); i += 3) {
    const Triangle& t = triangles.emplace_back(Triangle{numbers[i], numbers[i + 1], numbers[i + 2]});
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) {
      return false;
    }
  }
  return true;
}

// Joins the two triangles of each edge; returns false unless each edge has two, in opposite directions.
bool SolidTester::joinEdges() {
  struct Side {
    uint32_t low;
    uint32_t high;
    bool ascends;
    uint32_t triangle;
    auto operator<=>(const Side&) const = default;
  };
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for (uint32_t t = 0; t < triangles.size(); ++t) {
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t from = triangles[t][i];
      const uint32_t to = triangles[t][(i + 1) % 3];
      sides.push_back({std::min(from, to), std::max(from, to), from < to, t});
    }
  }
  std::ranges::sort(sides);
  parent.resize(triangles.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto sameEdge = [](const Side& a, const Side& b) { return a.low == b.low && a.high == b.high; };
  if (sides.size() % 2 != 0) {
    return false;
  }
  for (size_t i = 0; i < sides.size(); i += 2) {
    const Side& a = sides[i];
    const Side& b = sides[i + 1];
    if (!sameEdge(a, b) || a.ascends == b.ascends || (i > 0 && sameEdge(sides[i - 1], a))) {
      return false;
    }
    parent[componentOf(a.triangle)] = componentOf(b.triangle);
  }
  return true;
}

bool SolidTester::isWoundOutward() {
  constexpr double leastVolume = 1e-12;  // six times the volume; far above the rounding of the sum
  std::vector<double> volumes(triangles.size());
  for (uint32_t t = 0; t < triangles.size(); ++t) {
    const Corners c = cornersOf(triangles[t]);
    const glm::dvec3& origin = vertices[triangles[componentOf(t)][0]];
    volumes[componentOf(t)] += glm::dot(c[0] - origin, glm::cross(c[1] - origin, c[2] - origin));
  }
  for (uint32_t t = 0; t < triangles.size(); ++t) {
    if (componentOf(t) == t && !(volumes[t] > leastVolume)) {
      return false;
    }
  }
  return true;
}

// Says whether a slab of this normal, at least `touching` thick, lies between the triangles.
bool separates(const glm::dvec3& normal, const Corners& a, const Corners& b) {
  const double length = glm::length(normal);
  if (!(length > 0.0)) {
    return false;
  }
  const auto [lowA, highA] = std::minmax({glm::dot(normal, a[0]), glm::dot(normal, a[1]), glm::dot(normal, a[2])});
  const auto [lowB, highB] = std::minmax({glm::dot(normal, b[0]), glm::dot(normal, b[1]), glm::dot(normal, b[2])});
  return std::max(lowB - highA, lowA - highB) > touching * length;
}

std::array<glm::dvec3, 3> edgesOf(const Corners& c) {
  return {c[1] - c[0], c[2] - c[1], c[0] - c[2]};
}

// Says whether two triangles lie apart, by the separating axes of convex polygons: the normals, the products of edges,
// and for polygons of one plane the normals of their edges in the plane (Gottschalk, Lin, Manocha 1996).
bool areApart(const Corners& a, const Corners& b) {
  const std::array<glm::dvec3, 3> edgesA = edgesOf(a);
  const std::array<glm::dvec3, 3> edgesB = edgesOf(b);
  const glm::dvec3 normalA = glm::cross(edgesA[0], edgesA[1]);
  const glm::dvec3 normalB = glm::cross(edgesB[0], edgesB[1]);
  if (separates(normalA, a, b) || separates(normalB, a, b)) {
    return true;
  }
  for (const glm::dvec3& e : edgesA) {
    if (separates(glm::cross(normalA, e), a, b) ||
        std::ranges::any_of(edgesB, [&](const glm::dvec3& f) { return separates(glm::cross(e, f), a, b); })) {
      return true;
    }
  }
  return std::ranges::any_of(edgesB, [&](const glm::dvec3& f) { return separates(glm::cross(normalB, f), a, b); });
}

using Pair = std::array<glm::dvec3, 2>;  // of unit directions

// Says whether a plane through the apex has `a` on it or below and `b` on it or above, and the cones of both share no
// direction on the plane.
bool separatesCones(const glm::dvec3& normal, const Pair& a, const Pair& b) {
  // If the cones shared a direction, at most 1e-4 of it would come from the directions off the plane, so that it would
  // lie within 1e-3 of the directions on the plane.
  constexpr double rounding = 1e-11;
  constexpr double leastAngle = 1e-3;
  const double length = glm::length(normal);
  std::optional<glm::dvec3> onPlaneA;
  std::optional<glm::dvec3> onPlaneB;
  for (size_t i = 0; i < 2; ++i) {
    const double heightA = glm::dot(normal, a[i]) / length;
    const double heightB = glm::dot(normal, b[i]) / length;
    const bool isOnA = heightA > -touching;
    const bool isOnB = heightB < touching;
    // Negated, because directions of extremely short edges are NaN.
    if (!(heightA <= rounding && heightB >= -rounding) || (isOnA && onPlaneA) || (isOnB && onPlaneB)) {
      return false;
    }
    onPlaneA = isOnA ? std::optional(a[i]) : onPlaneA;
    onPlaneB = isOnB ? std::optional(b[i]) : onPlaneB;
  }
  return !onPlaneA || !onPlaneB || glm::dot(*onPlaneA, *onPlaneB) < 0.0 ||
         glm::length(glm::cross(*onPlaneA, *onPlaneB)) > leastAngle;
}

// Says whether two triangles meet only in the apex that they share; `a` and `b` are the directions of their other
// vertices. Two such triangles meet elsewhere exactly if the cones of these directions do.
bool conesAreApart(const Pair& a, const Pair& b) {
  const glm::dvec3 normalA = glm::cross(a[0], a[1]);
  const glm::dvec3 normalB = glm::cross(b[0], b[1]);
  std::array<glm::dvec3, 10> axes{normalA, normalB};
  for (size_t i = 0; i < 2; ++i) {
    axes[2 + i] = glm::cross(normalA, a[i]);
    axes[4 + i] = glm::cross(normalB, b[i]);
    axes[6 + i] = glm::cross(a[i], b[0]);
    axes[8 + i] = glm::cross(a[i], b[1]);
  }
  return std::ranges::any_of(
      axes, [&](const glm::dvec3& axis) { return separatesCones(axis, a, b) || separatesCones(axis, b, a); });
}

// Says whether two triangles of one component meet elsewhere than in the vertices or the edge that they share.
bool meet(const SolidTester& mesh, Triangle a, Triangle b) {
  size_t shared = 0;
  size_t atA = 0;
  size_t atB = 0;
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = 0; j < 3; ++j) {
      if (a[i] == b[j]) {
        ++shared;
        atA = i;
        atB = j;
      }
    }
  }
  if (shared == 0) {
    return !areApart(mesh.cornersOf(a), mesh.cornersOf(b));
  }
  if (shared > 1) {
    // Triangles that share an edge and are folded onto each other need no test: another triangle at an end of the edge
    // meets them, too.
    return shared == 3;
  }
  const glm::dvec3& apex = mesh.vertices[a[atA]];
  const auto directions = [&](const Triangle& t, size_t at) -> Pair {
    return {glm::normalize(mesh.vertices[t[(at + 1) % 3]] - apex),
            glm::normalize(mesh.vertices[t[(at + 2) % 3]] - apex)};
  };
  return !conesAreApart(directions(a, atA), directions(b, atB));
}

bool SolidTester::crossesItself() {
  std::vector<Bounds> boxes(triangles.size());
  for (size_t t = 0; t < triangles.size(); ++t) {
    boxes[t] = Bounds::around(cornersOf(triangles[t]));
    boxes[t].low -= touching;
    boxes[t].high += touching;
  }
  const auto overlap = [](const Bounds& a, const Bounds& b) {
    return glm::all(glm::lessThanEqual(a.low, b.high)) && glm::all(glm::lessThanEqual(b.low, a.high));
  };
  const Bvh bvh(boxes);
  size_t left = mostVisited * (triangles.size() + 16);
  std::vector<uint32_t> stack;
  for (uint32_t t = 0; t < triangles.size(); ++t) {
    stack.assign(1, 0);
    while (!stack.empty()) {
      const Bvh::Node& node = bvh.nodes()[stack.back()];
      stack.pop_back();
      if (left < node.count + 1) {
        return true;
      }
      left -= node.count + 1;
      if (!overlap(boxes[t], node.box)) {
        continue;
      }
      if (node.count == 0) {
        stack.push_back(node.first);
        stack.push_back(node.first + 1);
      }
      for (uint32_t k = node.first; k < node.first + node.count; ++k) {
        const uint32_t other = bvh.order()[k];
        if (other > t && overlap(boxes[t], boxes[other]) && componentOf(other) == componentOf(t) &&
            meet(*this, triangles[t], triangles[other])) {
          return true;
        }
      }
    }
  }
  return false;
}

}  // namespace

bool isSolid(std::span<const glm::dvec3> positions, std::span<const uint32_t> indices) {
  if (indices.empty() || indices.size() > 3 * mostSolidTriangles) {
    return false;
  }
  std::vector<glm::dvec3> corners(indices.size());
  std::ranges::transform(indices, corners.begin(), [&](uint32_t i) { return positions[i]; });
  SolidTester mesh;
  return mesh.weld(corners) && mesh.joinEdges() && mesh.isWoundOutward() && !mesh.crossesItself();
}

}  // namespace speculum
