#pragma once

#include <string>
#include <vector>

#include "frame/frame_plan.hpp"

namespace speculum {

// One line of the ledger: an effect, whether something visible calls for it, and what that is.
struct Effect {
  std::string name;
  bool calledFor = false;
  std::string why;
};

// All effects in a fixed order: shadows, roughness, ripple, casts_light, fresnel, textures, msaa, tone_map, glyphs,
// wireframe, curved.
std::vector<Effect> effectsOf(const Scene& scene, const SceneState& state, const Settings& settings,
                              const FramePlan& plan);

}  // namespace speculum
