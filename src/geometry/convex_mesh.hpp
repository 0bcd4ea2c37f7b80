#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <span>
#include <tuple>
#include <vector>

namespace speculum {

// Distance by which a vertex of a convex mesh may lie outside the plane of one of its triangles, as a part of the
// longest side of the mesh's bounding box. Models are written with four decimals: a ball of 1 m is off by 6e-5.
constexpr double convexTolerance = 1e-4;

// A closed triangle mesh (each edge has two triangles) that is convex but for the tolerance. Its outline need not be
// convex: a star as thin as the tolerance counts as convex, but its outline is a star.
struct ConvexMesh {
  using Triangle = std::array<uint32_t, 3>;
  struct Edge {
    uint32_t from = 0;  // start, in the direction of its first triangle
    uint32_t to = 0;
    std::array<uint32_t, 2> triangles{};
    bool sameDirection = false;  // both triangles run along the edge in one direction: one is inside out
  };
  std::vector<glm::dvec3> points;  // no two are equal
  std::vector<Triangle> triangles;
  std::vector<Edge> edges;
};

// Returns the mesh if it is closed and convex and has at most `mostTriangles`, else an empty one. Vertices at equal
// positions are one point.
ConvexMesh convexMesh(std::span<const glm::dvec3> positions, std::span<const uint32_t> indices, size_t mostTriangles);

// A flat convex polygon of a mesh.
struct ConvexFace {
  explicit ConvexFace(std::vector<glm::dvec3> polygon);

  std::vector<glm::dvec3> corners;
  glm::dvec3 center{0.0};  // of a sphere around the face
  double radius = 0.0;     // of that sphere
  double width = 0.0;      // distance of two parallel lines that the face lies between, about the smallest
};

// Finds flat convex faces of a triangle mesh, the largest first and at most `most`. Triangles are joined across common
// edges (equal positions, opposite directions) as long as the face stays convex and within 1e-6 of its size of one
// plane; a face that cannot grow is a triangle. The triangles of a face cover it without a gap. Returns none for a mesh
// of more than `mostTriangles`, whose faces are too small to hide a mirror.
std::vector<std::vector<glm::dvec3>> convexFaces(std::span<const glm::dvec3> positions,
                                                 std::span<const uint32_t> indices, size_t most, size_t mostTriangles);

// Numbers points from 0; equal coordinates are one point.
class PointWelder {
 public:
  struct Less {
    bool operator()(const glm::dvec3& a, const glm::dvec3& b) const {
      return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    }
  };

  uint32_t weld(const glm::dvec3& p) {
    const auto [it, isNew] = numbers_.try_emplace(p, static_cast<uint32_t>(points_.size()));
    if (isNew) {
      points_.push_back(p);
    }
    return it->second;
  }
  const std::vector<glm::dvec3>& points() const { return points_; }  // by number

 private:
  std::map<glm::dvec3, uint32_t, Less> numbers_;
  std::vector<glm::dvec3> points_;
};

}  // namespace speculum
