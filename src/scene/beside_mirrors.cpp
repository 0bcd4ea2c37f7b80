#include "scene/beside_mirrors.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/polygon.hpp"

namespace speculum {

namespace {

constexpr double thinnestWedge = 0.01;  // sine of the angle between two planes
constexpr double farthest = 100.0;      // from the light, in distances from the planes

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
  // The same distance from all of them: where distances differ, rounding would decide which mirrors the light reaches
  // by way of others. Each step keeps the distances from the planes before it, for up to three planes.
  glm::dvec3 point = light;
  std::vector<glm::dvec3> taken;  // orthonormal
  for (const Plane& plane : planes) {
    glm::dvec3 step = plane.normal;
    for (const glm::dvec3& direction : taken) {
      step -= glm::dot(step, direction) * direction;
    }
    const double length2 = glm::dot(step, step);
    if (length2 > thinnestWedge * thinnestWedge) {
      point += (away - plane.distance(point)) / length2 * step;
      taken.push_back(step / std::sqrt(length2));
    }
  }
  const bool tooFar = glm::distance(point, light) > farthest * away;
  point = tooFar ? light : point;
  // For more planes, or where they leave hardly any room, moving to each in turn (Kaczmarz's method) is a compromise.
  for (int turn = 0; (tooFar || taken.size() < planes.size()) && turn < 50; ++turn) {
    for (const Plane& plane : planes) {
      point += (away - plane.distance(point)) * plane.normal;
    }
  }
  return point;
}

}  // namespace speculum
