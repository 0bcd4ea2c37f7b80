#include "geometry/projection.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/polygon.hpp"

namespace speculum {

namespace {

constexpr double eyePlane = 1e-12;
constexpr double shortestEdge = 1e-6;    // pixels; the direction of a shorter edge is rounding
constexpr double sharpestCorner = 0.25;  // 1 + the cosine of the angle between the normals of a corner's edges

glm::dvec2 toPixels(const glm::dvec4& clip, double width, double height) {
  return {(clip.x / clip.w * 0.5 + 0.5) * width, (clip.y / clip.w * 0.5 + 0.5) * height};
}

std::vector<glm::dvec2> cornersOf(std::span<const glm::dvec4> clip, double width, double height) {
  std::vector<glm::dvec2> corners;
  corners.reserve(clip.size());
  for (const glm::dvec4& v : clip) {
    corners.push_back(toPixels(v, width, height));
  }
  return corners;
}

bool touchesEyePlane(std::span<const glm::dvec4> clip) {
  return std::ranges::any_of(clip, [](const glm::dvec4& v) { return !(v.w > eyePlane); });
}

// Returns start and end in pixels, rounded outwards and padded. Clamps before the conversion to int, because a vertex
// may project to any double.
std::pair<int, int> paddedRange(double low, double high, int start, int size) {
  const double end = static_cast<double>(start) + size;
  const double from = std::clamp(std::floor(low) - 1.0, static_cast<double>(start), end);
  const double to = std::clamp(std::ceil(high) + 1.0, static_cast<double>(start), end);
  return {static_cast<int>(from), static_cast<int>(to)};
}

double sign(double x) {
  return x < 0.0 ? -1.0 : 1.0;
}

glm::dvec3 homogeneous(const glm::dvec4& v) {
  return {v.x, v.y, v.w};
}

// Returns on which side of the line a vertex lies, and how far; 0 within rounding, so that cuts repeat no vertex.
double sideOf(const glm::dvec3& line, const glm::dvec4& v) {
  const glm::dvec3 p = homogeneous(v);
  const double distance = glm::dot(line, p);
  return std::abs(distance) > 1e-13 * glm::length(line) * glm::length(p) ? distance : 0.0;
}

bool reaches(std::span<const glm::dvec4> polygon, const glm::dvec3& line) {
  return std::ranges::any_of(polygon, [&](const glm::dvec4& v) { return sideOf(line, v) > 0.0; });
}

// Returns the part of a polygon on the positive side of a line.
std::vector<glm::dvec4> cutBy(std::span<const glm::dvec4> polygon, const glm::dvec3& line) {
  std::vector<glm::dvec4> kept;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec4& v = polygon[i];
    const glm::dvec4& next = polygon[(i + 1) % polygon.size()];
    const double from = sideOf(line, v);
    const double to = sideOf(line, next);
    if (from >= 0.0) {
      kept.push_back(v);
    }
    if ((from > 0.0 && to < 0.0) || (from < 0.0 && to > 0.0)) {
      kept.push_back(glm::mix(v, next, from / (from - to)));
    }
  }
  return kept;
}

// Returns the lines of the polygon's edges, positive inside; none if it is no wider than rounding.
std::vector<glm::dvec3> edgeLines(std::span<const glm::dvec4> polygon) {
  glm::dvec3 inside(0.0);
  for (const glm::dvec4& v : polygon) {
    inside += homogeneous(v);
  }
  std::vector<glm::dvec3> lines;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3 a = homogeneous(polygon[i]);
    const glm::dvec3 b = homogeneous(polygon[(i + 1) % polygon.size()]);
    const glm::dvec3 line = glm::cross(a, b);
    // Rounding would give an edge that is too short any direction.
    if (glm::length(line) > 1e-13 * glm::length(a) * glm::length(b)) {
      const double distance = glm::dot(line, inside);
      if (!(std::abs(distance) > 1e-13 * glm::length(line) * glm::length(inside))) {
        return {};
      }
      lines.push_back(line * sign(distance));
    }
  }
  return lines;
}

constexpr double snappingStep = 1.0 / 256.0;  // pixels

// Returns half a unit in the last place of a float at x.
double rounding(double x) {
  return x == 0.0 || !std::isfinite(x) ? 0.0 : std::ldexp(1.0, std::ilogb(x) - 24);
}

glm::dvec3 roundings(const glm::dvec3& v) {
  return {rounding(v.x), rounding(v.y), rounding(v.z)};
}

// Bounds of the error of one surface's depth.
struct DepthErrors {
  double storage = 0.0;
  double rounding = 0.0;
  double snapping = 0.0;
};

struct EyeRay {
  double distance;  // t
  double w;         // c t
  double depth;
  double change;  // m / c: depth is a constant plus change / distance
};

