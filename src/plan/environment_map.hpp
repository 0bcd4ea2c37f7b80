#pragma once

#include <span>

#include "geometry/recycled_memory.hpp"
#include "plan/cube_face.hpp"

namespace speculum {

// Texels on each side beyond a face's edges, so that bilinear lookups need no other face.
inline constexpr int environmentBorder = 1;
// Curved mirrors that may have a map: those that cover the widest angle, fewer in scenes of more than 100 000 objects
// and copies. Others show the background.
inline constexpr size_t mostEnvironmentMaps = 32;

struct EnvironmentMaps : PlannedCubes {
  size_t omitted = 0;  // curved mirrors that are drawn and have none
};

// Plans maps for the curved mirrors that these passes draw, all to be rendered. None unless effects.curved_lookup is
// `environment`.
EnvironmentMaps environmentMaps(const Scene& scene, const SceneState& state, const Settings& settings,
                                std::span<const Pass* const> passes);

}  // namespace speculum
