#include "app/view_controller.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace speculum {

namespace {

constexpr double turnSpeed = 90.0;  // degrees a second, of a stick

int mirrorOfInterest(int last, size_t count, const Selection& selected, std::span<const PassView> passes) {
  if (selected.kind == Selection::Kind::mirror) {
    return selected.index;
  }
  int mirror = last;
  double area = 0.0;
  for (const PassView& pass : passes) {
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

}  // namespace

void ViewController::sceneChanged(const Scene& scene) {
  camera_.reset(scene.camera);
  camera_.setFloor(lowestHeight(scene));
  lastMirror_ = -1;
  view_.bookmark = -1;
  listBookmarks(scene);
}

void ViewController::setMode(CameraMode mode) {
  view_.mode = mode;
  camera_.setMode(mode);
}

void ViewController::move(const glm::dvec3& direction, const GamepadState& pad, double seconds) {
  camera_.move(direction, seconds);
  if (pad.rightX != 0.0f || pad.rightY != 0.0f) {
    camera_.turn(pad.rightX * turnSpeed * seconds, pad.rightY * turnSpeed * seconds);
  }
  camera_.move({pad.leftX, pad.rightTrigger - pad.leftTrigger, pad.leftY}, seconds);
}

void ViewController::goToBookmark(size_t index, const Scene& scene) {
  if (index < scene.bookmarks.size()) {
    view_.bookmark = static_cast<int>(index);
    camera_.moveTo(cameraOf(scene.bookmarks[index], scene.camera));
  }
}

void ViewController::goToNextBookmark(const Scene& scene) {
  if (!scene.bookmarks.empty()) {
    goToBookmark(static_cast<size_t>(view_.bookmark + 1) % scene.bookmarks.size(), scene);
  }
}

Bookmark ViewController::bookmark(const CameraPose& pose, const CameraSpec& usual) const {
  const std::optional<CameraSpec> place = camera_.place();
  const glm::dvec3 ahead = pose.eye - glm::dvec3(glm::transpose(pose.worldToView)[2]);
  Bookmark bookmark{.name = "view", .position = pose.eye, .target = place ? place->target : ahead};
  if (place && place->up != usual.up) {
    bookmark.up = place->up;
  }
  if (place && place->verticalFov != usual.verticalFov) {
    bookmark.verticalFov = place->verticalFov;
  }
  return bookmark;
}

void ViewController::listBookmarks(const Scene& scene) {
  view_.bookmarks.clear();
  for (const Bookmark& bookmark : scene.bookmarks) {
    view_.bookmarks.push_back(bookmark.name);
  }
  view_.bookmark = std::min(view_.bookmark, static_cast<int>(view_.bookmarks.size()) - 1);
}

void ViewController::lookFromMirror(MirrorSide side, const Scene& scene, const SceneState& state,
                                    const Selection& selected, std::span<const PassView> passes, double aspect) {
  lastMirror_ = mirrorOfInterest(lastMirror_, scene.mirrors.size(), selected, passes);
  if (lastMirror_ >= 0) {
    camera_.lookFrom(state.mirrors[static_cast<size_t>(lastMirror_)], side, aspect);
  }
}

}  // namespace speculum
