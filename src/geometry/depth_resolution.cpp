#include "geometry/depth_resolution.hpp"

#include <algorithm>
#include <cmath>

namespace speculum {

namespace {

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
