#pragma once

#include <algorithm>

#include "geometry/polygon.hpp"
#include "scene/scene_state.hpp"

namespace speculum {

// Returns how far, in metres, rounding can put what lies in the mirror's plane from it.
inline double planeSlack(const MirrorState& mirror) {
  const glm::dvec3 center = vertexMean(mirror.polygon);
  double radius = 0.0;
  for (const glm::dvec3& p : mirror.polygon) {
    radius = std::max(radius, glm::length(p - center));
  }
  return 1e-9 * radius + 1e-15 * glm::length(center);
}

}  // namespace speculum
