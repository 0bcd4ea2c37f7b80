#include "window/camera_controller.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "geometry/bvh.hpp"
#include "scene/model_files.hpp"

namespace speculum {

namespace {

constexpr double degreesPerPixel = 0.25;
constexpr double zoomPerNotch = 0.88;
constexpr double lean = 0.15;        // tangent of the angle between the view out of a floor or ceiling and its normal
constexpr double steepest = 0.995;   // largest cosine of the angle between view direction and up
constexpr double leastLight = 0.25;  // least radius of the sphere around a light, metres
constexpr double roomAround = 1.1;   // radius that is framed, over the object's
constexpr double turnSpeed = 90.0;   // degrees a second, of a stick

Sphere boundsOfAll(const SceneState& state) {
  std::vector<Sphere> parts;
  for (const InstanceState& instance : state.instances) {
    parts.push_back({instance.center, instance.radius});
  }
  for (const MirrorState& mirror : state.mirrors) {
    for (const glm::dvec3& vertex : mirror.polygon) {
      parts.push_back({vertex});
    }
  }
  if (parts.empty()) {
    return {};
  }
  Bounds box;
  for (const Sphere& part : parts) {
    box.add(part.center - part.radius);
    box.add(part.center + part.radius);
  }
  Sphere sphere{.center = box.center()};
  for (const Sphere& part : parts) {
    sphere.radius = std::max(sphere.radius, glm::distance(sphere.center, part.center) + part.radius);
  }
  return sphere;
}

int mirrorOfInterest(int last, size_t count, const Selection& selected, std::span<const PassRow> passes) {
  if (selected.kind == Selection::Kind::mirror) {
    return selected.index;
  }
  int mirror = last;
  double area = 0.0;
  for (const PassRow& pass : passes) {
    if (pass.path.size() == 1 && pass.areaPx > area) {
      mirror = pass.path[0];
      area = pass.areaPx;
    }
  }
  // The last mirror may have been deleted since.
  return mirror >= 0 && mirror < static_cast<int>(count) ? mirror : count > 0 ? 0 : -1;
}

// Returns the lowest height of all objects and mirrors along the camera's up.
double lowestHeight(const Scene& scene) {
  const SceneState state = evaluate(scene, 0.0);
  const glm::dvec3 up = glm::normalize(scene.camera.up);
  double lowest = std::numeric_limits<double>::infinity();
  for (const InstanceState& instance : state.instances) {
    const glm::dvec3 half = scene.meshes[static_cast<size_t>(instance.mesh)].halfExtent;
    const glm::dmat3& linear = instance.worldFromMesh.linear;
    const double reach = glm::dot(glm::abs(up * linear), half);
    lowest = std::min(lowest, glm::dot(instance.worldFromMesh.translation, up) - reach);
  }
  for (const MirrorState& mirror : state.mirrors) {
    for (const glm::dvec3& vertex : mirror.polygon) {
      lowest = std::min(lowest, glm::dot(vertex, up));
    }
  }
  return std::isinf(lowest) ? -lowest : lowest;
}

double aspectOf(const glm::ivec2& size) {
  return size.y > 0 ? static_cast<double>(size.x) / size.y : 1.0;
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

void CameraController::sceneChanged(const Scene& scene) {
  reset(scene.camera);
  setFloor(lowestHeight(scene));
  lastMirror_ = -1;
  shown_.bookmark = -1;
}

void CameraController::reset(const CameraSpec& spec) {
  spec_ = spec;
  pivot_.reset();
  touched_ = false;
  last_ = lookAt(spec.position, spec.target, spec.up, spec.verticalFov, spec.near);
}

// Begins to move the scene's camera from where it is.
void CameraController::takeOver() {
  if (!touched_) {
    eye_ = last_.eye;
    target_ = spec_.target;
    touched_ = true;
  }
}

void CameraController::drag(double dx, double dy) {
  turn(dx * degreesPerPixel, dy * degreesPerPixel);
}

void CameraController::pan(double dx, double dy, double pictureHeight) {
  takeOver();
  const double metresPerPixel = 2.0 * std::tan(0.5 * last_.verticalFov) * glm::distance(eye_, target_) / pictureHeight;
  const glm::dvec3 step = glm::transpose(last_.worldToView) * glm::dvec3(-dx, dy, 0.0) * metresPerPixel;
  pivot_.reset();
  eye_ += step;
  target_ += step;
}

void CameraController::turn(double yawDegrees, double pitchDegrees) {
  takeOver();
  const glm::dvec3 up = glm::normalize(spec_.up);
  const bool orbit = shown_.mode == CameraMode::orbit;
  const glm::dvec3 arm = orbit ? eye_ - target_ : target_ - eye_;
  const glm::dvec3 right = glm::dvec3(glm::transpose(last_.worldToView)[0]);
  const glm::dmat3 yaw = rotationAboutAxis(up, -yawDegrees);
  const glm::dvec3 turned = yaw * arm;
  // Limits how far the view turns towards the pole. A scene may start steeper than the limit, and must be able to turn
  // back.
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
  takeOver();
  const glm::dvec3 arm = eye_ - target_;
  const glm::dvec3 shorter = arm * std::pow(zoomPerNotch, notches);
  if (shown_.mode == CameraMode::orbit) {
    // Keeps the eye from the target, where no view is defined, and from distances at which doubles cannot separate eye
    // and target. A scene may start beyond these bounds.
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

void CameraController::move(const glm::dvec3& direction, const GamepadState& pad, double seconds) {
  fly(direction, seconds);
  if (pad.rightX != 0.0f || pad.rightY != 0.0f) {
    turn(pad.rightX * turnSpeed * seconds, pad.rightY * turnSpeed * seconds);
  }
  fly({pad.leftX, pad.rightTrigger - pad.leftTrigger, pad.leftY}, seconds);
}

void CameraController::fly(const glm::dvec3& direction, double seconds) {
  if (direction == glm::dvec3(0.0)) {
    return;
  }
  takeOver();
  pivot_.reset();
  // Bounds the speed from below, because it falls near the target.
  const double least = std::min(0.5, 0.6 * glm::distance(spec_.position, spec_.target));
  const double speed = std::max(least, 0.6 * glm::length(eye_ - target_));  // metres per second
  const glm::dvec3 step = glm::transpose(last_.worldToView) * direction * (speed * seconds);
  eye_ += step;
  target_ += step;
}

void CameraController::frame(const Sphere& sphere, double aspect, const Part& part) {
  takeOver();
  const glm::dvec2 slope = std::tan(0.5 * glm::radians(spec_.verticalFov)) * glm::dvec2(aspect, 1.0);
  const double narrowest = std::atan(std::min(slope.x * part.half.x, slope.y * part.half.y));
  const double distance = std::max(roomAround * sphere.radius, 10.0 * std::min(spec_.near, 1.0)) / std::sin(narrowest);
  const glm::dmat3 axes = glm::transpose(last_.worldToView);
  target_ = sphere.center - axes * glm::dvec3(part.center * slope * distance, 0.0);
  eye_ = target_ + axes[2] * distance;
  pivot_ = sphere.center;
}

void CameraController::lookFrom(const MirrorState& mirror, MirrorSide side, double aspect) {
  takeOver();
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
  // The eye stands before the mirror's plane: on it, rounding would decide whether the mirror shows its front.
  eye_ = side == MirrorSide::back ? middle - forward * distance
                                  : middle + mirror.normal * (10.0 * std::min(spec_.near, 1.0));
  target_ = eye_ + forward * std::max(distance, radius);
}

int CameraController::lookFromMirror(MirrorSide side, const SceneState& state, const Selection& selected,
                                     std::span<const PassRow> passes, double aspect) {
  lastMirror_ = mirrorOfInterest(lastMirror_, state.mirrors.size(), selected, passes);
  if (lastMirror_ >= 0) {
    lookFrom(state.mirrors[static_cast<size_t>(lastMirror_)], side, aspect);
  }
  return lastMirror_;
}

void CameraController::goTo(const Bookmark& view, const Scene& scene) {
  spec_ = cameraOf(view, scene.camera);
  pivot_.reset();
  eye_ = spec_.position;
  target_ = spec_.target;
  touched_ = true;
}

void CameraController::goToBookmark(size_t index, const Scene& scene) {
  if (index < scene.bookmarks.size()) {
    shown_.bookmark = static_cast<int>(index);
    goTo(scene.bookmarks[index], scene);
  }
}

void CameraController::goToNextBookmark(const Scene& scene) {
  if (!scene.bookmarks.empty()) {
    goToBookmark(static_cast<size_t>(shown_.bookmark + 1) % scene.bookmarks.size(), scene);
  }
}

Bookmark CameraController::bookmark(const CameraPose& pose, const CameraSpec& usual) const {
  const glm::dvec3 ahead = pose.eye - glm::dvec3(glm::transpose(pose.worldToView)[2]);
  Bookmark bookmark{.name = "view", .position = pose.eye, .target = touched_ ? target_ : ahead};
  if (touched_ && spec_.up != usual.up) {
    bookmark.up = spec_.up;
  }
  if (touched_ && spec_.verticalFov != usual.verticalFov) {
    bookmark.verticalFov = spec_.verticalFov;
  }
  return bookmark;
}

void CameraController::bookmarksChanged(const Scene& scene) {
  shown_.bookmark = std::min(shown_.bookmark, static_cast<int>(scene.bookmarks.size()) - 1);
}

CameraPose CameraController::pose(const CameraPose& animated) {
  last_ = touched_ ? lookAt(eye_, target_, spec_.up, spec_.verticalFov, spec_.near) : animated;
  return last_;
}

SceneState ViewController::state(const Scene& scene, double time) {
  SceneState state = evaluate(scene, time);
  state.camera = camera.pose(state.camera);
  return state;
}

WatchedState ViewController::watchedState(const Scene& scene, const SceneState& shown) const {
  return {.camera = shown.camera,
          .movedCamera = camera.moved(),
          .time = shown.time,
          .seeks = playback.seeks(),
          .paused = playback.shown().paused,
          .animated = animated(scene)};
}

void ViewController::frame(const Scene& scene, const Selection& node, const glm::ivec2& size, const PixelRect& free) {
  SceneState state = evaluate(scene, time());
  if (!node && isModelFile(scene.file) && !state.instances.empty()) {
    state.mirrors.clear();  // an opened model stands on a mirror that is much larger
  }
  const Sphere bounds = boundsOf(scene, state, node);
  if (bounds.radius > 0.0) {
    const glm::dvec2 pixels = glm::max(glm::dvec2(size), 1.0);
    const glm::dvec2 half = glm::dvec2(free.width, free.height) / pixels;
    const glm::dvec2 corner = 2.0 * glm::dvec2(free.x, free.y) / pixels;
    camera.frame(bounds, aspectOf(size), {.center = {corner.x + half.x - 1.0, 1.0 - corner.y - half.y}, .half = half});
  }
}

// Says what is seen, because a back that does not reflect looks like a fault.
std::string ViewController::lookFromMirror(const Scene& scene, MirrorSide side, const Selection& selected,
                                           std::span<const PassRow> passes, const glm::ivec2& size) {
  const int mirror = camera.lookFromMirror(side, evaluate(scene, time()), selected, passes, aspectOf(size));
  if (mirror < 0) {
    return "The scene has no mirror to look from";
  }
  const std::string name = describe(scene, mirrorNode(scene, mirror));
  if (side == MirrorSide::front) {
    return "Looking out of " + name;
  }
  const bool reflects = scene.mirror(static_cast<size_t>(mirror)).twoSided;
  return "Behind " + name +
         (reflects ? ", which reflects on both sides" : ". Its back does not reflect; Shift+B looks out of its front");
}

}  // namespace speculum
