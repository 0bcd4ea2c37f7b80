#include "window/node_drag.hpp"

#include <spdlog/fmt/fmt.h>

namespace speculum {

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
