#include "edit/transform.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "geometry/affine.hpp"
#include "geometry/polygon.hpp"

namespace speculum {

namespace {

// Rounds metres and degrees to nine decimals, so that files hold 30 and not 29.999999999999996. Division gives the
// double nearest to the decimal number.
glm::dvec3 tidy(const glm::dvec3& v) {
  constexpr double decimals = 1e9;
  constexpr double farthest = 1e6;  // beyond, a double has no such decimals
  glm::dvec3 result = v;
  for (int i = 0; i < 3; ++i) {
    result[i] = std::abs(v[i]) < farthest ? std::round(v[i] * decimals) / decimals : v[i];
  }
  return result;
}

// Rounds to nine digits, however small the size is.
double tidySize(double size) {
  const double perUnit = std::pow(10.0, 8.0 - std::floor(std::log10(std::abs(size))));
  return size != 0.0 && std::isfinite(perUnit) && perUnit > 0.0 ? std::round(size * perUnit) / perUnit : size;
}

glm::dvec3 turnedAngles(const glm::dvec3& angles, const glm::dvec3& spin, const glm::dmat3& rotation, double time) {
  const glm::dvec3 turned = angles + spunBy(spin, time);
  return tidy(pitchYawRoll(rotation * rotationFromDegrees(turned), turned) - spunBy(spin, time));
}

glm::dvec3 about(const glm::dvec3& pivot, const glm::dmat3& rotation, const glm::dvec3& p) {
  return pivot + rotation * (p - pivot);
}

}  // namespace

const InstanceState* instanceOf(const SceneState& state, const Selection& selection) {
  const auto found = std::ranges::find_if(state.instances, [&](const InstanceState& instance) {
    return selection.kind == Selection::Kind::object && instance.object == selection.index &&
           instance.copy == selection.copy;
  });
  return found != state.instances.end() ? &*found : nullptr;
}

glm::dvec3 pivotOf(const Scene& scene, const SceneState& state, const Selection& selection) {
  const int index = std::max(selection.index, 0);
  if (selection.kind == Selection::Kind::mirror) {
    return vertexMean(state.mirrors.at(index).polygon);
  }
  if (selection.kind == Selection::Kind::light) {
    return state.lights.at(index).position;
  }
  if (const InstanceState* instance = instanceOf(state, selection)) {
    const Object& object = scene.objects.at(index);
    const glm::dvec3 origin = object.position + static_cast<double>(selection.copy) * object.copies.step;
    return glm::distance(origin, instance->center) <= instance->radius ? origin : instance->center;
  }
  return glm::dvec3(0.0);
}

double reachOf(const Scene& scene, const SceneState& state, const Selection& selection) {
  const glm::dvec3 pivot = pivotOf(scene, state, selection);
  const int index = std::max(selection.index, 0);
  if (selection.kind == Selection::Kind::light) {
    return scene.lights.at(index).radius;
  }
  if (const InstanceState* instance = instanceOf(state, selection)) {
    return glm::distance(pivot, instance->center) + instance->radius;
  }
  return selection.kind == Selection::Kind::mirror ? farthestDistance(pivot, state.mirrors.at(index).polygon) : 0.0;
}

SceneNode moved(const SceneNode& node, const glm::dvec3& by, double time) {
  SceneNode result = node;
  if (auto* object = std::get_if<Object>(&result)) {
    object->position = tidy(object->position + by);
  } else if (auto* light = std::get_if<PointLight>(&result)) {
    const glm::dmat3 turn =
        light->orbit ? rotationAboutAxis(light->orbit->axis, light->orbit->speed * time) : glm::dmat3(1.0);
    light->position = tidy(light->position + glm::transpose(turn) * by);
  } else if (auto* mirror = std::get_if<Mirror>(&result)) {
    mirror->position = mirror->polygon.empty() ? tidy(mirror->position + by) : mirror->position;
    for (glm::dvec3& p : mirror->polygon) {
      p = tidy(p + by);
    }
  }
  return result;
}

SceneNode turned(const SceneNode& node, const glm::dmat3& rotation, const glm::dvec3& pivot, int copy, double time) {
  SceneNode result = node;
  if (auto* object = std::get_if<Object>(&result)) {
    const glm::dvec3 step = static_cast<double>(copy) * object->copies.step;
    object->position = tidy(about(pivot, rotation, object->position + step) - step);
    object->rotation = turnedAngles(object->rotation, object->spin, rotation, time);
  } else if (auto* mirror = std::get_if<Mirror>(&result)) {
    for (glm::dvec3& p : mirror->polygon) {
      p = tidy(about(pivot, rotation, p));
    }
    if (mirror->polygon.empty()) {
      mirror->position = tidy(about(pivot, rotation, mirror->position));
      mirror->rotation = turnedAngles(mirror->rotation, mirror->spin, rotation, time);
    }
  }
  return result;
}

ScaleAxes scaleAxesOf(const Scene& scene, const SceneState& state, const Selection& selection) {
  const int index = std::max(selection.index, 0);
  if (selection.kind == Selection::Kind::object) {
    const Object& object = scene.objects.at(index);
    return {.directions = rotationFromDegrees(object.rotation + spunBy(object.spin, state.time))};
  }
  if (selection.kind == Selection::Kind::mirror) {
    const MirrorState& mirror = state.mirrors.at(index);
    return {.directions = {mirror.axisX, mirror.axisY, mirror.normal}, .count = 2};
  }
  return {.count = 0};
}

SceneNode scaled(const SceneNode& node, const glm::dvec3& factors, const glm::dmat3& axes, const glm::dvec3& pivot,
                 int copy) {
  const auto stretched = [&](const glm::dvec3& p) {
    return pivot + axes * (factors * (glm::transpose(axes) * (p - pivot)));
  };
  SceneNode result = node;
  if (auto* object = std::get_if<Object>(&result)) {
    const glm::dvec3 step = static_cast<double>(copy) * object->copies.step;
    object->position = tidy(stretched(object->position + step) - step);
    for (int i = 0; i < 3; ++i) {
      object->scale[i] = tidySize(object->scale[i] * factors[i]);
    }
  } else if (auto* light = std::get_if<PointLight>(&result)) {
    const bool equal = factors.x == factors.y && factors.y == factors.z;
    light->radius = equal ? tidySize(light->radius * factors.x) : light->radius;
  } else if (auto* mirror = std::get_if<Mirror>(&result)) {
    for (glm::dvec3& p : mirror->polygon) {
      p = tidy(stretched(p));
    }
    mirror->size = {tidySize(mirror->size.x * factors.x), tidySize(mirror->size.y * factors.y)};
  }
  return result;
}

// Returns the angles p, y, r of Ry Rx Rz. Its third column is (cos p sin y, -sin p, cos p cos y), its second row (cos p
// sin r, cos p cos r, -sin p). Without the roll, the first column is (cos y, 0, -sin y) at every pitch.
glm::dvec3 pitchYawRoll(const glm::dmat3& rotation, const glm::dvec3& near) {
  constexpr double lock = 1e-7;  // cosine of the pitch, below which rounding alone would decide the roll
  const double cosine = std::hypot(rotation[0].y, rotation[1].y);
  const double pitch = std::atan2(-rotation[2].y, cosine);
  const double roll = cosine > lock ? std::atan2(rotation[0].y, rotation[1].y) : glm::radians(near.z);
  const glm::dvec3 side = rotation * glm::dvec3(std::cos(roll), -std::sin(roll), 0.0);
  const double yaw = std::atan2(-side.z, side.x);
  const auto nearest = [&](glm::dvec3 angles) {
    for (int i = 0; i < 3; ++i) {
      angles[i] = near[i] + std::remainder(angles[i] - near[i], 360.0);
    }
    return angles;
  };
  const glm::dvec3 first = nearest(glm::degrees(glm::dvec3(pitch, yaw, roll)));
  if (cosine <= lock) {
    return first;
  }
  const glm::dvec3 other =
      nearest({180.0 - glm::degrees(pitch), glm::degrees(yaw) + 180.0, glm::degrees(roll) + 180.0});
  const auto distance = [&](const glm::dvec3& angles) { return glm::length(angles - near); };
  return distance(other) < distance(first) ? other : first;
}

NodeDrag::NodeDrag(GizmoDrag gizmo, const Scene& scene, const SceneState& state, std::span<const Selection> nodes,
                   const glm::dvec2& pixel)
    : gizmo_(std::move(gizmo)), time_(state.time), pixel_(pixel) {
  for (const Selection& node : nodes) {
    starts_.push_back(
        {node, nodeOf(scene, node), pivotOf(scene, state, node), scaleAxesOf(scene, state, node).directions});
  }
}

std::vector<PlacedNode> NodeDrag::to(const glm::dvec2& pixel, bool snap) {
  pixel_ = pixel;
  change_ = gizmo_.to(pixel, snap);
  std::vector<PlacedNode> nodes;
  for (const Start& start : starts_) {
    nodes.emplace_back(start.selection, dragged(start));
  }
  return nodes;
}

// A light has no orientation, so it orbits the pivot.
SceneNode NodeDrag::dragged(const Start& start) const {
  const glm::dvec3& pivot = starts_.front().pivot;
  const glm::dvec3 away = start.pivot - pivot;
  if (modeOf(handle()) == GizmoMode::move) {
    return moved(start.node, change_.translation, time_);
  }
  if (modeOf(handle()) == GizmoMode::scale) {
    const glm::dmat3& axes = starts_.front().axes;
    const SceneNode node = scaled(start.node, change_.factors, start.axes, start.pivot, start.selection.copy);
    return moved(node, axes * (change_.factors * (glm::transpose(axes) * away)) - away, time_);
  }
  if (change_.degrees == 0.0) {
    return start.node;
  }
  if (start.selection.kind == Selection::Kind::light) {
    return moved(start.node, change_.rotation * away - away, time_);
  }
  return turned(start.node, change_.rotation, pivot, start.selection.copy, time_);
}

std::string NodeDrag::label() const {
  const int axis = axisOf(handle());
  if (handle() == Grip::scaleAll) {
    return fmt::format("x {:.3f}", change_.factors.x);
  }
  if (modeOf(handle()) == GizmoMode::scale) {
    return std::string(1, "XYZ"[axis]) + fmt::format("  x {:.3f}", change_.factors[axis]);
  }
  if (modeOf(handle()) == GizmoMode::turn) {
    return std::string(1, "XYZ"[axis]) + fmt::format("  {:+.1f} deg", change_.degrees);
  }
  if (handle() <= Grip::moveZ) {
    return std::string(1, "XYZ"[axis]) + fmt::format("  {:+.3f} m", change_.translation[axis]);
  }
  return fmt::format("{:+.3f}  {:+.3f}  {:+.3f} m", change_.translation.x, change_.translation.y,
                     change_.translation.z);
}

}  // namespace speculum
