#pragma once

#include <optional>
#include <span>

#include "plan/cube_face.hpp"

namespace speculum {

// Texels on each side of a face's window: a lookup reads one texel beyond its own, and rounding may move the lookup.
inline constexpr int shadowBorder = 2;

// Says whether the lights and objects are few enough for shadow maps; otherwise all shadows are traced.
bool fitsShadowMaps(const Scene& scene);

// A pass whose surfaces look shadows up. `readable` is its view, widened by what lookups read around its edge.
struct ShadowReader {
  const Pass* pass = nullptr;
  View readable;
  const Projection* projection = nullptr;
};

// Plans a shadow map for each light of shadowLights(). Faces that a reader looks up are to be drawn, the others are
// unread. The window of a face is as small as the scene allows. Only faces with casters have room in the target,
// all of the size of the largest face.
PlannedCubes shadowMaps(const Scene& scene, const SceneState& state, const Settings& settings,
                        std::span<const ShadowReader> readers);

// Returns the index of the face that contains the whole scene in every map; nothing if there is no such face.
std::optional<size_t> onlyShadowFace(const FramePlan& plan);

// Say whether the frame draws a face of a shadow map, and whether a face has a layer (Pass::layer).
bool rendersShadows(const FramePlan& plan);
bool hasShadowLayers(const FramePlan& plan);

// Returns the texels of each side of the largest face; zero without shadow maps.
int shadowMapSize(const FramePlan& plan);

// Returns the size in texels of the target that holds all shadow maps; zero without shadow maps.
glm::ivec2 shadowExtent(const FramePlan& plan);

}  // namespace speculum
