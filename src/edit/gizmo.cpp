#include "edit/gizmo.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/affine.hpp"

namespace speculum {

namespace {

constexpr int ringSteps = 72;
// Shares of the arm.
constexpr double axisStart = 0.14;  // keeps the middle free
constexpr double planeNear = 0.32;  // where a plane's square begins and ends
constexpr double planeFar = 0.56;
constexpr double centerRadius = 0.076;  // of the handle of the view's plane
constexpr double headLength = 0.163;    // of an arrow
constexpr double boxHalf = 0.06;        // half a side of the head of a handle that scales
constexpr double leastFactor = 0.01;    // of one drag
// Sines of the angle between eye and axis, or eye and plane, below which a handle cannot be grabbed.
constexpr double steepestAxis = 0.15;
constexpr double flattestPlane = 0.12;
constexpr double flattestRing = 0.15;  // below it, turning counts pixels along the ring's edge

constexpr std::array moveAxes = {Grip::moveX, Grip::moveY, Grip::moveZ};
constexpr std::array scaleAxes = {Grip::scaleX, Grip::scaleY, Grip::scaleZ};
constexpr std::array movePlanes = {Grip::moveYZ, Grip::moveZX, Grip::moveXY};
constexpr std::array rings = {Grip::turnX, Grip::turnY, Grip::turnZ};

bool isRing(Grip handle) {
  return modeOf(handle) == GizmoMode::turn;
}

glm::dvec3 unit(int axis) {
  return glm::dmat3(1.0)[axis];
}

glm::dvec3 towards(const PictureView& picture, const glm::dvec3& pivot) {
  return glm::normalize(pivot - picture.eye());
}

glm::dvec3 ringPoint(const glm::dvec3& pivot, int axis, double radius, int step) {
  const double angle = 2.0 * std::numbers::pi * step / ringSteps;
  return pivot + radius * (std::cos(angle) * unit((axis + 1) % 3) + std::sin(angle) * unit((axis + 2) % 3));
}

void addLine(GizmoShape& shape, const std::optional<PixelLine>& line) {
  if (line) {
    shape.points.insert(shape.points.end(), {line->a, line->b});
  }
}

// Returns a filled polygon; nothing if the picture cannot show a corner.
std::optional<GizmoShape> filled(const PictureView& picture, Grip handle, std::span<const glm::dvec3> corners) {
  GizmoShape shape{.handle = handle, .filled = true};
  for (const glm::dvec3& corner : corners) {
    const auto pixel = picture.pixel(corner);
    if (!pixel) {
      return std::nullopt;
    }
    shape.points.push_back(*pixel);
  }
  return shape;
}

double distanceTo(const PixelLine& line, const glm::dvec2& p) {
  const glm::dvec2 along = line.b - line.a;
  const double length2 = glm::dot(along, along);
  const double t = length2 > 0.0 ? std::clamp(glm::dot(p - line.a, along) / length2, 0.0, 1.0) : 0.0;
  return glm::distance(p, line.a + t * along);
}

bool contains(std::span<const glm::dvec2> convex, const glm::dvec2& p) {
  bool left = false;
  bool right = false;
  for (size_t i = 0; i < convex.size(); ++i) {
    const double side = cross(convex[(i + 1) % convex.size()] - convex[i], p - convex[i]);
    left = left || side > 0.0;
    right = right || side < 0.0;
  }
  return !(left && right);
}

double distanceTo(const GizmoShape& shape, const glm::dvec2& p) {
  if (shape.filled) {
    return contains(shape.points, p) ? 0.0 : std::numeric_limits<double>::infinity();
  }
  double nearest = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i + 1 < shape.points.size(); i += 2) {
    nearest = std::min(nearest, distanceTo({shape.points[i], shape.points[i + 1]}, p));
  }
  return nearest;
}

// Returns the largest power of ten that is at most a tenth of `value`.
double grain(double value) {
  return std::pow(10.0, std::floor(std::log10(0.1 * value)));
}

// Rounds to a multiple of `step`. For steps below 1 divides by 1 / step, which gives the double nearest to the decimal
// number.
double rounded(double value, double step) {
  return step < 1.0 ? std::round(value / step) / std::round(1.0 / step) : std::round(value / step) * step;
}

void addBox(Grip handle, const glm::dvec2& center, double half, std::vector<GizmoShape>& shapes) {
  shapes.push_back({.handle = handle,
                    .points = {center + glm::dvec2(-half, -half), center + glm::dvec2(half, -half),
                               center + glm::dvec2(half, half), center + glm::dvec2(-half, half)},
                    .filled = true});
}

// Adds a line with a head: a box for scaling, else an arrow's. `pixels`: length of the arm as it faces the eye.
void addShaft(const PictureView& picture, const glm::dvec3& pivot, const glm::dvec3& arm, double pixels, Grip handle,
              std::vector<GizmoShape>& shapes) {
  GizmoShape shaft{.handle = handle};
  addLine(shaft, picture.line(pivot + axisStart * arm, pivot + arm));
  const auto tail = picture.pixel(pivot);
  const auto tip = picture.pixel(pivot + arm);
  shapes.push_back(std::move(shaft));
  if (!tail || !tip || glm::distance(*tail, *tip) < 1.0) {
    return;
  }
  if (modeOf(handle) == GizmoMode::scale) {
    return addBox(handle, *tip, boxHalf * pixels, shapes);
  }
  const glm::dvec2 along = glm::normalize(*tip - *tail);
  const glm::dvec2 across = 0.36 * headLength * pixels * glm::dvec2(-along.y, along.x);
  const glm::dvec2 end = *tip + headLength * pixels * along;
  shapes.push_back({.handle = handle, .points = {end, *tip + across, *tip - across}, .filled = true});
}

void addCenter(const glm::dvec2& center, double radius, std::vector<GizmoShape>& shapes) {
  GizmoShape circle{.handle = Grip::moveView, .filled = true};
  for (int i = 0; i < 20; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 20.0;
    circle.points.push_back(center + radius * glm::dvec2(std::cos(angle), std::sin(angle)));
  }
  shapes.push_back(std::move(circle));
}

void addRing(const PictureView& picture, const glm::dvec3& pivot, int axis, double radius,
             std::vector<GizmoShape>& shapes) {
  const glm::dvec3 sight = towards(picture, pivot);
  // A ring seen along its axis has no far half.
  const double depth = std::abs(glm::dot(sight, unit(axis))) < 0.98 ? 0.02 * radius : 2.0 * radius;
  GizmoShape front{.handle = rings[axis]};
  GizmoShape back{.handle = front.handle, .behind = true};
  for (int i = 0; i < ringSteps; ++i) {
    const glm::dvec3 a = ringPoint(pivot, axis, radius, i);
    const glm::dvec3 b = ringPoint(pivot, axis, radius, i + 1);
    addLine(glm::dot(0.5 * (a + b) - pivot, sight) > depth ? back : front, picture.line(a, b));
  }
  shapes.insert(shapes.begin(), std::move(back));
  shapes.push_back(std::move(front));
}

}  // namespace

