#include "geometry/mesh.hpp"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/gtx/component_wise.hpp>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "geometry/bvh.hpp"

namespace speculum {

namespace {

constexpr double touching = 1e-7;
constexpr size_t mostVisited = 256;  // boxes and triangles for each triangle, in the mean

using Triangle = std::array<uint32_t, 3>;  // vertices
using Corners = std::array<glm::dvec3, 3>;

// Floats round by less than `touching`, by which boxes are wider than they need to be.
struct Box {
  glm::vec3 low;
  glm::vec3 high;
};

struct SolidTester {
  std::vector<glm::dvec3> vertices;  // scaled: the longest side of their box is 1
  std::vector<Triangle> triangles;
  std::vector<uint32_t> component;  // of each triangle: another of its triangles, or itself, which names it
  std::vector<uint8_t> turns;       // of the triangles around each vertex, see findFans()

  uint32_t componentOf(uint32_t triangle) {
    while (component[triangle] != triangle) {
      triangle = component[triangle] = component[component[triangle]];
    }
    return triangle;
  }
  Corners cornersOf(const Triangle& t) const { return {vertices[t[0]], vertices[t[1]], vertices[t[2]]}; }

  bool weld(std::span<const uint32_t> indices);
  bool joinEdges();
  bool isWoundOutward();
  void findFans();
  bool crossesItself();
};

// Scales the vertices and makes triangles, in which vertices at equal positions are one. Returns false if two of a
// triangle are.
bool SolidTester::weld(std::span<const uint32_t> indices) {
  Bounds box;
  for (const uint32_t index : indices) {
    box.add(vertices[index]);
  }
  const double side = glm::compMax(box.high - box.low);
  if (!std::isnormal(side)) {
    return false;
  }
  for (glm::dvec3& vertex : vertices) {
    vertex = (vertex - box.low) / side;
  }
  triangles.resize(indices.size() / 3);
  meshopt_generateShadowIndexBuffer(triangles[0].data(), indices.data(), indices.size(), vertices.data(),
                                    vertices.size(), sizeof(glm::dvec3), sizeof(glm::dvec3));
  return std::ranges::none_of(triangles,
                              [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
}

// Joins the two triangles of each edge; returns false unless each edge has two, in opposite directions.
bool SolidTester::joinEdges() {
  constexpr uint32_t none = ~0u;
  const auto sides = static_cast<uint32_t>(3 * triangles.size());  // numbered through all triangles
  const auto start = [&](uint32_t side) { return triangles[side / 3][side % 3]; };
  const auto end = [&](uint32_t side) { return triangles[side / 3][(side + 1) % 3]; };
  std::vector<uint32_t> slots(std::bit_ceil(4 * triangles.size()), none);  // open addressing
  const int shift = 64 - std::countr_zero(slots.size());
  const auto slotOf = [&](uint32_t from, uint32_t to) -> uint32_t& {
    size_t slot = (uint64_t{from} << 32 | to) * 0x9e3779b97f4a7c15u >> shift;
    while (slots[slot] != none && (start(slots[slot]) != from || end(slots[slot]) != to)) {
      slot = (slot + 1) % slots.size();
    }
    return slots[slot];
  };
  for (uint32_t side = 0; side < sides; ++side) {
    if (std::exchange(slotOf(start(side), end(side)), side) != none) {
      return false;
    }
  }
  component.resize(triangles.size());
  std::iota(component.begin(), component.end(), 0u);
  for (uint32_t side = 0; side < sides; ++side) {
    const uint32_t opposite = slotOf(end(side), start(side));
    if (opposite == none) {
      return false;
    }
    component[componentOf(side / 3)] = componentOf(opposite / 3);
  }
  return true;
}

bool SolidTester::isWoundOutward() {
  constexpr double leastVolume = 1e-12;  // six times the volume; far above the rounding of the sum
  std::vector<double> volumes(triangles.size());
  for (uint32_t t = 0; t < triangles.size(); ++t) {
    component[t] = componentOf(t);
    const Corners c = cornersOf(triangles[t]);
    const glm::dvec3& origin = vertices[triangles[component[t]][0]];
    volumes[component[t]] += glm::dot(c[0] - origin, glm::cross(c[1] - origin, c[2] - origin));
  }
  for (uint32_t t = 0; t < triangles.size(); ++t) {
    if (component[t] == t && !(volumes[t] > leastVolume)) {
      return false;
    }
  }
  return true;
}

// Finds the vertices whose triangles meet nowhere else: seen along some normal, they lie around the vertex, all turn
// the same way, and together turn once. `turns` is 1 there. At each vertex it counts the triangles that lead across
// half a line through the vertex, or is 2 where a triangle is seen too steeply.
void SolidTester::findFans() {
  std::vector<glm::dvec3> normals(vertices.size(), glm::dvec3(0.0));
  for (const Triangle& t : triangles) {
    const Corners c = cornersOf(t);
    const glm::dvec3 area = glm::cross(c[1] - c[0], c[2] - c[0]);
    for (const uint32_t vertex : t) {
      normals[vertex] += area;
    }
  }
  turns.resize(vertices.size());
  for (const Triangle& t : triangles) {
    for (size_t i = 0; i < 3; ++i) {
      constexpr double least = 0.01;  // sine of an angle, by far more than rounding
      const glm::dvec3& normal = normals[t[i]];
      const glm::dvec3 a = vertices[t[(i + 1) % 3]] - vertices[t[i]];
      const glm::dvec3 b = vertices[t[(i + 2) % 3]] - vertices[t[i]];
      const double turn = glm::dot(normal, glm::cross(a, b));
      const bool steep =
          !(turn > 0.0 && turn * turn > least * least * glm::dot(normal, normal) * glm::dot(a, a) * glm::dot(b, b));
      const glm::dvec3 side = glm::cross(normal, glm::dvec3(1.0, 0.7, 0.3));
      const bool crosses = glm::dot(side, a) < 0.0 && glm::dot(side, b) >= 0.0;
      uint8_t& turnsHere = turns[t[i]];
      turnsHere = steep ? 2 : static_cast<uint8_t>(std::min(2, turnsHere + crosses));
    }
  }
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
  const auto separated = [&](const glm::dvec3& axis) {
    return separatesCones(axis, a, b) || separatesCones(axis, b, a);
  };
  for (size_t i = 0; i < 2; ++i) {
    // These come first because they separate most neighbours on a smooth surface.
    if (separated(glm::cross(normalA, a[i])) || separated(glm::cross(normalB, b[i]))) {
      return true;
    }
  }
  return separated(normalA) || separated(normalB) || std::ranges::any_of(a, [&](const glm::dvec3& direction) {
           return separated(glm::cross(direction, b[0])) || separated(glm::cross(direction, b[1]));
         });
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
  if (mesh.turns[a[atA]] == 1) {
    return false;
  }
  const glm::dvec3& apex = mesh.vertices[a[atA]];
  const auto directions = [&](const Triangle& t, size_t at) -> Pair {
    return {glm::normalize(mesh.vertices[t[(at + 1) % 3]] - apex),
            glm::normalize(mesh.vertices[t[(at + 2) % 3]] - apex)};
  };
  return !conesAreApart(directions(a, atA), directions(b, atB));
}

bool SolidTester::crossesItself() {
  findFans();
  // In large meshes the hierarchy is over runs of triangles, which takes less time and memory: neighbours in the list
  // mostly are neighbours on the surface.
  const size_t run = triangles.size() > 65536 ? 8 : 1;
  std::vector<Box> boxes(triangles.size());
  std::vector<Bounds> runs((triangles.size() + run - 1) / run);
  for (size_t t = 0; t < triangles.size(); ++t) {
    Bounds box = Bounds::around(cornersOf(triangles[t]));
    box.low -= 2.0 * touching;
    box.high += 2.0 * touching;
    boxes[t] = {box.low, box.high};
    runs[t / run].add(box);
  }
  const auto overlap = [](const auto& a, const auto& b) {
    return glm::all(glm::lessThanEqual(a.low, b.high)) && glm::all(glm::lessThanEqual(b.low, a.high));
  };
  const Bvh bvh(runs, 1);
  const std::span nodes = bvh.nodes();
  size_t left = mostVisited * (triangles.size() + 16);
  std::vector<std::array<uint32_t, 2>> stack{{0, 0}};  // nodes; their triangles are compared, each two once
  while (!stack.empty()) {
    const auto [first, second] = stack.back();
    stack.pop_back();
    const Bvh::Node& a = nodes[first];
    const Bvh::Node& b = nodes[second];
    if (left-- == 0) {
      return true;
    }
    if (first != second && !overlap(a.box, b.box)) {
      continue;
    }
    if (a.count > 0 && b.count > 0) {
      const size_t beginA = run * bvh.order()[a.first];
      const size_t beginB = run * bvh.order()[b.first];
      const size_t endB = std::min(beginB + run, triangles.size());
      for (size_t t = beginA; t < std::min(beginA + run, triangles.size()); ++t) {
        if (!overlap(boxes[t], Box{b.box.low, b.box.high})) {
          continue;
        }
        const size_t begin = first == second ? t + 1 : beginB;
        if (left < endB - begin) {
          return true;
        }
        left -= endB - begin;
        for (size_t other = begin; other < endB; ++other) {
          if (overlap(boxes[t], boxes[other]) && component[other] == component[t] &&
              meet(*this, triangles[t], triangles[other])) {
            return true;
          }
        }
      }
    } else if (first == second) {
      stack.insert(stack.end(), {{a.first, a.first}, {a.first + 1, a.first + 1}, {a.first, a.first + 1}});
    } else if (b.count > 0 || (a.count == 0 && a.box.halfArea() > b.box.halfArea())) {
      stack.insert(stack.end(), {{a.first, second}, {a.first + 1, second}});
    } else {
      stack.insert(stack.end(), {{first, b.first}, {first, b.first + 1}});
    }
  }
  return false;
}

}  // namespace

bool isSolid(std::vector<glm::dvec3> positions, std::vector<uint32_t> indices) {
  if (indices.empty() || indices.size() > 3 * mostSolidTriangles) {
    return false;
  }
  SolidTester mesh{.vertices = std::move(positions)};
  if (!mesh.weld(indices)) {
    return false;
  }
  indices = {};
  return mesh.joinEdges() && mesh.isWoundOutward() && !mesh.crossesItself();
}

}  // namespace speculum
