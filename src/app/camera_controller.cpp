#include "app/camera_controller.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "geometry/bvh.hpp"

namespace speculum {

namespace {

constexpr double degreesPerPixel = 0.25;
constexpr double zoomPerNotch = 0.88;
constexpr double lean = 0.15;        // tangent of an angle
constexpr double steepest = 0.995;   // cosine of view direction and up
constexpr double leastLight = 0.25;  // metres around a light that are shown

Sphere boundsOfAll(const SceneState& state) {
  Bounds box;
  for (const InstanceState& instance : state.instances) {
    box.add(instance.center - instance.radius);
    box.add(instance.center + instance.radius);
  }
  for (const MirrorState& mirror : state.mirrors) {
    std::ranges::for_each(mirror.polygon, [&](const glm::dvec3& vertex) { box.add(vertex); });
  }
  if (box.low.x > box.high.x) {
    return {};
  }
  Sphere sphere{.center = box.center()};
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

}  // namespace

Sphere boundsOf(const Scene& scene, const SceneState& state, const Selection& selection) {
  SceneState shown;
  switch (selection.kind) {
    case Selection::Kind::none:
      return boundsOfAll(state);
    case Selection::Kind::light:
      return {state.lights[selection.index].position, std::max(scene.lights[selection.index].radius, leastLight)};
    case Selection::Kind::mirror:
      shown.mirrors = {state.mirrors[selection.index]};
      return boundsOfAll(shown);
    case Selection::Kind::object:
      std::copy_if(state.instances.begin(), state.instances.end(), std::back_inserter(shown.instances),
                   [&](const InstanceState& i) { return i.object == selection.index && i.copy == selection.copy; });
      return boundsOfAll(shown);
  }
  return {};
}

void CameraController::reset(const CameraSpec& spec) {
  spec_ = spec;
  pivot_.reset();
  touched_ = false;
  last_ = lookAt(spec.position, spec.target, spec.up, spec.verticalFov, spec.near);
}

void CameraController::moveTo(const CameraSpec& spec) {
  spec_ = spec;
  pivot_.reset();
  eye_ = spec.position;
  target_ = spec.target;
  touched_ = true;
}

void CameraController::startFrom(const CameraPose& pose) {
  if (!touched_) {
    eye_ = pose.eye;
    target_ = spec_.target;
    touched_ = true;
  }
}

void CameraController::drag(double dx, double dy) {
  turn(dx * degreesPerPixel, dy * degreesPerPixel);
}

void CameraController::pan(double dx, double dy, double pictureHeight) {
  startFrom(last_);
  const double metresPerPixel = 2.0 * std::tan(0.5 * last_.verticalFov) * glm::distance(eye_, target_) / pictureHeight;
  const glm::dvec3 step = glm::transpose(last_.worldToView) * glm::dvec3(-dx, dy, 0.0) * metresPerPixel;
  pivot_.reset();
  eye_ += step;
  target_ += step;
}

void CameraController::turn(double yawDegrees, double pitchDegrees) {
  startFrom(last_);
  const glm::dvec3 up = glm::normalize(spec_.up);
  const bool orbit = mode_ == CameraMode::orbit;
  const glm::dvec3 arm = orbit ? eye_ - target_ : target_ - eye_;
  const glm::dvec3 right = glm::dvec3(glm::transpose(last_.worldToView)[0]);
  const glm::dmat3 yaw = rotationAboutAxis(up, -yawDegrees);
  const glm::dvec3 turned = yaw * arm;
  // Turns towards the pole as far as allowed. A scene may start steeper than that, and must be able to turn back.
  const double height = glm::degrees(std::asin(std::clamp(glm::dot(glm::normalize(turned), up), -1.0, 1.0)));
  const double limit = std::max(glm::degrees(std::asin(steepest)), std::abs(height));
  const double rise = orbit ? pitchDegrees : -pitchDegrees;
  const double above = floor_ + 10.0 * spec_.near - glm::dot(target_, up);  // height of the lowest eye over the target
  const double lowest = orbit ? glm::degrees(std::asin(std::clamp(above / glm::length(arm), -1.0, 1.0))) : -90.0;
  const double pitch = std::clamp(height + rise, std::max(-limit, std::min(lowest, height)), limit) - height;
  const glm::dmat3 turn = rotationAboutAxis(yaw * right, orbit ? -pitch : pitch) * yaw;
  if (!orbit) {
    target_ = eye_ + turn * arm;
    return;
  }
  const glm::dvec3 pivot = pivot_.value_or(target_);
  eye_ = pivot + turn * (eye_ - pivot);
  target_ = pivot + turn * (target_ - pivot);
}

void CameraController::zoom(double notches) {
  startFrom(last_);
  const glm::dvec3 arm = eye_ - target_;
  const glm::dvec3 shorter = arm * std::pow(zoomPerNotch, notches);
  if (mode_ == CameraMode::orbit) {
    // Keeps the eye from the target, where no view is defined, and from distances at which doubles cannot separate the
    // two. A scene may start beyond these bounds.
    const double now = glm::length(arm);
    const double least = std::min(now, 1e-6 * (1.0 + glm::length(target_)));
    const double most = std::max(now, 1e9);
    eye_ = target_ + arm * (std::clamp(glm::length(shorter), least, most) / now);
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
  startFrom(last_);
  pivot_.reset();
  // Bounds the speed from below, because it falls near the target.
  const double least = std::min(0.5, 0.6 * glm::distance(spec_.position, spec_.target));
  const double speed = std::max(least, 0.6 * glm::length(eye_ - target_));  // metres per second
  const glm::dvec3 step = glm::transpose(last_.worldToView) * direction * (speed * seconds);
  eye_ += step;
  target_ += step;
}

void CameraController::frame(const Sphere& sphere, double aspect, const Part& part) {
  startFrom(last_);
  const glm::dvec2 slope = std::tan(0.5 * glm::radians(spec_.verticalFov)) * glm::dvec2(aspect, 1.0);
  const double narrowest = std::atan(std::min(slope.x * part.half.x, slope.y * part.half.y));
  const double distance = std::max(sphere.radius, 10.0 * std::min(spec_.near, 1.0)) / std::sin(narrowest);
  const glm::dmat3 axes = glm::transpose(last_.worldToView);
  target_ = sphere.center - axes * glm::dvec3(part.center * slope * distance, 0.0);
  eye_ = target_ + axes[2] * distance;
  pivot_ = sphere.center;
}

void CameraController::lookFrom(const MirrorState& mirror, MirrorSide side, double aspect) {
  startFrom(last_);
  pivot_.reset();
  const glm::dvec3 middle = vertexMean(mirror.polygon);
  double radius = 0.0;
  for (const glm::dvec3& vertex : mirror.polygon) {
    radius = std::max(radius, glm::distance(middle, vertex));
  }
  const glm::dvec3 up = glm::normalize(spec_.up);
  glm::dvec3 forward = mirror.normal;
  if (std::abs(glm::dot(forward, up)) > steepest) {
    // The normal of a floor or a ceiling does not define what is up in the picture, so the view leans towards the
    // camera's direction.
    const glm::dvec3 back = glm::transpose(last_.worldToView)[2];
    const glm::dvec3 level = -back + glm::dot(back, up) * up;
    forward = glm::normalize(forward + lean * (glm::length(level) > 1e-6 ? glm::normalize(level) : mirror.axisX));
  }
  const double vertical = 0.5 * glm::radians(spec_.verticalFov);
  const double narrower = std::min(vertical, std::atan(std::tan(vertical) * aspect));  // half the picture's angle
  const double distance = side == MirrorSide::back ? radius / std::sin(narrower) : 0.0;
  // On the plane itself, rounding would decide whether the mirror shows its front.
  eye_ = side == MirrorSide::back ? middle - forward * distance
                                  : middle + mirror.normal * (10.0 * std::min(spec_.near, 1.0));
  target_ = eye_ + forward * std::max(distance, radius);
}

std::optional<CameraSpec> CameraController::place() const {
  CameraSpec spec = spec_;
  spec.position = eye_;
  spec.target = target_;
  return touched_ ? std::optional(spec) : std::nullopt;
}

CameraPose CameraController::pose(const CameraPose& animated) {
  last_ = touched_ ? lookAt(eye_, target_, spec_.up, spec_.verticalFov, spec_.near) : animated;
  return last_;
}

}  // namespace speculum
