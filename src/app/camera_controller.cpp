#include "app/camera_controller.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "optics/affine.hpp"

namespace speculum {

namespace {

constexpr double degreesPerPixel = 0.25;
constexpr double zoomPerNotch = 0.88;
constexpr double steepest = 0.995;  // cosine of view direction and up

}  // namespace

Sphere boundsOf(const SceneState& state) {
  glm::dvec3 low(std::numeric_limits<double>::infinity());
  glm::dvec3 high = -low;
  const auto add = [&](const glm::dvec3& center, double radius) {
    low = glm::min(low, center - radius);
    high = glm::max(high, center + radius);
  };
  for (const InstanceState& instance : state.instances) {
    add(instance.center, instance.radius);
  }
  for (const MirrorState& mirror : state.mirrors) {
    for (const glm::dvec3& vertex : mirror.polygon) {
      add(vertex, 0.0);
    }
  }
  if (low.x > high.x) {
    return {};
  }
  Sphere sphere{.center = 0.5 * (low + high)};
  for (const InstanceState& instance : state.instances) {
    sphere.radius = std::max(sphere.radius, glm::distance(sphere.center, instance.center) + instance.radius);
  }
  for (const MirrorState& mirror : state.mirrors) {
    for (const glm::dvec3& vertex : mirror.polygon) {
      sphere.radius = std::max(sphere.radius, glm::distance(sphere.center, vertex));
    }
  }
  return sphere;
}

void CameraController::reset(const CameraSpec& spec) {
  spec_ = spec;
  touched_ = false;
}

void CameraController::take(const CameraPose& pose) {
  if (!touched_) {
    eye_ = pose.eye;
    target_ = spec_.target;
    touched_ = true;
  }
}

void CameraController::drag(double dx, double dy) {
  take(last_);
  const glm::dvec3 up = glm::normalize(spec_.up);
  const bool orbit = mode_ == CameraMode::orbit;
  const glm::dvec3 arm = orbit ? eye_ - target_ : target_ - eye_;
  const glm::dvec3 right = glm::dvec3(glm::transpose(last_.worldToView)[0]);
  const glm::dmat3 yaw = rotationAboutAxis(up, -dx * degreesPerPixel);
  glm::dvec3 turned = yaw * arm;
  const glm::dvec3 pitched = rotationAboutAxis(yaw * right, -dy * degreesPerPixel) * turned;
  const auto steepness = [&](const glm::dvec3& v) { return std::abs(glm::dot(glm::normalize(v), up)); };
  // A scene may start steeper than that; back from there must be possible.
  if (steepness(pitched) < std::max(steepest, steepness(turned))) {
    turned = pitched;
  }
  (orbit ? eye_ : target_) = orbit ? target_ + turned : eye_ + turned;
}

void CameraController::zoom(double notches) {
  take(last_);
  const glm::dvec3 arm = eye_ - target_;
  const glm::dvec3 shorter = arm * std::pow(zoomPerNotch, notches);
  if (mode_ == CameraMode::orbit) {
    eye_ = target_ + shorter;
  } else {
    const glm::dvec3 step = shorter - arm;
    eye_ += step;
    target_ += step;
  }
}

void CameraController::move(const glm::dvec3& direction, double seconds) {
  if (direction == glm::dvec3(0.0)) {
    return;
  }
  take(last_);
  // Near the target not ever slower, but slow enough for what the scene shows.
  const double least = std::min(0.5, 0.6 * glm::distance(spec_.position, spec_.target));
  const double speed = std::max(least, 0.6 * glm::length(eye_ - target_));  // metres per second
  const glm::dvec3 step = glm::transpose(last_.worldToView) * direction * (speed * seconds);
  eye_ += step;
  target_ += step;
}

void CameraController::frame(const Sphere& sphere, double aspect) {
  take(last_);
  const double vertical = 0.5 * glm::radians(spec_.verticalFov);
  const double narrower = std::min(vertical, std::atan(std::tan(vertical) * aspect));
  const glm::dvec3 back = glm::transpose(last_.worldToView)[2];
  target_ = sphere.center;
  eye_ = sphere.center + back * (std::max(sphere.radius, 10.0 * spec_.near) / std::sin(narrower));
}

CameraPose CameraController::pose(const CameraPose& animated) {
  last_ = touched_ ? lookAt(eye_, target_, spec_.up, spec_.verticalFov, spec_.near) : animated;
  return last_;
}

}  // namespace speculum
