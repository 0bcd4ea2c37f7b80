#pragma once

#include <span>

#include "geometry/recycled_memory.hpp"
#include "plan/cube_face.hpp"

namespace speculum {

// Texels on each side beyond a face's edges, so that bilinear lookups need no other face.
inline constexpr int environmentBorder = 1;
// Largest number of curved mirrors that have an environment map; scenes of more than 100 000 objects and copies have
// fewer maps. Those that cover the widest angle have one, the others show the background.
inline constexpr size_t mostEnvironmentMaps = 32;

struct EnvironmentMaps : PlannedCubes {
  size_t omitted = 0;  // curved mirrors that are drawn and have no map
};

// Plans environment maps for the curved mirrors that these passes draw, with all faces to be rendered. Returns no map
// unless effects.curved is on and effects.curved_lookup is `environment`.
EnvironmentMaps environmentMaps(const Scene& scene, const SceneState& state, const Settings& settings,
                                std::span<const Pass* const> passes);

}  // namespace speculum
