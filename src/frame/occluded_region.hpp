#pragma once

#include <optional>
#include <span>
#include <vector>

#include "frame/view.hpp"

namespace speculum {

// Where a linear function of the vector from the eye to a point is positive: dot(gradient, v) + constant.
struct HalfSpace {
  glm::dvec3 gradient{0.0};  // per metre
  double constant = 0.0;

  double at(const glm::dvec3& fromEye) const { return glm::dot(gradient, fromEye) + constant; }
};

// The points that an occluder certainly hides from a view's eye, as the intersection of half spaces: within its outline
// by more than the edges of pixels and rounding on the GPU can undo, and farther than the depth test can confuse.
using OccludedRegion = std::vector<HalfSpace>;

// A flat convex polygon, world space, and the plane through it.
struct FlatOccluder {
  std::vector<glm::dvec3> polygon;
  Plane plane;
  double slack = 0.0;      // metres by which it may stand elsewhere on the GPU
  glm::dvec3 center{0.0};  // of a sphere around it
  double radius = 0.0;
};

// Nothing if the polygon is seen edge-on or clipped away in the view.
std::optional<OccludedRegion> hiddenByFace(const FlatOccluder& occluder, const View& view,
                                           const Projection& projection);

// Behind a closed convex body with these vertices (world space): of points on `target`, if the whole body is nearer
// than its plane, else of whatever is deeper in the view than all of it. Nothing if a part of the body is clipped away.
std::optional<OccludedRegion> hiddenByBody(std::span<const glm::dvec3> vertices, double slack,
                                           const FlatOccluder& target, const View& view, const Projection& projection);

// What of convex polygons (world space) lies outside a region, in convex pieces.
std::vector<std::vector<glm::dvec3>> outside(const OccludedRegion& region, const glm::dvec3& eye,
                                             const std::vector<std::vector<glm::dvec3>>& polygons);

}  // namespace speculum
