#include "geometry/convex_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtx/component_wise.hpp>
#include <optional>

#include "geometry/bvh.hpp"
#include "geometry/polygon.hpp"

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

// Says whether `inside` lies on one side of the triangle's plane and, but for the tolerance, no point on the other
// side. True for a triangle without area, which bounds nothing.
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

// Removes edges between triangles of one plane wherever two convex faces make a convex one (Hertel and Mehlhorn, "Fast
// Triangulation of the Plane with Respect to Simple Polygons", 1983). An edge is numbered 3 * triangle + corner and
// starts at that corner; the edges of a face are linked in a ring, counter-clockwise.
class FaceJoiner {
 public:
  FaceJoiner(std::span<const glm::dvec3> positions, std::span<const uint32_t> indices) {
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> edges;  // by first and last point
    for (size_t i = 0; i + 2 < indices.size(); i += 3) {
      const std::array<uint32_t, 3> points{welder_.weld(positions[indices[i]]), welder_.weld(positions[indices[i + 1]]),
                                           welder_.weld(positions[indices[i + 2]])};
      addTriangle(points, edges);
    }
    for (const auto& [points, edge] : edges) {
      const auto twin = edges.find({points.second, points.first});
      edges_[edge].twin = twin == edges.end() ? none : twin->second;
    }
    for (uint32_t triangle = 0; triangle < areas_.size(); ++triangle) {
      if (planeOf_[triangle] == none) {
        findPlane(triangle);
      }
    }
  }

  std::vector<std::vector<glm::dvec3>> faces() {
    for (bool joined = true; joined;) {
      joined = false;
      for (uint32_t edge = 0; edge < edges_.size(); ++edge) {
        joined = join(edge) || joined;
      }
    }
    std::vector<std::vector<glm::dvec3>> polygons;
    for (uint32_t first = 0; first < edges_.size(); ++first) {
      if (!edges_[first].gone) {
        std::vector<glm::dvec3>& polygon = polygons.emplace_back();
        for (uint32_t edge = first; !edges_[edge].gone; edge = edges_[edge].next) {
          polygon.push_back(point(edge));
          edges_[edge].gone = true;
        }
      }
    }
    return polygons;
  }

 private:
  static constexpr uint32_t none = ~0u;

  struct Edge {
    uint32_t start = 0;    // point
    uint32_t twin = none;  // neighbour's edge, in the opposite direction; the last one where there are several
    uint32_t next = 0;
    uint32_t before = 0;
    bool gone = false;
  };
  // Connected triangles of one plane.
  struct FlatPart {
    glm::dvec3 normal{0.0};
    double size2 = 0.0;  // squared diameter of its bounding box
  };

  void addTriangle(const std::array<uint32_t, 3>& points, std::map<std::pair<uint32_t, uint32_t>, uint32_t>& edges) {
    const std::array<glm::dvec3, 3> p{welder_.points()[points[0]], welder_.points()[points[1]],
                                      welder_.points()[points[2]]};
    if (!std::isnormal(polygonArea(p))) {
      return;
    }
    const auto first = static_cast<uint32_t>(edges_.size());
    for (uint32_t k = 0; k < 3; ++k) {
      edges[{points[k], points[(k + 1) % 3]}] = first + k;
      edges_.push_back({.start = points[k], .next = first + (k + 1) % 3, .before = first + (k + 2) % 3});
    }
    faceOf_.push_back(static_cast<uint32_t>(areas_.size()));
    areas_.push_back(newellVector(p));
    planeOf_.push_back(none);
  }

  const glm::dvec3& point(uint32_t edge) const { return welder_.points()[edges_[edge].start]; }

  // Finds the flat part of a triangle: adds neighbours as long as they lie in the plane that the triangles so far span.
  void findPlane(uint32_t seed) {
    const glm::dvec3 origin = point(3 * seed);
    const auto number = static_cast<uint32_t>(parts_.size());
    glm::dvec3 area(0.0);
    Bounds box;
    std::vector<uint32_t> found;
    const auto add = [&](uint32_t triangle) {
      planeOf_[triangle] = number;
      area += areas_[triangle];
      for (uint32_t edge = 3 * triangle; edge < 3 * triangle + 3; ++edge) {
        box.add(point(edge));
      }
      found.push_back(triangle);
    };
    add(seed);
    for (size_t i = 0; i < found.size(); ++i) {
      for (uint32_t edge = 3 * found[i]; edge < 3 * found[i] + 3; ++edge) {
        const uint32_t twin = edges_[edge].twin;
        const uint32_t other = twin / 3;
        if (twin == none || planeOf_[other] != none || !(glm::dot(area, areas_[other]) > 0.0)) {
          continue;
        }
        const double twice = glm::length(area);
        const double height = glm::dot(area, point(edges_[edges_[twin].next].next) - origin) / twice;
        if (std::abs(height) <= 1e-6 * std::sqrt(0.5 * (twice + glm::length(areas_[other])))) {
          add(other);
        }
      }
    }
    const glm::dvec3 sides = box.high - box.low;
    parts_.push_back({glm::normalize(area), glm::dot(sides, sides)});
  }

