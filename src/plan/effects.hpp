#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "plan/frame_plan.hpp"

namespace speculum {

enum class EffectKind {
  shadows,
  roughness,
  ripple,
  castsLight,
  fresnel,
  textures,
  transparency,
  msaa,
  toneMap,
  glyphs,
  wireframe,
  curved,
  count
};

// An effect and whether the picture calls for it. `why` names the visible node or the setting that does, or says why
// nothing does.
struct Effect {
  EffectKind kind = EffectKind::count;
  std::string name;
  bool calledFor = false;
  std::string why;
  bool switchedOff = false;  // by its setting
};

// Cost of an effect in the last recorded frame.
struct EffectCost {
  uint32_t draws = 0;
  uint64_t bytes = 0;      // of device objects that the effect needs; effects that trace rays share these objects
  uint32_t pipelines = 0;  // pipelines that exist
};

// Returns the settings (at least one) that leave an effect out of the picture.
std::vector<SettingChange> settingsWithout(const Effect& effect);

// Says whether an object with a texture is drawn, or seen in a cached image.
bool drawsTextures(const Scene& scene, const SceneState& state, const Settings& settings, const FramePlan& plan);

// Says the same of objects with a material that is drawn with coverage.
bool drawsTransparency(const Scene& scene, const SceneState& state, const Settings& settings, const FramePlan& plan);

// Returns all effects, in a fixed order.
std::vector<Effect> effectsOf(const Scene& scene, const SceneState& state, const Settings& settings,
                              const FramePlan& plan);

}  // namespace speculum