int axisOf(Grip handle) {
  if (handle == Grip::none || handle == Grip::moveView || handle == Grip::scaleAll) {
    return -1;
  }
  const Grip first = handle >= Grip::scaleX ? Grip::scaleX
                     : isRing(handle)       ? Grip::turnX
                     : isPlane(handle)      ? Grip::moveYZ
                                            : Grip::moveX;
  return static_cast<int>(handle) - static_cast<int>(first);
}

GizmoMode modeOf(Grip handle) {
  return handle >= Grip::scaleX ? GizmoMode::scale : handle >= Grip::turnX ? GizmoMode::turn : GizmoMode::move;
}

glm::dvec3 Gizmo::axis(int axis) const {
  return mode_ == GizmoMode::scale ? scaleAxes_.directions[axis] : unit(axis);
}

std::vector<GizmoShape> Gizmo::shapes(const PictureView& picture) const {
  std::vector<GizmoShape> shapes;
  const auto center = picture.pixel(pivot_);
  if (!center) {
    return shapes;
  }
  const double length = arm_ * picture.metresPerPixel(pivot_);
  const glm::dvec3 sight = towards(picture, pivot_);
  const bool scales = mode_ == GizmoMode::scale;
  for (int axis = 0; axis < (scales ? scaleAxes_.count : 3); ++axis) {
    if (mode_ == GizmoMode::turn) {
      addRing(picture, pivot_, axis, length, shapes);
      continue;
    }
    if (glm::length(glm::cross(sight, this->axis(axis))) > steepestAxis) {
      const Grip handle = (scales ? scaleAxes : moveAxes)[axis];
      addShaft(picture, pivot_, length * this->axis(axis), arm_, handle, shapes);
    }
    if (scales) {
      continue;
    }
    const glm::dvec3 u = length * unit((axis + 1) % 3);
    const glm::dvec3 v = length * unit((axis + 2) % 3);
    if (std::abs(glm::dot(sight, unit(axis))) > flattestPlane) {
      const std::array corners = {pivot_ + planeNear * u + planeNear * v, pivot_ + planeFar * u + planeNear * v,
                                  pivot_ + planeFar * u + planeFar * v, pivot_ + planeNear * u + planeFar * v};
      if (auto square = filled(picture, movePlanes[axis], corners)) {
        shapes.insert(shapes.begin(), std::move(*square));
      }
    }
  }
  if (mode_ == GizmoMode::move) {
    addCenter(*center, centerRadius * arm_, shapes);
  } else if (scales) {
    addBox(Grip::scaleAll, *center, centerRadius * arm_, shapes);
  }
  return shapes;
}

