#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "edit/gizmo.hpp"
#include "edit/transform.hpp"

namespace speculum {

using PlacedNode = std::pair<Selection, SceneNode>;

// Moves or turns the selected nodes together by a handle, from press to release.
class NodeDrag {
 public:
  // `nodes` are where they were at the press; all turn about the pivot of the first.
  NodeDrag(GizmoDrag gizmo, const Scene& scene, const SceneState& state, std::span<const Selection> nodes,
           const glm::dvec2& pixel);

  // Returns the nodes for a pointer at that pixel.
  std::vector<PlacedNode> to(const glm::dvec2& pixel, bool snap);
  Grip handle() const { return gizmo_.handle(); }
  bool turns() const { return handle() >= Grip::turnX; }
  std::string label() const;  // distance or angle, for the user
  const glm::dvec2& pixel() const { return pixel_; }

 private:
  struct Start {
    Selection selection;
    SceneNode node;
    glm::dvec3 pivot{0.0};  // world
  };
  SceneNode dragged(const Start& start) const;

  GizmoDrag gizmo_;
  std::vector<Start> starts_;
  double time_;  // seconds of animation
  glm::dvec2 pixel_;
  GizmoDrag::Change change_;
};

}  // namespace speculum
