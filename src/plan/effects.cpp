#include "plan/effects.hpp"

#include <algorithm>

#include "plan/view.hpp"
#include "scene/material_mirrors.hpp"

namespace speculum {

namespace {

// Nodes that at least one pass of the plan draws, ascending. Passes that cached images replace count too.
struct Visible {
  RecycledVector<int> instances;
  RecycledVector<int> lights;
  RecycledVector<int> mirrorFronts;
};

Visible visibleIn(const Scene& scene, const SceneState& state, const FramePlan& plan) {
  RecycledVector<bool> instances(state.instances.size());
  RecycledVector<bool> lights(scene.lights.size());
  RecycledVector<bool> fronts(scene.mirrorCount());
  forEachSeen(plan, [&](const Pass& pass) {
    std::ranges::for_each(pass.instances, [&](int i) { instances[i] = true; });
    std::ranges::for_each(pass.lights, [&](int i) { lights[i] = true; });
    for (const MirrorDraw& draw : pass.mirrors) {
      fronts[draw.mirror] = fronts[draw.mirror] || !draw.back;
    }
  });
  const auto indices = [](const RecycledVector<bool>& chosen) {
    RecycledVector<int> list;
    for (size_t i = 0; i < chosen.size(); ++i) {
      if (chosen[i]) {
        list.push_back(static_cast<int>(i));
      }
    }
    return list;
  };
  return {indices(instances), indices(lights), indices(fronts)};
}

Effect fresnel(const Scene& scene, const SceneState& state, const Settings& settings, const Visible& visible) {
  for (const int i : visible.instances) {
    const int object = state.instances[i].object;
    const std::optional<ObjectMirror> mirror = curvedMirrorOf(scene, state.instances[i]);
    if (settings.effects.curved && mirror && opticsOf(*mirror, settings.effects).fresnel == Fresnel::schlick) {
      return {EffectKind::fresnel, "fresnel", true, nameOf("object", scene.objects[object].name, object)};
    }
  }
  for (const int i : visible.mirrorFronts) {
    if (opticsOf(scene.mirror(i), settings.effects).fresnel == Fresnel::schlick) {
      return {EffectKind::fresnel, "fresnel", true, nameOf("mirror", scene.mirror(i).name, i)};
    }
  }
  return {EffectKind::fresnel, "fresnel", false, "no visible mirror asks for it"};
}

Effect tracedEffect(EffectKind kind, const std::string& name, const std::optional<RecycledString>& caller,
                    const std::string& otherwise) {
  return {kind, name, caller.has_value(), caller ? std::string(*caller) : otherwise};
}

// Returns the effect that the first visible object calls for that has a material with the property.
template <typename Predicate>
Effect ofMaterials(EffectKind kind, const std::string& name, const std::string& otherwise, const Scene& scene,
                   const SceneState& state, const Visible& visible, const Predicate& callsFor) {
  for (const int i : visible.instances) {
    const InstanceState& instance = state.instances[i];
    const Mesh& mesh = scene.meshes[instance.mesh];
    const auto calls = [&](const MeshPart& part) { return callsFor(scene.objects[instance.object], part.material); };
    if (std::ranges::any_of(mesh.parts, calls)) {
      return {kind, name, true,
              nameOf("object", scene.objects[instance.object].name, instance.object) + " with " +
                  mesh.source.filename().string()};
    }
  }
  return {kind, name, false, otherwise};
}

Effect textures(const Scene& scene, const SceneState& state, const Settings& settings, const Visible& visible) {
  for (const int i : visible.mirrorFronts) {
    if (opticsOf(scene.mirror(i), settings.effects).map >= 0) {
      return {EffectKind::textures, "textures", true, nameOf("mirror", scene.mirror(i).name, i)};
    }
  }
  return ofMaterials(
      EffectKind::textures, "textures", "no visible object or mirror has one", scene, state, visible,
      [&](const Object&, const Material& material) {
        return settings.effects.textures &&
               (material.diffuseTexture >= 0 || (material.opacityTexture >= 0 && settings.effects.transparency));
      });
}

Effect transparency(const Scene& scene, const SceneState& state, const Settings& settings, const Visible& visible) {
  return ofMaterials(EffectKind::transparency, "transparency", "no visible object is transparent", scene, state,
                     visible, [&](const Object& object, const Material& material) {
                       return isTransparent(material, settings.effects) && !(object.mirror && settings.effects.curved);
                     });
}

Effect glyphs(const Scene& scene, const Visible& visible) {
  if (visible.lights.empty()) {
    return {EffectKind::glyphs, "glyphs", false, "no light's glyph is in view"};
  }
  const int first = visible.lights.front();
  return {EffectKind::glyphs, "glyphs", true, nameOf("light", scene.lights[first].name, first)};
}

Effect multisampling(const Settings& settings, const FramePlan& plan) {
  if (settings.view.samples > 1) {
    return {EffectKind::msaa, "msaa", true, "view.samples = " + std::to_string(settings.view.samples)};
  }
  int samples = 1;  // of mirror images
  forEachSeen(plan, [&](const Pass& pass) { samples = std::max(samples, pass.quality.samples); });
  if (samples > 1) {
    const std::string key = samples == settings.reflection.samples ? "reflection.samples = " : "quality.samples = ";
    return {EffectKind::msaa, "msaa", true, key + std::to_string(samples)};
  }
  const bool mean = settings.view.accumulate > 1;
  return {EffectKind::msaa, "msaa", false, mean ? "the mean of pictures smooths edges" : "one sample a pixel"};
}

}  // namespace

std::vector<SettingChange> settingsWithout(const Effect& effect) {
  switch (effect.kind) {
    case EffectKind::msaa:
      return {{"view.samples", "1"}, {"reflection.samples", "1"}};
    case EffectKind::toneMap:
      return {{"view.tone_map", "clamp"}};
    case EffectKind::wireframe:
      return {{"view.wireframe", "false"}};
    default:  // switched by the setting effects.NAME
      return {{"effects." + effect.name, "false"}};
  }
}

bool drawsTextures(const Scene& scene, const SceneState& state, const Settings& settings, const FramePlan& plan) {
  if (scene.textures.empty() || !settings.effects.textures) {
    return false;
  }
  // What casts a shadow need not be seen.
  const auto castsByTexture = [&](int i) {
    return std::ranges::any_of(scene.meshes[state.instances[i].mesh].parts, [&](const MeshPart& part) {
      return part.material.opacityTexture >= 0 && isTransparent(part.material, settings.effects);
    });
  };
  return textures(scene, state, settings, visibleIn(scene, state, plan)).calledFor ||
         std::ranges::any_of(plan.passes, [&](const Pass& pass) {
           return pass.id.kind == PassKind::shadow && std::ranges::any_of(pass.instances, castsByTexture);
         });
}

bool drawsTransparency(const Scene& scene, const SceneState& state, const Settings& settings, const FramePlan& plan) {
  return std::ranges::any_of(scene.meshes, [&](const Mesh& mesh) { return isTransparent(mesh, settings.effects); }) &&
         transparency(scene, state, settings, visibleIn(scene, state, plan)).calledFor;
}

std::vector<Effect> effectsOf(const Scene& scene, const SceneState& state, const Settings& settings,
                              const FramePlan& plan) {
  const Visible visible = visibleIn(scene, state, plan);
  const TracedEffects& traced = plan.effects;
  const bool aces = settings.view.toneMap == ToneMap::aces;
  const bool wire = settings.view.wireframe;
  std::vector<Effect> effects = {
      tracedEffect(EffectKind::shadows, "shadows", traced.shadows, "no light casts them on what is drawn"),
      tracedEffect(EffectKind::roughness, "roughness", traced.roughness, "no visible mirror is rough"),
      tracedEffect(EffectKind::ripple, "ripple", traced.ripple, "no visible mirror has ripples"),
      tracedEffect(EffectKind::castsLight, "casts_light", traced.castsLight, "no mirror casts light on what is drawn"),
      fresnel(scene, state, settings, visible),
      textures(scene, state, settings, visible),
      transparency(scene, state, settings, visible),
      multisampling(settings, plan),
      {EffectKind::toneMap, "tone_map", aces, aces ? "view.tone_map = aces" : "view.tone_map = clamp"},
      glyphs(scene, visible),
      {EffectKind::wireframe, "wireframe", wire, wire ? "view.wireframe = true" : "view.wireframe = false"},
      tracedEffect(EffectKind::curved, "curved", traced.curved, "no visible object is a mirror")};
  for (Effect& effect : effects) {
    const std::string key = "effects." + effect.name;
    effect.switchedOff = settingValue(settings, key) == "false";
    effect.why = effect.switchedOff ? key + " = false" : effect.why;
  }
  return effects;
}

}  // namespace speculum
