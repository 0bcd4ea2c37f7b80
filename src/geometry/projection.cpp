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

}  // namespace speculum
