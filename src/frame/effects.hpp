#pragma once

#include <string>
#include <vector>

#include "frame/frame_plan.hpp"

namespace speculum {

enum class EffectKind {
  shadows,
  roughness,
  ripple,
  castsLight,
  fresnel,
  textures,
  msaa,
  toneMap,
  glyphs,
  wireframe,
  curved,
  count
};

// An effect, whether something visible calls for it, and what that is, or why nothing does.
struct Effect {
  std::string name;
  bool calledFor = false;
  std::string why;
};

// Settings that leave an effect out of the picture, at least one.
std::vector<SettingChange> settingsWithout(EffectKind effect);

// Says whether something with a texture is drawn, or seen in an image that is reused.
bool drawsTextures(const Scene& scene, const SceneState& state, const Settings& settings, const FramePlan& plan);

// All effects, in the order of EffectKind.
std::vector<Effect> effectsOf(const Scene& scene, const SceneState& state, const Settings& settings,
                              const FramePlan& plan);

}  // namespace speculum
