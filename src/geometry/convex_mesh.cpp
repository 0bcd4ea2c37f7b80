#include "geometry/convex_mesh.hpp"

#include <algorithm>
#include <glm/gtx/component_wise.hpp>
#include <map>
#include <optional>

#include "geometry/bvh.hpp"
#include "geometry/polygon.hpp"
#include "geometry/weld.hpp"

namespace speculum {

namespace {

// Returns the edges; nothing unless each has two triangles.
std::optional<std::vector<ConvexMesh::Edge>> edgesOf(const std::vector<ConvexMesh::Triangle>& triangles) {
  std::map<std::pair<uint32_t, uint32_t>, size_t> known;
  std::vector<ConvexMesh::Edge> edges;
  std::vector<int> counts;
  for (uint32_t t = 0; t < triangles.size(); ++t) {
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t from = triangles[t][i];
      const uint32_t to = triangles[t][(i + 1) % 3];
      const auto [it, isNew] = known.try_emplace(std::minmax(from, to), edges.size());
      if (isNew) {
        edges.push_back({from, to, {t, t}, false});
        counts.push_back(1);
        continue;
      }
      ConvexMesh::Edge& edge = edges[it->second];
      edge.triangles[1] = t;
      edge.sameDirection = edge.from == from;
      ++counts[it->second];
    }
  }
  const bool closed = std::ranges::all_of(counts, [](int count) { return count == 2; });
  return closed ? std::optional(edges) : std::nullopt;
}

// Scales the points so that the longest side of their box is 1; returns none if all points are the same.
std::vector<glm::dvec3> unitSized(const std::vector<glm::dvec3>& points) {
  const Bounds box = Bounds::around(points);
  const double side = glm::compMax(box.high - box.low);
  std::vector<glm::dvec3> scaled;
  if (std::isnormal(side)) {
    for (const glm::dvec3& p : points) {
      scaled.push_back((p - box.low) / side);
    }
  }
  return scaled;
}

// Says whether `inside` lies on one side of the triangle and no point on the other. A triangle without area bounds
// nothing.
bool isSupportingFace(const std::array<glm::dvec3, 3>& triangle, const glm::dvec3& inside,
                      std::span<const glm::dvec3> points) {
  const glm::dvec3 area = newellVector(triangle);
  if (!(glm::length(area) > convexTolerance * convexTolerance)) {
    return true;
  }
  Plane plane{triangle[0], glm::normalize(area)};
  if (plane.distance(inside) < 0.0) {
    plane.normal = -plane.normal;
  }
  return plane.distance(inside) > convexTolerance &&
         std::ranges::all_of(points, [&](const glm::dvec3& p) { return plane.distance(p) >= -convexTolerance; });
}

}  // namespace

ConvexMesh convexMesh(std::span<const glm::dvec3> positions, std::span<const uint32_t> indices, size_t mostTriangles) {
  if (indices.empty() || indices.size() > 3 * mostTriangles) {
    return {};
  }
  PointWelder welder;
  ConvexMesh mesh;
  for (size_t i = 0; i + 2 < indices.size(); i += 3) {
    mesh.triangles.push_back({welder.weld(positions[indices[i]]), welder.weld(positions[indices[i + 1]]),
                              welder.weld(positions[indices[i + 2]])});
  }
  mesh.points = welder.points();
  const std::vector<glm::dvec3> scaled = unitSized(mesh.points);
  std::optional<std::vector<ConvexMesh::Edge>> edges = edgesOf(mesh.triangles);
  if (scaled.empty() || !edges) {
    return {};
  }
  const glm::dvec3 inside = vertexMean(scaled);
  const bool convex = std::ranges::all_of(mesh.triangles, [&](const ConvexMesh::Triangle& t) {
    return isSupportingFace({scaled[t[0]], scaled[t[1]], scaled[t[2]]}, inside, scaled);
  });
  if (!convex) {
    return {};
  }
  mesh.edges = std::move(*edges);
  return mesh;
}

}  // namespace speculum