DepthErrors errorsOf(const DepthProjection& view, const DepthSurface& surface, const glm::dvec4& row,
                     const EyeRay& ray) {
  const glm::dvec3& p = surface.point;
  const glm::dvec3 n = glm::abs(surface.normal);
  const glm::dvec3 gradient(row);
  const double k = glm::dot(surface.normal, p);
  const Projection& f = view.projection;
  const glm::dvec2 pixelStep = 2.0 / view.pictureSize * glm::dvec2(f.aspect / f.focal, 1.0 / f.focal);
  const glm::dvec2 slope =
      glm::abs(glm::dvec2(gradient) + row.w / k * glm::dvec2(surface.normal)) * pixelStep;  // per pixel
  const glm::dvec3 moved = 6.0 * rounding(surface.extent) + 3.0 * roundings(p);
  const double along = glm::dot(n, moved) * ray.distance / std::abs(k);
  const double z = gradient == glm::dvec3(0.0)
                       ? 0.0
                       : glm::dot(glm::abs(gradient), moved) + 6.0 * rounding(glm::length(gradient) * surface.extent) +
                             2.0 * rounding(ray.depth * ray.w);
  const glm::dvec2 window(rounding(view.pictureSize.x), rounding(view.pictureSize.y));
  DepthErrors errors;
  errors.storage = rounding(ray.depth);
  errors.rounding = ray.change / (ray.distance * ray.distance) * along + z / ray.w + 2.0 * rounding(ray.depth) +
                    4.0 * glm::dot(slope, window);
  errors.snapping = 0.5 * snappingStep * (slope.x + slope.y);
  return errors;
}

std::optional<double> gap(const EyeRay& ray, double error) {
  const double left = ray.change - 2.0 * error * ray.distance;
  if (!(left > 0.0)) {
    return std::nullopt;
  }
  const double s = 2.0 * error * ray.distance * ray.distance / left;
  return std::isfinite(s) ? std::optional(s) : std::nullopt;
}

// Returns the row of the projection that gives clip z; nothing if the projection does not exist.
std::optional<glm::dvec4> depthRow(const DepthProjection& view) {
  if (!view.plane) {
    return glm::dvec4(0.0, 0.0, 0.0, view.projection.near);
  }
  const std::optional<glm::dmat4> m = obliqueProjection(view.projection, *view.plane);
  return m ? std::optional(glm::transpose(*m)[2]) : std::nullopt;
}

}  // namespace

Projection::Projection(double verticalFovRadians, double aspectRatio, double nearMetres)
    : focal(1.0 / std::tan(0.5 * verticalFovRadians)), aspect(aspectRatio), near(nearMetres) {}

glm::dmat4 Projection::matrix() const {
  glm::dmat4 m(0.0);
  m[0][0] = focal / aspect;
  m[1][1] = -focal;
  m[2][0] = -offset.x;
  m[2][1] = -offset.y;
  m[3][2] = near;
  m[2][3] = -1.0;
  return m;
}

glm::dvec4 Projection::clip(const glm::dvec3& view) const {
  return {focal / aspect * view.x - offset.x * view.z, -focal * view.y - offset.y * view.z, near, -view.z};
}

std::optional<glm::dmat4> obliqueProjection(const Projection& projection, const glm::dvec4& plane) {
  glm::dmat4 m = projection.matrix();
  // Corner of the frustum opposite the plane, at infinity (depth 0), in view space: P^-1 (sx, sy, 0, 1).
  const double cx = sign(plane.x / m[0][0]);
  const double cy = sign(plane.y / m[1][1]);
  const glm::dvec4 corner((cx - projection.offset.x) / m[0][0], (cy - projection.offset.y) / m[1][1], -1.0, 0.0);
  const double reach = glm::dot(plane, corner);
  if (!(plane.w < 0.0) || !(reach > 0.0)) {
    return std::nullopt;
  }
  const double a = 1.0 / reach;
  for (int column = 0; column < 4; ++column) {
    m[column][2] = m[column][3] - a * plane[column];
  }
  return m;
}

PixelRect intersect(const PixelRect& a, const PixelRect& b) {
  const int x0 = std::max(a.x, b.x);
  const int y0 = std::max(a.y, b.y);
  const int x1 = std::min(a.x + a.width, b.x + b.width);
  const int y1 = std::min(a.y + a.height, b.y + b.height);
  return {x0, y0, std::max(0, x1 - x0), std::max(0, y1 - y0)};
}

