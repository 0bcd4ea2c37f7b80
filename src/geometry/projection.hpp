#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

namespace speculum {

// Perspective projection to Vulkan clip space (y down, depth 0..1), reversed Z with the far plane at infinity: depth is
// near / distance, so its relative resolution is the same at every distance. View space is right-handed, looking down
// -z. x_clip = focal / aspect * x + offset.x * w_clip, y_clip = -focal * y + offset.y * w_clip, z_clip = near,
// w_clip = -z.
struct Projection {
  double focal = 1.0;      // cot(vertical fov / 2)
  double aspect = 1.0;     // width / height
  double near = 0.001;     // metres
  glm::dvec2 offset{0.0};  // shift of the picture, in device coordinates

  Projection() = default;
  Projection(double verticalFovRadians, double aspectRatio, double nearMetres);
  glm::dmat4 matrix() const;
  glm::dvec4 clip(const glm::dvec3& view) const;  // of a point in view space
  bool operator==(const Projection&) const = default;
};

// Returns the projection with its depth row replaced so that z_clip > w_clip exactly behind `plane` (view space, (n, d)
// with n.x + d >= 0 kept): Lengyel, "Oblique View Frustum Depth Projection and Clipping" (2005), for reversed Z.
// Returns nothing when this projection does not exist: the eye is on the kept side, or the plane misses the frustum.
// For comparison only: the depth resolution of this projection vanishes as the eye nears the plane.
std::optional<glm::dmat4> obliqueProjection(const Projection& projection, const glm::dvec4& plane);

// A rectangle of pixels, origin top left.
struct PixelRect {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;

  bool empty() const { return width <= 0 || height <= 0; }
  bool contains(int px, int py) const { return px >= x && py >= y && px < x + width && py < y + height; }
  double area() const { return empty() ? 0.0 : static_cast<double>(width) * height; }
  bool operator==(const PixelRect&) const = default;
};

PixelRect intersect(const PixelRect& a, const PixelRect& b);

// The three functions below take a polygon's vertices in clip space, already clipped to w+x, w-x, w+y, w-y >= 0, and
// the picture's size in pixels.

// Pixels that the polygon may touch, rounded outwards and padded by one pixel, within `bounds`. All of `bounds` if a
// vertex is in the eye's plane (w <= 1e-12), where no division is meaningful.
PixelRect screenRect(std::span<const glm::dvec4> clip, double width, double height, const PixelRect& bounds);

// Area in square pixels; that of the picture if a vertex is in the eye's plane.
double screenArea(std::span<const glm::dvec4> clip, double width, double height);

// The polygon with its edges moved outwards by `pixels`; every vertex keeps its z and w. An acute corner moves less
// than its edges would take it; a polygon with a vertex in the eye's plane stays as it is.
std::vector<glm::dvec4> grown(std::span<const glm::dvec4> clip, double width, double height, double pixels);

// Cuts away from `parts`, convex polygons in the plane of `cover`, what the convex polygon `cover` covers: they become
// more and smaller convex parts. Vertices are in clip space, with w >= 0; new vertices have interpolated depth.
void cutAway(std::vector<std::vector<glm::dvec4>>& parts, std::span<const glm::dvec4> cover);

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
