#include "scene/beside_mirrors.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/polygon.hpp"

namespace speculum {

namespace {

// Floats round by 6e-8. Rays come from points up to about a hundred times as far from the eye as the light.
double floatRounding(const glm::dvec3& light, const MirrorState& mirror, const glm::dvec3& eye) {
  return 4e-6 * glm::length(light - eye) + 5e-7 * glm::length(light - mirror.origin);
}

}  // namespace

glm::dvec3 besideMirrors(const glm::dvec3& light, std::span<const MirrorState> mirrors,
                         const std::optional<glm::dvec3>& eye) {
  std::vector<Plane> planes;  // that are near, facing the light
  double away = 0.0;          // metres
  for (size_t i = 0; i < mirrors.size(); ++i) {
    const MirrorState& mirror = mirrors[i];
    const double height = glm::dot(mirror.normal, light - mirror.origin);
    const double distance = std::max(mirror.slack, eye ? floatRounding(light, mirror, *eye) : 0.0);
    if (mirror.plane == static_cast<int>(i) && std::abs(height) <= distance) {
      planes.push_back({mirror.origin, height < -mirror.slack ? -mirror.normal : mirror.normal});
      away = std::max(away, distance);
    }
  }
  // Moving to each plane in turn (Kaczmarz's method) brings the point to the same distance from all of them. Where
  // distances differ, rounding would decide which mirrors the light reaches by way of others.
  glm::dvec3 point = light;
  for (int turn = 0; turn < 50; ++turn) {
    for (const Plane& plane : planes) {
      point += (away - plane.distance(point)) * plane.normal;
    }
  }
  return point;
}

}  // namespace speculum