  uint32_t faceOf(uint32_t triangle) {
    while (faceOf_[triangle] != triangle) {
      triangle = faceOf_[triangle] = faceOf_[faceOf_[triangle]];
    }
    return triangle;
  }

  // Says whether the outline is convex where `edge` follows on `before`.
  bool turnsLeft(uint32_t before, uint32_t edge) const {
    const FlatPart& part = parts_[planeOf_[edge / 3]];
    const glm::dvec3& corner = point(edge);
    const glm::dvec3 turn = glm::cross(corner - point(before), point(edges_[edge].next) - corner);
    return glm::dot(part.normal, turn) >= -1e-9 * part.size2;
  }

  // Joins the faces on both sides of an edge, across all edges in a row that the faces share, if the result is convex.
  // Says whether it did.
  bool join(uint32_t edge) {
    const uint32_t twin = edges_[edge].twin;
    if (edges_[edge].gone || twin == none || planeOf_[edge / 3] != planeOf_[twin / 3]) {
      return false;
    }
    const uint32_t face = faceOf(edge / 3);
    const uint32_t other = faceOf(twin / 3);
    uint32_t first = edge;
    uint32_t last = edge;
    while (edges_[edges_[first].before].twin == edges_[edges_[first].twin].next && edges_[first].before != last) {
      first = edges_[first].before;
    }
    while (edges_[edges_[last].next].twin == edges_[edges_[last].twin].before && edges_[last].next != first) {
      last = edges_[last].next;
    }
    const uint32_t in = edges_[first].before;
    const uint32_t out = edges_[edges_[first].twin].next;
    const uint32_t otherIn = edges_[edges_[last].twin].before;
    const uint32_t otherOut = edges_[last].next;
    if (face == other || edges_[in].twin == out || !turnsLeft(in, out) || !turnsLeft(otherIn, otherOut)) {
      return false;
    }
    for (uint32_t gone = first; gone != otherOut; gone = edges_[gone].next) {
      edges_[gone].gone = edges_[edges_[gone].twin].gone = true;
    }
    edges_[in].next = out;
    edges_[out].before = in;
    edges_[otherIn].next = otherOut;
    edges_[otherOut].before = otherIn;
    faceOf_[other] = face;
    return true;
  }

  PointWelder welder_;
  std::vector<Edge> edges_;
  std::vector<glm::dvec3> areas_;  // by triangle, see newellVector
  std::vector<uint32_t> planeOf_;  // by triangle, index into parts_
  std::vector<uint32_t> faceOf_;   // by triangle, another triangle of its face; the last of such a chain has itself
  std::vector<FlatPart> parts_;
};

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

// Looks at so many edges only, because each takes time in proportion to the corners.
ConvexFace::ConvexFace(std::vector<glm::dvec3> polygon)
    : corners(std::move(polygon)), center(vertexMean(corners)), radius(farthestDistance(center, corners)) {
  constexpr size_t mostEdges = 64;
  width = 2.0 * radius;
  const size_t step = corners.size() / mostEdges + 1;
  for (size_t i = 0; i < corners.size(); i += step) {
    const glm::dvec3& from = corners[i];
    const glm::dvec3 edge = corners[(i + 1) % corners.size()] - from;
    double farthest = 0.0;  // from the edge, times the edge's length
    for (const glm::dvec3& p : corners) {
      farthest = std::max(farthest, glm::length(glm::cross(edge, p - from)));
    }
    if (const double length = glm::length(edge); length > 0.0) {
      width = std::min(width, farthest / length);
    }
  }
}

std::vector<std::vector<glm::dvec3>> convexFaces(std::span<const glm::dvec3> positions,
                                                 std::span<const uint32_t> indices, size_t most, size_t mostTriangles) {
  if (indices.size() / 3 > mostTriangles) {
    return {};
  }
  std::vector<std::vector<glm::dvec3>> faces = FaceJoiner(positions, indices).faces();
  std::ranges::stable_sort(faces, [](const auto& a, const auto& b) { return polygonArea(a) > polygonArea(b); });
  faces.resize(std::min(faces.size(), most));
  return faces;
}

}  // namespace speculum
