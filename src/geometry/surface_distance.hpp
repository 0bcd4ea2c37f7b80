#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "geometry/bvh.hpp"

namespace speculum {

// Distances from points to a set of triangles, in the unit of their corners.
class SurfaceDistance {
 public:
  // Three corners a triangle.
  explicit SurfaceDistance(const std::vector<glm::dvec3>& corners);

  // Says whether a triangle is no farther away than `distance`.
  bool within(const glm::dvec3& point, double distance) const;
  // Distance to the nearest triangle; infinite without any.
  double to(const glm::dvec3& point) const { return std::sqrt(nearest(point, -1.0)); }

 private:
  // Returns the square of the least distance, or of the first one found that is no more than `enough`, a square too.
  double nearest(const glm::dvec3& point, double enough) const;

  Bvh bvh_;
  std::vector<glm::dvec3> corners_;  // in the order of the leaves
};

}  // namespace speculum
