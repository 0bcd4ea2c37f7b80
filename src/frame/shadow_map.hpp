#pragma once

#include <optional>
#include <span>

#include "frame/frame_plan.hpp"
#include "geometry/recycled_memory.hpp"

namespace speculum {

// Texels on each side of a face's window: a lookup reads one beyond its own, and rounding may move it.
inline constexpr int shadowBorder = 2;

// A pass whose surfaces look shadows up, and its view, widened by what lookups read around it.
struct ShadowReader {
  const PlannedPass* pass = nullptr;
  View readable;
  const Projection* projection = nullptr;
};

// Plans a map for each light of shadowLights(), in which the faces that a reader looks up are to be rendered. The
// window of a face is as small as the scene allows.
RecycledVector<ShadowMap> shadowMaps(const Scene& scene, const SceneState& state, const Settings& settings,
                                     std::span<const ShadowReader> readers);

// Finds the faces that must be rendered: those that are read, and that differ from what the frame before left. Without
// reflection.skip_unchanged or `changes`, and if all faces together draw more than four million instances, which would
// take too much memory to compare, these are all faces that are read. In a face that changes again, what stands still
// is rendered to a layer.
void reuseShadowMaps(RecycledVector<ShadowMap>& maps, std::span<const ShadowMap> before, const Settings& settings,
                     const Scene& scene, const SceneState& state, const SceneChanges* changes);

// Name of a face's pass.
std::string shadowFaceName(const ShadowMap& map, size_t face);

// Returns the index of the face that contains the whole scene in every map; nothing if there is none.
std::optional<size_t> onlyShadowFace(std::span<const ShadowMap> maps);

bool rendersShadows(std::span<const ShadowMap> maps);
bool hasShadowLayers(std::span<const ShadowMap> maps);

// Texels of the target of all maps; zero without any.
glm::ivec2 shadowExtent(std::span<const ShadowMap> maps);
// Corner of a map's face in the target, in texels.
glm::ivec2 shadowCorner(std::span<const ShadowMap> maps, size_t map, size_t face);

}  // namespace speculum
