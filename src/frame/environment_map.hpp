#pragma once

#include <span>
#include <vector>

#include "frame/frame_plan.hpp"

namespace speculum {

// Texels of a face on each side beyond its edges, so that bilinear look-ups need no other face.
inline constexpr int environmentBorder = 1;
// Of the curved mirrors that are drawn, those that cover the widest angle have a map; others show the background.
inline constexpr size_t mostEnvironmentMaps = 32;

// The directions of the faces' images on the picture, in the order of EnvironmentMap::faces.
struct FaceAxes {
  const char* name;
  glm::dvec3 forward;  // world
  glm::dvec3 up;
};
std::span<const FaceAxes> faceAxes();

// The maps of the curved mirrors that these passes draw, all to be rendered; none unless effects.curved_lookup asks for
// them. Pure.
std::vector<EnvironmentMap> environmentMaps(const Scene& scene, const SceneState& state, const Settings& settings,
                                            std::span<const PlannedPass* const> passes);

}  // namespace speculum
