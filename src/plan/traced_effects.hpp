#pragma once

#include <optional>
#include <span>

#include "geometry/recycled_memory.hpp"
#include "scene/scene_state.hpp"
#include "settings/settings.hpp"

namespace speculum {

struct Pass;

// A light that a mirror bounces to something that is drawn.
struct BouncedLight {
  int light = 0;   // index into Scene::lights
  int mirror = 0;  // index into Scene::mirrors
};

// Returns the lights that cast shadows and are not black, as indices into Scene::lights, ascending.
RecycledVector<int> shadowLights(const Scene& scene);

// Effects that may need rays, and whether each traces rays in this frame. The string of an effect names the first node
// that calls for it; it is empty if nothing drawn does.
struct TracedEffects {
  std::optional<RecycledString> shadows;
  bool shadowMaps = false;     // surfaces that are drawn look shadows up in maps
  bool hybridShadows = false;  // shadow rays are traced where these maps do not decide
  bool shadowRays = false;     // surfaces that are drawn, or that reflected rays meet, trace shadow rays
  std::optional<RecycledString> roughness;
  bool roughRays = false;  // roughness is traced, not looked up in images
  std::optional<RecycledString> ripple;
  bool rippleRays = false;  // ripples are traced, not looked up in images
  std::optional<RecycledString> castsLight;
  std::optional<RecycledString> curved;
  bool curvedRays = false;  // curved mirrors are traced, not looked up in environment maps
  bool mirrorRays = false;  // smooth mirrors are traced, not shown by images
  RecycledVector<BouncedLight> bouncedLights;

  // Says whether any ray is traced through the scene's triangles.
  bool traces() const { return shadowRays || reflects(); }
  // Says whether rays follow reflections. They may meet anything in the scene.
  bool reflects() const { return roughRays || curvedRays || rippleRays || mirrorRays; }
  bool any() const { return traces() || castsLight; }
  // Returns the rays that a traced point sends to lights: one to each of shadowLights(), two by way of a mirror.
  size_t raysToLights(const Scene& scene) const {
    return shadowRays ? shadowLights(scene).size() + 2 * bouncedLights.size() : 0;
  }
};

// Most lights whose shadows are looked up in maps; a scene with more such lights traces all shadows.
inline constexpr size_t mostShadowMaps = 16;

// Finds the effects that these passes call for, under settings.effects. Pure.
TracedEffects tracedEffects(const Scene& scene, const SceneState& state, const Settings& settings,
                            std::span<const Pass* const> passes);

// Effects of a scene that rays or maps show, unless the settings leave them out.
struct AskedEffects {
  bool shadows = false;
  bool castsLight = false;
  bool ripple = false;
  bool rough = false;
  bool curved = false;
};
AskedEffects askedEffects(const Scene& scene, const EffectSettings& settings = {});

}  // namespace speculum