// Prefers, among equally near handles, the one drawn on top.
Grip Gizmo::at(const PictureView& picture, const glm::dvec2& pixel, double reach) const {
  Grip found = Grip::none;
  double nearest = reach;
  for (const GizmoShape& shape : shapes(picture)) {
    const double distance = distanceTo(shape, pixel) + (shape.behind ? 0.5 * reach : 0.0);
    if (distance <= nearest) {
      nearest = distance;
      found = shape.handle;
    }
  }
  return found;
}

GizmoDrag::GizmoDrag(const PictureView& picture, const Gizmo& gizmo, Grip handle, const glm::dvec2& pixel)
    : picture_(picture), handle_(handle), pivot_(gizmo.pivot()), arm_(gizmo.arm()), pressed_(pixel) {
  const glm::dvec3 sight = towards(picture, pivot_);
  const int axis = axisOf(handle);
  axis_ = axis >= 0 ? gizmo.axis(axis) : glm::dvec3(0.0);
  if (axis < 0) {
    normal_ = picture.forward();
  } else if (isRing(handle)) {
    normal_ = axis_;
    onScreen_ = std::abs(glm::dot(sight, axis_)) < flattestRing;
    screen_ = glm::dvec2(1.0, 0.0);
    // Pixels count along the edge of the ring as it is seen. A ring seen face on has no such direction.
    if (onScreen_) {
      const double step = picture.metresPerPixel(pivot_);
      const auto from = picture.pixel(pivot_);
      const auto to = picture.pixel(pivot_ + step * glm::normalize(glm::cross(sight, axis_)));
      if (from && to && *from != *to) {
        screen_ = glm::normalize(*to - *from);
      }
    }
  } else if (isPlane(handle)) {
    normal_ = axis_;
  } else {
    // The plane through the axis that faces the eye most.
    const glm::dvec3 across = sight - axis_ * glm::dot(axis_, sight);
    normal_ = across == glm::dvec3(0.0) ? sight : glm::normalize(across);
  }
  start_ = meet(pixel).value_or(pivot_);
  lastAngle_ = angleAt(pixel).value_or(0.0);
}

