#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "edit/transform.hpp"

namespace speculum {

using PlacedNode = std::pair<Selection, SceneNode>;

// Moves, turns or scales the selected nodes together by a handle, from press to release.
class NodeDrag {
 public:
  // Call it at the press. All `nodes` turn about the pivot of the first one, and scaling moves them from that pivot.
  NodeDrag(GizmoDrag gizmo, const Scene& scene, const SceneState& state, std::span<const Selection> nodes,
           const glm::dvec2& pixel);

  // Returns the nodes as they are with the pointer at `pixel` of the picture. With `snap`, the drag goes in steps.
  std::vector<PlacedNode> to(const glm::dvec2& pixel, bool snap);
  Grip handle() const { return gizmo_.handle(); }
  std::string label() const;                          // distance, angle or factor, for the user
  const glm::dvec2& pixel() const { return pixel_; }  // of the pointer, in the last to()

 private:
  struct Start {
    Selection selection;
    SceneNode node;
    glm::dvec3 pivot{0.0};  // world
    glm::dmat3 axes{1.0};   // ScaleAxes::directions
  };
  SceneNode dragged(const Start& start) const;

  GizmoDrag gizmo_;
  std::vector<Start> starts_;
  double time_;  // seconds of animation
  glm::dvec2 pixel_;
  GizmoDrag::Change change_;
};

}  // namespace speculum
