#include "scene/mirror_layers.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/polygon.hpp"

namespace speculum {

namespace {

struct Placed {
  const Mirror* mirror = nullptr;
  MirrorState* state = nullptr;
  glm::dvec3 center{0.0};
  double radius = 0.0;  // metres; of the circle about the polygon
  double slack = 0.0;   // metres that rounding may move a vertex
};

Placed placedAs(const Mirror& mirror, MirrorState& state) {
  Placed placed{.mirror = &mirror, .state = &state, .center = vertexMean(state.polygon)};
  for (const glm::dvec3& p : state.polygon) {
    placed.radius = std::max(placed.radius, glm::length(p - placed.center));
  }
  placed.slack = 1e-9 * placed.radius + 1e-15 * glm::length(placed.center);
  return placed;
}

bool inOnePlane(const Placed& a, const Placed& b) {
  const Plane plane{a.state->polygon[0], a.state->normal};
  const double slack = std::max(a.slack, b.slack);
  return std::ranges::all_of(b.state->polygon, [&](const auto& p) { return std::abs(plane.distance(p)) <= slack; });
}

// Says whether the line through an edge of `a` separates `b` from `a`, except for `slack` metres.
bool edgeSeparates(const Placed& a, const Placed& b, double slack) {
  const std::vector<glm::dvec3>& polygon = a.state->polygon;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3 outward = glm::cross(polygon[(i + 1) % polygon.size()] - polygon[i], a.state->normal);
    const double length = glm::length(outward);
    const auto outside = [&](const auto& p) { return glm::dot(outward, p - polygon[i]) >= -slack * length; };
    if (length > 0.0 && std::ranges::all_of(b.state->polygon, outside)) {
      return true;
    }
  }
  return false;
}

bool overlap(const Placed& a, const Placed& b) {
  const double slack = std::max(a.slack, b.slack);
  return glm::distance(a.center, b.center) < a.radius + b.radius && !edgeSeparates(a, b, slack) &&
         !edgeSeparates(b, a, slack);
}

// Sets the layers of the mirrors of one plane for an eye on one side of it.
void setLayers(std::vector<Placed>& plane, const glm::dvec3& towardsEye) {
  const auto front = [&](const Placed& p) { return glm::dot(p.state->normal, towardsEye) > 0.0; };
  const auto layer = [&](const Placed& p) -> int& { return front(p) ? p.state->frontLayer : p.state->backLayer; };
  const auto showsBack = [&](const Placed& p) { return !front(p) && !p.mirror->twoSided; };
  std::ranges::sort(plane, {}, [&](const Placed& p) { return std::pair(showsBack(p), p.mirror); });
  for (size_t i = 1; i < plane.size(); ++i) {
    for (size_t before = 0; before < i; ++before) {
      if (layer(plane[before]) >= layer(plane[i]) && overlap(plane[before], plane[i])) {
        layer(plane[i]) = layer(plane[before]) + 1;
      }
    }
  }
}

}  // namespace

void findLayers(std::span<const Mirror> mirrors, std::span<MirrorState> states) {
  std::vector<std::vector<Placed>> planes;
  for (size_t i = 0; i < states.size(); ++i) {
    states[i].plane = static_cast<int>(i);
    const Placed placed = placedAs(mirrors[i], states[i]);
    const auto same = std::ranges::find_if(planes, [&](const auto& plane) { return inOnePlane(plane[0], placed); });
    if (same == planes.end()) {
      planes.push_back({placed});
    } else {
      states[i].plane = static_cast<int>((*same)[0].mirror - mirrors.data());
      same->push_back(placed);
    }
  }
  for (std::vector<Placed>& plane : planes) {
    if (plane.size() > 1) {
      const glm::dvec3 normal = plane[0].state->normal;
      setLayers(plane, normal);
      setLayers(plane, -normal);
    }
  }
}

}  // namespace speculum
