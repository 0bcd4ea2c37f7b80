#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "geometry/projection.hpp"

namespace speculum {

// Bounds, in closed form, the distance at which a D32F depth buffer keeps two surfaces in order.
//
// Along the ray through a pixel, with u its unit direction, c = -u.z and r = (L, m) the depth row of the projection,
// depth is D(t) = L.u / c + m / (c t): near / (c t) for the common projection (L = 0, m = near), and for the oblique
// one a constant that no distance enters plus a h / (c t), where h is the eye's distance from the mirror. If the depth
// of each surface may be wrong by e, a gap s along the ray is kept in order when D(t) - D(t + s) > 2 e, that is from
//   s = 2 e t^2 / (m / c - 2 e t)
// on, and never when m / c <= 2 e t. For the common projection e is a part of D itself, and s / t does not depend on t;
// for the oblique one e is a part of a constant, and s = 2 e c t^2 / (a h), which grows without bound as h shrinks.
//
// The error e is the sum of three terms; r(x) is half a unit in the last place of a float at x.
// - Storage: r(D).
// - Rounding. Clip x, y and w are linear in the position, so that wrong ones belong to a vertex moved by d, with
//   |d_i| <= 6 r(E) + 3 r(|p_i|): five roundings of the products and sums of a matrix and a vertex at most E from its
//   mesh's centre, one of the centre's own position, and three of the sum's (the centre, the last addition, a vertex
//   that clipping adds). That moves the surface by n.d / n.u along the ray; z, which does not move with it, is wrong by
//   L.d and its own rounding. For the common projection z is `near` exactly. Division and depth's viewport add 2 r(D);
//   window coordinates and the plane equation of the rasteriser are good to four roundings of a coordinate of the
//   picture, times the slope of depth on the screen. On that slope: with q = (x, y, -1) of a pixel, depth on the
//   surface n.p = k is L.q + m n.q / k.
// - Snapping of vertices to 1/256 pixel (VkPhysicalDeviceLimits::subPixelPrecisionBits is 8 on common devices): half a
//   step in x and in y, times that slope. Two surfaces whose vertices project to the same points are snapped
//   alike and do without this term; a rasteriser may also interpolate between vertices where they were.
//
// Sources: Lapidous, Jiao, "Optimal Depth Buffer for Low-Cost Graphics Hardware" (1999); Upchurch, Desbrun, "Tightening
// the Precision of Perspective Rendering" (2012); Lengyel (2005), see obliqueProjection; Higham, "Accuracy and
// Stability of Numerical Algorithms" (2002), 3.1, for sums of products. The terms are added up, not squared.

// A picture and its projection. `plane` is the plane of obliqueProjection(); none for the common projection.
struct DepthProjection {
  Projection projection;
  std::optional<glm::dvec4> plane;
  glm::dvec2 pictureSize{0.0};  // pixels
};

// A point of the nearer of two parallel surfaces. View space, metres.
struct DepthSurface {
  glm::dvec3 point{0.0};
  glm::dvec3 normal{0.0, 0.0, 1.0};  // unit length, either side
  double extent = 0.0;               // largest distance of a vertex from its mesh's centre
};

// Gaps in metres along the ray; nothing where no gap is kept in order, or where the projection does not exist.
struct DepthResolution {
  std::optional<double> storage;  // if only the stored depth were rounded
  std::optional<double> rounded;  // with the rounding of vertices and of interpolation
  std::optional<double> snapped;  // and with vertices snapped to 1/256 pixel: holds for any two surfaces
};

// Returns the smallest gaps behind the surface's point that the depth buffer keeps in order.
DepthResolution depthResolution(const DepthProjection& view, const DepthSurface& surface);

// Returns the largest DepthResolution::snapped of surfaces at `point` that are tilted by `angle` (radians) away from
// the eye, over 16 directions of tilt.
std::optional<double> resolvableGap(const DepthProjection& view, const glm::dvec3& point, double angle, double extent);

}  // namespace speculum
