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

}  // namespace speculum
