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
  // `nodes` stand where they were at the press. All turn about the pivot of the first, and scaling moves them from it.
  NodeDrag(GizmoDrag gizmo, const Scene& scene, const SceneState& state, std::span<const Selection> nodes,
           const glm::dvec2& pixel);

  // Returns the nodes for a pointer at that pixel.
  std::vector<PlacedNode> to(const glm::dvec2& pixel, bool snap);
  Grip handle() const { return gizmo_.handle(); }
  std::string label() const;  // distance, angle or factor, for the user
  const glm::dvec2& pixel() const { return pixel_; }

 private:
  struct Start {
    Selection selection;
    SceneNode node;
    glm::dvec3 pivot{0.0};  // world
    glm::dmat3 axes{1.0};   // for scaling
  };
  SceneNode dragged(const Start& start) const;

  GizmoDrag gizmo_;
  std::vector<Start> starts_;
  double time_;  // seconds of animation
  glm::dvec2 pixel_;
  GizmoDrag::Change change_;
};

}  // namespace speculum
