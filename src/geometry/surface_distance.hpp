#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace speculum {

// Distances from points to a set of triangles, by a hierarchy of boxes. In the unit of the corners.
class SurfaceDistance {
 public:
  // Three corners a triangle.
  explicit SurfaceDistance(std::vector<glm::dvec3> corners);

  // Whether any triangle is as near as that.
  bool within(const glm::dvec3& point, double distance) const;
  // To the nearest triangle; infinite without any.
  double to(const glm::dvec3& point) const;

 private:
  struct Node {
    glm::dvec3 low{0.0};
    glm::dvec3 high{0.0};
    uint32_t first = 0;  // triangle of a leaf; of an inner node the second child, the first stands behind the node
    uint32_t count = 0;  // triangles of a leaf; 0: an inner node
  };
  uint32_t build(std::span<uint32_t> triangles, uint32_t first, const std::vector<glm::dvec3>& corners);
  // The square of the least distance below `best`, a square too; ends at the first that is no more than `enough`.
  double nearest(const glm::dvec3& point, double best, double enough) const;

  std::vector<glm::dvec3> corners_;  // in the order of the leaves
  std::vector<Node> nodes_;
};

}  // namespace speculum
