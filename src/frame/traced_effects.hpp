#pragma once

#include <span>
#include <string>
#include <vector>

#include "frame/settings.hpp"
#include "scene/scene_state.hpp"

namespace speculum {

struct PlannedPass;

// A light that a mirror bounces to something that is drawn.
struct MirroredLight {
  int light = 0;   // index into Scene::lights
  int mirror = 0;  // index into Scene::mirrors
};

// The effects that images of planes cannot show, each with what calls for it; empty if nothing that is drawn does.
struct TracedEffects {
  std::string shadows;
  std::string roughness;
  bool roughRays = false;  // roughness is traced, not looked up in images
  std::string ripple;
  std::string castsLight;
  std::string curved;
  bool curvedRays = false;  // curved mirrors are traced, not looked up in environment maps
  std::vector<MirroredLight> mirroredLights;

  // Whether any ray is traced through the scene's triangles.
  bool traces() const { return roughRays || curvedRays || !(shadows.empty() && ripple.empty()); }
  bool any() const { return traces() || !castsLight.empty(); }
};

// What these passes call for, under settings.effects; the first of them that does is named. Pure.
TracedEffects tracedEffects(const Scene& scene, const SceneState& state, const Settings& settings,
                            std::span<const PlannedPass* const> passes);

}  // namespace speculum
