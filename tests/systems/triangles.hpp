#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "geometry/mesh.hpp"

namespace speculum {

// Triangles for tests, in which neighbours share positions but no vertices.
struct Triangles {
  std::vector<glm::dvec3> positions;
  std::vector<uint32_t> indices;

  void triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    for (const glm::dvec3& p : {a, b, c}) {
      indices.push_back(static_cast<uint32_t>(positions.size()));
      positions.push_back(p);
    }
  }
  void quad(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
    const auto first = static_cast<uint32_t>(positions.size());
    positions.insert(positions.end(), {a, b, c, d});
    for (const uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) {
      indices.push_back(first + i);
    }
  }
  void box(const glm::dvec3& low, const glm::dvec3& high) {
    const auto p = [&](int i) {
      return glm::dvec3(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
    };
    quad(p(4), p(5), p(7), p(6));
    quad(p(1), p(0), p(2), p(3));
    quad(p(0), p(4), p(6), p(2));
    quad(p(5), p(1), p(3), p(7));
    quad(p(6), p(7), p(3), p(2));
    quad(p(0), p(1), p(5), p(4));
  }
};

// A sheet of side x side squares, row by row, with its vertices at place(x, y), 0 .. side each, and without parts.
template <typename Place>
Mesh sheetOf(uint32_t side, const Place& place) {
  Mesh mesh;
  for (uint32_t i = 0; i < (side + 1) * (side + 1); ++i) {
    const uint32_t x = i % (side + 1);
    const uint32_t y = i / (side + 1);
    mesh.vertices.push_back({place(x, y), {0, 0, 1}, {}});
    if (x < side && y < side) {
      mesh.indices.insert(mesh.indices.end(), {i, i + 1, i + side + 2, i, i + side + 2, i + side + 1});
    }
  }
  return mesh;
}

}  // namespace speculum