PixelRect screenRect(std::span<const glm::dvec4> clip, double width, double height, const PixelRect& bounds) {
  if (clip.empty()) {
    return {bounds.x, bounds.y, 0, 0};
  }
  if (touchesEyePlane(clip)) {
    return bounds;
  }
  glm::dvec2 low(1e300);
  glm::dvec2 high(-1e300);
  for (const glm::dvec4& v : clip) {
    const glm::dvec2 p = toPixels(v, width, height);
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const auto [x0, x1] = paddedRange(low.x, high.x, bounds.x, bounds.width);
  const auto [y0, y1] = paddedRange(low.y, high.y, bounds.y, bounds.height);
  return {x0, y0, x1 - x0, y1 - y0};
}

double screenArea(std::span<const glm::dvec4> clip, double width, double height) {
  if (clip.size() < 3) {
    return 0.0;
  }
  if (touchesEyePlane(clip)) {
    return width * height;
  }
  const double twice = twiceArea(clip.size(), [&](size_t i) { return toPixels(clip[i], width, height); });
  return std::min(0.5 * std::abs(twice), width * height);
}

std::vector<glm::dvec4> grown(std::span<const glm::dvec4> clip, double width, double height, double pixels) {
  std::vector<glm::dvec4> moved(clip.begin(), clip.end());
  if (touchesEyePlane(clip)) {
    return moved;
  }
  const size_t n = clip.size();
  const std::vector<glm::dvec2> corners = cornersOf(clip, width, height);
  const double side = sign(twiceArea(corners));
  const auto outward = [&](size_t edge) {
    const glm::dvec2 along = corners[(edge + 1) % n] - corners[edge];
    const double length = glm::length(along);
    return length > shortestEdge ? side / length * glm::dvec2(along.y, -along.x) : glm::dvec2(0.0);
  };
  for (size_t i = 0; i < n; ++i) {
    const glm::dvec2 before = outward((i + n - 1) % n);
    const glm::dvec2 after = outward(i);
    const glm::dvec2 sum = before + after;
    const double share = std::max({glm::dot(sum, before), glm::dot(sum, after), sharpestCorner});
    const glm::dvec2 step = pixels / share * sum * 2.0 / glm::dvec2(width, height) * clip[i].w;
    moved[i] += glm::dvec4(step, 0.0, 0.0);
  }
  return moved;
}

void cutAway(std::vector<std::vector<glm::dvec4>>& parts, std::span<const glm::dvec4> cover) {
  const std::vector<glm::dvec3> lines = edgeLines(cover);
  if (lines.size() < 3) {
    return;
  }
  std::vector<std::vector<glm::dvec4>> left;
  for (std::vector<glm::dvec4>& part : parts) {
    if (!std::ranges::all_of(lines, [&](const glm::dvec3& line) { return reaches(part, line); })) {
      left.push_back(std::move(part));
      continue;
    }
    for (const glm::dvec3& line : lines) {
      if (reaches(part, -line)) {
        left.push_back(cutBy(part, -line));
        part = cutBy(part, line);
      }
    }
  }
  parts = std::move(left);
}

DepthResolution depthResolution(const DepthProjection& view, const DepthSurface& surface) {
  const std::optional<glm::dvec4> row = depthRow(view);
  const double w = -surface.point.z;
  if (!row || !(w > 0.0) || glm::dot(surface.normal, surface.point) == 0.0) {
    return {};
  }
  const double distance = glm::length(surface.point);
  const double depth = glm::dot(*row, glm::dvec4(surface.point, 1.0)) / w;
  if (!(depth < 1.0)) {
    return {};
  }
  const EyeRay ray{.distance = distance, .w = w, .depth = std::max(depth, 0.0), .change = row->w * distance / w};
  const DepthErrors e = errorsOf(view, surface, *row, ray);
  return {.storage = gap(ray, e.storage),
          .rounded = gap(ray, e.storage + e.rounding),
          .snapped = gap(ray, e.storage + e.rounding + e.snapping)};
}

std::optional<double> resolvableGap(const DepthProjection& view, const glm::dvec3& point, double angle, double extent) {
  constexpr int directions = 16;
  const glm::dvec3 toEye = -glm::normalize(point);
  const glm::dvec3 side =
      glm::normalize(glm::cross(toEye, std::abs(toEye.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0)));
  const glm::dvec3 up = glm::cross(side, toEye);
  double worst = 0.0;
  for (int i = 0; i < directions; ++i) {
    const double turn = glm::radians(360.0 * i / directions);
    const glm::dvec3 tilt = std::cos(turn) * side + std::sin(turn) * up;
    const glm::dvec3 normal = std::cos(angle) * toEye + std::sin(angle) * tilt;
    const std::optional<double> gap = depthResolution(view, {point, normal, extent}).snapped;
    if (!gap) {
      return std::nullopt;
    }
    worst = std::max(worst, *gap);
  }
  return worst;
}

}  // namespace speculum
