#pragma once

#include <variant>

#include "edit/selection.hpp"
#include "scene/scene_state.hpp"

namespace speculum {

// A thing of a scene by itself.
using Thing = std::variant<std::monostate, Object, PointLight, Mirror>;

// Nothing for a selection that the scene does not hold.
Thing thingOf(const Scene& scene, const Selection& selection);

// Where a thing is taken hold of, in the world: an object's origin, or the middle of its bounding sphere if the origin
// lies outside it; a light's centre; the middle of a mirror.
glm::dvec3 pivotOf(const Scene& scene, const SceneState& state, const Selection& selection);
// Of a sphere about the pivot that holds the thing, metres.
double reachOf(const Scene& scene, const SceneState& state, const Selection& selection);

// The instance of an object's copy; null if there is none.
const InstanceState* instanceOf(const SceneState& state, const Selection& selection);

// The thing moved by so many metres of the world, as it stands at `time`. An object's copies all move.
Thing moved(const Thing& thing, const glm::dvec3& by, double time);

// The thing turned about a point of the world, as it stands at `time`. Copies turn each about its own place; `copy` is
// the one that turns about the pivot. Lights do not turn.
Thing turned(const Thing& thing, const glm::dmat3& rotation, const glm::dvec3& pivot, int copy, double time);

// Pitch, yaw and roll in degrees of R = Ry Rx Rz, of all that give the rotation those nearest to `near`. At a pitch of
// 90 degrees, where yaw and roll turn about one axis, the roll is that of `near`.
glm::dvec3 pitchYawRoll(const glm::dmat3& rotation, const glm::dvec3& near);

}  // namespace speculum
