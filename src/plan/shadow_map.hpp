#pragma once

#include <optional>
#include <span>

#include "plan/cube_face.hpp"

namespace speculum {

// Texels on each side of a face's window: a lookup reads one beyond its own, and rounding may move it.
inline constexpr int shadowBorder = 2;

// A pass whose surfaces look shadows up, and its view, widened by what lookups read around it.
struct ShadowReader {
  const Pass* pass = nullptr;
  View readable;
  const Projection* projection = nullptr;
};

// Plans a map for each light of shadowLights(), in which the faces that a reader looks up are to be drawn. The window
// of a face is as small as the scene allows. A map's place in the target follows from its index.
PlannedCubes shadowMaps(const Scene& scene, const SceneState& state, const Settings& settings,
                        std::span<const ShadowReader> readers);

// Returns the index of the face that contains the whole scene in every map; nothing if there is none.
std::optional<size_t> onlyShadowFace(const FramePlan& plan);

bool rendersShadows(const FramePlan& plan);
bool hasShadowLayers(const FramePlan& plan);

// Texels of the target of all maps; zero without any.
glm::ivec2 shadowExtent(const FramePlan& plan);

}  // namespace speculum
