#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "frame/frame_plan.hpp"

namespace speculum {

// What the images of a frame have in common.
struct ImageSurroundings {
  const Scene& scene;
  const SceneState& state;
  const Settings& settings;
  const Projection& projection;
  const TracedEffects& effects;           // of all passes
  std::vector<std::pair<int, int>> maps;  // environment maps that may be looked up: instance, EnvironmentMap::serial
};

// Everything but settings, meshes and textures that the image of a mirror depends on, number by number: an image with
// equal content, under sameMirrorImages, is the same bit for bit. `passes` are the mirror's and those of all that is
// seen in it. Where rays are traced or an environment map is looked up in any pass, that is the whole scene, and the
// time if rays may meet ripples.
std::vector<uint64_t> imageContent(const ImageSurroundings& around, const View& main,
                                   std::span<const PlannedPass* const> passes);

}  // namespace speculum
