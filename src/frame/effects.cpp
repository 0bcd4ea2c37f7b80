#include "frame/effects.hpp"

#include <algorithm>
#include <set>

namespace speculum {

namespace {

// What at least one pass of the plan draws.
struct Visible {
  std::set<int> instances;
  std::set<int> lights;
  std::set<int> mirrorFronts;
};

Visible visibleIn(const FramePlan& plan) {
  Visible visible;
  const auto add = [&](const PlannedPass& pass) {
    visible.instances.insert(pass.instances.begin(), pass.instances.end());
    visible.lights.insert(pass.lights.begin(), pass.lights.end());
    for (const MirrorDraw& draw : pass.mirrors) {
      if (!draw.back) {
        visible.mirrorFronts.insert(draw.mirror);
      }
    }
  };
  std::for_each(plan.passes.begin(), plan.passes.end(), add);
  add(plan.main);
  return visible;
}

std::string nameOf(const std::string& kind, const std::string& name, int index) {
  return kind + " " + (name.empty() ? std::to_string(index) : "'" + name + "'");
}

template <typename Predicate>
Effect mirrorEffect(const std::string& name, const Scene& scene, const Visible& visible, Predicate wants) {
  for (const int i : visible.mirrorFronts) {
    if (wants(scene.mirrors[i])) {
      return {name, true, nameOf("mirror", scene.mirrors[i].name, i)};
    }
  }
  return {name, false, "no visible mirror asks for it"};
}

// An effect of the scene format that this version does not draw.
Effect notDrawn(Effect effect) {
  if (effect.calledFor) {
    effect = {effect.name, false, "asked for by " + effect.why + ", not drawn by this version"};
  }
  return effect;
}

Effect textures(const Scene& scene, const SceneState& state, const Visible& visible) {
  for (const int i : visible.instances) {
    const InstanceState& instance = state.instances[i];
    const Mesh& mesh = scene.meshes[instance.mesh];
    for (const MeshPart& part : mesh.parts) {
      if (part.material.diffuseTexture >= 0) {
        return {"textures", true,
                nameOf("object", scene.objects[instance.object].name, instance.object) + " with " +
                    mesh.source.filename().string()};
      }
    }
  }
  return {"textures", false, "no visible object has one"};
}

Effect shadows(const Scene& scene) {
  for (size_t i = 0; i < scene.lights.size(); ++i) {
    if (scene.lights[i].castsShadow) {
      return {"shadows", true, nameOf("light", scene.lights[i].name, static_cast<int>(i))};
    }
  }
  return {"shadows", false, "no light casts them"};
}

Effect glyphs(const Scene& scene, const Visible& visible) {
  if (visible.lights.empty()) {
    return {"glyphs", false, "no light's glyph is in view"};
  }
  const int first = *visible.lights.begin();
  return {"glyphs", true, nameOf("light", scene.lights[first].name, first)};
}

Effect multisampling(const Settings& settings, const FramePlan& plan) {
  if (settings.view.samples > 1) {
    return {"msaa", true, "view.samples = " + std::to_string(settings.view.samples)};
  }
  if (settings.reflection.samples > 1 && (!plan.passes.empty() || !plan.held.empty())) {
    return {"msaa", true, "reflection.samples = " + std::to_string(settings.reflection.samples)};
  }
  return {"msaa", false, "one sample a pixel"};
}

}  // namespace

std::vector<Effect> effectsOf(const Scene& scene, const SceneState& state, const Settings& settings,
                              const FramePlan& plan) {
  const Visible visible = visibleIn(plan);
  const bool aces = settings.view.toneMap == ToneMap::aces;
  return {
      notDrawn(shadows(scene)),
      notDrawn(mirrorEffect("roughness", scene, visible, [](const Mirror& m) { return m.roughness > 0.0; })),
      notDrawn(mirrorEffect("ripple", scene, visible,
                            [](const Mirror& m) { return m.ripple && m.ripple->amplitude != 0.0; })),
      notDrawn(mirrorEffect("casts_light", scene, visible, [](const Mirror& m) { return m.castsLight; })),
      mirrorEffect("fresnel", scene, visible, [](const Mirror& m) { return m.fresnel == Fresnel::schlick; }),
      textures(scene, state, visible),
      multisampling(settings, plan),
      {"tone_map", aces, aces ? "view.tone_map = aces" : "view.tone_map = clamp"},
      glyphs(scene, visible),
      {"wireframe", settings.view.wireframe,
       settings.view.wireframe ? "view.wireframe = true" : "view.wireframe = false"},
      {"curved", false, "no object is a mirror"},
  };
}

}  // namespace speculum