// Returns the point where the pointer's ray meets the plane; nothing if the ray is parallel to it or meets it near its
// horizon, where a pixel spans kilometres.
std::optional<glm::dvec3> GizmoDrag::meet(const glm::dvec2& pixel) const {
  constexpr double farthest = 1000.0;  // times the pivot's depth
  const Ray ray = picture_.ray(pixel);
  const double towardsPlane = glm::dot(normal_, ray.direction);
  const double t = towardsPlane == 0.0 ? 0.0 : glm::dot(normal_, pivot_ - ray.origin) / towardsPlane;
  return t > 0.0 && t < farthest * picture_.depth(pivot_) ? std::optional(ray.at(t)) : std::nullopt;
}

std::optional<glm::dvec3> GizmoDrag::moveAt(const glm::dvec2& pixel) const {
  const auto met = meet(pixel);
  if (!met) {
    return std::nullopt;
  }
  const glm::dvec3 by = *met - start_;
  return handle_ == Grip::moveView || isPlane(handle_) ? by : axis_ * glm::dot(axis_, by);
}

// Returns the factor of a drag: moving by the handle's length adds 1. The handle of all axes grows to the right and
// upwards.
std::optional<double> GizmoDrag::factorAt(const glm::dvec2& pixel) const {
  if (handle_ == Grip::scaleAll) {
    const glm::dvec2 by = pixel - pressed_;
    return 1.0 + (by.x - by.y) / arm_;
  }
  const auto by = moveAt(pixel);
  return by ? std::optional(1.0 + glm::dot(axis_, *by) / (arm_ * picture_.metresPerPixel(pivot_))) : std::nullopt;
}

// Returns the pointer's angle about the axis in degrees. It has no bound if pixels are counted.
std::optional<double> GizmoDrag::angleAt(const glm::dvec2& pixel) const {
  if (onScreen_) {
    return glm::degrees(glm::dot(pixel - pressed_, screen_) / arm_);
  }
  const auto met = meet(pixel);
  if (!met || *met == pivot_) {
    return std::nullopt;
  }
  const int axis = axisOf(handle_);
  const glm::dvec3 arm = *met - pivot_;
  return glm::degrees(std::atan2(arm[(axis + 2) % 3], arm[(axis + 1) % 3]));
}

GizmoDrag::Change GizmoDrag::to(const glm::dvec2& pixel, bool snap) {
  if (modeOf(handle_) == GizmoMode::scale) {
    if (const auto factor = factorAt(pixel)) {
      const double by =
          std::max(rounded(*factor, snap ? scaleSnap : grain(1.0 / arm_)), snap ? scaleSnap : leastFactor);
      for (int i = 0; i < 3; ++i) {
        change_.factors[i] = handle_ == Grip::scaleAll || i == axisOf(handle_) ? by : 1.0;
      }
    }
    return change_;
  }
  if (!isRing(handle_)) {
    if (const auto by = moveAt(pixel)) {
      const double step = snap ? moveSnap : grain(picture_.metresPerPixel(pivot_));
      for (int i = 0; i < 3; ++i) {
        change_.translation[i] = rounded((*by)[i], step);
      }
    }
    return change_;
  }
  if (const auto angle = angleAt(pixel)) {
    turned_ += onScreen_ ? *angle - lastAngle_ : std::remainder(*angle - lastAngle_, 360.0);
    lastAngle_ = *angle;
    change_.degrees = rounded(turned_, snap ? turnSnap : grain(glm::degrees(1.0 / arm_)));
    change_.rotation = rotationAboutAxis(axis_, change_.degrees);
  }
  return change_;
}

}  // namespace speculum
