#pragma once

#include <optional>

#include "geometry/convex_mesh.hpp"
#include "geometry/recycled_memory.hpp"
#include "plan/view.hpp"

namespace speculum {

// The points with dot(gradient, v) + constant > 0, where v is the vector from the eye to the point.
struct HalfSpace {
  glm::dvec3 gradient{0.0};  // per metre
  double constant = 0.0;

  double at(const glm::dvec3& fromEye) const { return glm::dot(gradient, fromEye) + constant; }
};

// The points that an occluder certainly hides from a view's eye, as the intersection of half spaces: farther than the
// depth test can confuse, and within the occluder's outline by more than a pixel and the rounding of floats.
//
// Each half space is bounded by the plane through the eye and an edge of the outline, moved inwards by that margin. The
// triangles that face the eye cover a point of the picture as often as their common outline winds around it. The
// outline runs counter-clockwise; a point on the left of all its edges is wound around at least once, and so is
// covered, whatever the occluder's shape. An occluder that is not convex hides only the intersection of its half
// spaces.
using OccludedRegion = RecycledVector<HalfSpace>;

// A flat polygon in world space, counter-clockwise as seen from the side to which the normal of its plane points.
struct FlatOccluder {
  Polygon polygon;  // neighbours are more than `slack` / 100 apart
  Plane plane;
  double slack = 0.0;      // metres by which rounding on the GPU may move the polygon
  glm::dvec3 center{0.0};  // centre of a sphere around the polygon
  double radius = 0.0;     // of that sphere, metres
};

// Finds the region behind a flat occluder. Returns false, and leaves `region` without meaning, if the view sees the
// occluder edge-on or narrower than the margin, or clips it away.
bool hiddenByFace(const FlatOccluder& occluder, const View& view, const Projection& projection, OccludedRegion& region);

// Returns the width, for each metre of depth along the view's axis, up to which a face is too narrow for
// hiddenByFace(). A part of the face is no wider.
double narrowestFace(const View& view, const Projection& projection);

// A closed mesh that is about convex, world space.
struct BodyOccluder {
  const ConvexMesh* mesh = nullptr;    // null: nothing hides
  RecycledVector<glm::dvec3> points;   // the mesh's points in world space
  RecycledVector<glm::dvec3> normals;  // normals of the mesh's triangles, of any length
  double slack = 0.0;                  // metres by which rounding on the GPU may move the points
};

// Region behind a body. The body hides a point within `outline` if the point lies on a plane for which isBefore() is
// true, or within `beyond`.
struct BodyRegion {
  OccludedRegion outline;
  HalfSpace beyond;
};
// Returns nothing if a part of the body is clipped away.
std::optional<BodyRegion> hiddenByBody(const BodyOccluder& body, const View& view, const Projection& projection);

// Says whether the whole body is nearer to the eye than the plane of `target`.
bool isBefore(const BodyOccluder& body, const FlatOccluder& target, const glm::dvec3& eye);

// Cuts a region, or the part of it in the half space `also` (null: all of it), out of convex polygons (world space) and
// returns the convex pieces that are left.
RecycledVector<Polygon> outside(const OccludedRegion& region, const HalfSpace* also, const glm::dvec3& eye,
                                const RecycledVector<Polygon>& polygons);

}  // namespace speculum
