#include "app/node_drag.hpp"

#include <spdlog/fmt/fmt.h>

namespace speculum {

NodeDrag::NodeDrag(GizmoDrag gizmo, const Scene& scene, const SceneState& state, std::span<const Selection> nodes,
                   const glm::dvec2& pixel)
    : gizmo_(std::move(gizmo)), time_(state.time), pixel_(pixel) {
  for (const Selection& node : nodes) {
    starts_.push_back({node, nodeOf(scene, node), pivotOf(scene, state, node)});
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
  if (!turns()) {
    return moved(start.node, change_.translation, time_);
  }
  if (change_.degrees == 0.0) {
    return start.node;
  }
  if (start.selection.kind == Selection::Kind::light) {
    return moved(start.node, pivot + change_.rotation * (start.pivot - pivot) - start.pivot, time_);
  }
  return turned(start.node, change_.rotation, pivot, start.selection.copy, time_);
}

std::string NodeDrag::label() const {
  const int axis = axisOf(handle());
  if (turns()) {
    return std::string(1, "XYZ"[axis]) + fmt::format("  {:+.1f} deg", change_.degrees);
  }
  if (handle() <= Grip::moveZ) {
    return std::string(1, "XYZ"[axis]) + fmt::format("  {:+.3f} m", change_.translation[axis]);
  }
  return fmt::format("{:+.3f}  {:+.3f}  {:+.3f} m", change_.translation.x, change_.translation.y,
                     change_.translation.z);
}

}  // namespace speculum
