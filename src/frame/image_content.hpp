#pragma once

#include <cstdint>
#include <span>
#include <utility>

#include "frame/frame_plan.hpp"
#include "frame/scene_changes.hpp"
#include "geometry/recycled_memory.hpp"

namespace speculum {

// State that all images of a frame share.
struct ImageSurroundings {
  const Scene& scene;
  const SceneState& state;
  const Settings& settings;
  const Projection& projection;
  const TracedEffects& effects;                   // of all passes
  const SceneChanges* changes;                    // up to this frame; null: unchanged images are not looked for
  RecycledVector<std::pair<int, uint64_t>> maps;  // environment maps that may be looked up: instance, their serial
  uint64_t shadowSerial = 0;                      // largest Cube::serial of a shadow map
};

// Returns, as numbers, everything but settings, meshes and textures that the image of a mirror depends on: views, what
// they show, and when any of that last changed. Images with equal content, under settings that sameMirrorImages() calls
// equal, are the same bit for bit. `passes` are the mirror's and those of all mirrors seen in it. If any of them traces
// rays or looks up an environment map, the image depends on the whole scene, and on the time if rays may meet ripples.
// `around` has changes.
RecycledVector<uint64_t> imageContent(const ImageSurroundings& around, const View& main,
                                      std::span<const Pass* const> passes);

// Returns, as numbers, everything that the texels of a shadow map's face depend on if `casters` are drawn into it.
RecycledVector<uint64_t> shadowContent(const SceneChanges& changes, const Pass& face, const Pass& casters);

}  // namespace speculum
