#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "edit/gizmo.hpp"
#include "edit/selection.hpp"
#include "scene/scene_state.hpp"

namespace speculum {

// Returns the point of a node (world) at which the gizmo stands: an object's origin, or the centre of its bounding
// sphere if the origin lies outside it; a light's centre; a mirror's middle.
glm::dvec3 pivotOf(const Scene& scene, const SceneState& state, const Selection& selection);
// Returns the radius of a sphere around the pivot that holds the node, metres.
double reachOf(const Scene& scene, const SceneState& state, const Selection& selection);

// Returns the instance of an object's copy; null if there is none.
const InstanceState* instanceOf(const SceneState& state, const Selection& selection);

// Returns the node moved by `by` (metres, world) from where it is at `time` (seconds). All copies of an object move.
SceneNode moved(const SceneNode& node, const glm::dvec3& by, double time);

// Returns the node turned about a point of the world, from where it is at `time` (seconds). The copy `copy` of an
// object turns about the pivot, the other copies about their own origins. Lights do not turn.
SceneNode turned(const SceneNode& node, const glm::dmat3& rotation, const glm::dvec3& pivot, int copy, double time);

// Returns the axes along which the node has a size: three for an object, two for a mirror, none for a light, which has
// a radius only.
ScaleAxes scaleAxesOf(const Scene& scene, const SceneState& state, const Selection& selection);

// Returns the node scaled about its pivot by factors along its axes, the columns of `axes` (world). The radius of a
// light is scaled if all factors are equal.
SceneNode scaled(const SceneNode& node, const glm::dvec3& factors, const glm::dmat3& axes, const glm::dvec3& pivot,
                 int copy);

// Returns pitch, yaw and roll in degrees with R = Ry Rx Rz, the solution nearest to `near`. At a pitch of 90 degrees,
// where yaw and roll turn about one axis, the roll is that of `near`.
glm::dvec3 pitchYawRoll(const glm::dmat3& rotation, const glm::dvec3& near);

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
