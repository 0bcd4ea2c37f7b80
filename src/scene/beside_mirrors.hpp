#pragma once

#include <optional>
#include <span>

#include "scene/scene_state.hpp"

namespace speculum {

// Returns the point beside a light that is farther from planes of mirrors than rounding can move it, so that light is
// hidden on one side of a mirror only. A light within MirrorState::slack of a plane comes in front of the plane's first
// mirror. With `eye`, the point is for shaders, whose positions are floats relative to that eye.
glm::dvec3 besideMirrors(const glm::dvec3& light, std::span<const MirrorState> mirrors,
                         const std::optional<glm::dvec3>& eye = {});

}  // namespace speculum
