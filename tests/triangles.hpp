#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace speculum {

// Triangles of tests, in which neighbours share positions but no vertices.
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

}  // namespace speculum
