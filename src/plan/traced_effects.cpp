#include "plan/traced_effects.hpp"

#include <algorithm>

#include "geometry/polygon.hpp"
#include "plan/frame_plan.hpp"
#include "plan/shadow_map.hpp"
#include "plan/view.hpp"
#include "scene/material_mirrors.hpp"

namespace speculum {

namespace {

bool isBlack(const glm::dvec3& color) {
  return color == glm::dvec3(0.0);
}

bool mayTrace(const Scene& scene, const Settings& settings) {
  return settings.reflection.method != ReflectionMethod::raster ||
         std::ranges::any_of(scene.lights, &PointLight::castsShadow) || hasCurvedMirrors(scene) ||
         std::ranges::any_of(scene.mirrors, [](const Mirror& m) {
           return m.roughness > 0.0 || m.ripple || m.castsLight || m.quality.method;
         });
}

// Surfaces in the passes that light falls on.
struct Lit {
  RecycledVector<bool> instances;  // by index into SceneState::instances
  bool anyInstance = false;
  bool mirrors = false;  // a base under a reflection, or a back, is lit
};

// Collects the effects that passes call for, and what is lit in them.
class Collector {
 public:
  Collector(const Scene& scene, const SceneState& state, const EffectSettings& settings)
      : scene_(scene), state_(state), settings_(settings) {
    lit_.instances.resize(state.instances.size());
  }

  void add(const Pass& pass) {
    for (const int i : pass.instances) {
      lit_.instances[i] = true;
      lit_.anyInstance = true;
      const int object = state_.instances[i].object;
      if (settings_.curved && !effects_.curved && curvedMirrorOf(scene_, state_.instances[i])) {
        effects_.curvedRays = settings_.curvedLookup == CurvedLookup::traced;
        effects_.curved = nameOf<RecycledString>("object", scene_.objects[object].name, object);
      }
    }
    for (const MirrorDraw& draw : pass.mirrors) {
      add(draw);
    }
  }

  TracedEffects finish() {
    addBouncedLights();
    addShadows();
    return std::move(effects_);
  }

 private:
  void add(const MirrorDraw& draw) {
    const Mirror& mirror = scene_.mirror(draw.mirror);
    const MirrorOptics optics = opticsOf(mirror, settings_);
    lit_.mirrors = lit_.mirrors || !isBlack(draw.back ? optics.backColor : optics.baseColor);
    const bool rough = optics.alpha > 0.0 && (draw.byRays || draw.blurs);
    effects_.roughRays = effects_.roughRays || (rough && draw.byRays);
    if (rough && !effects_.roughness) {
      effects_.roughness = nameOf<RecycledString>("mirror", mirror.name, draw.mirror);
    }
    const bool rippled = optics.ripple && (draw.byRays || draw.ripples);
    effects_.rippleRays = effects_.rippleRays || (rippled && draw.byRays);
    effects_.mirrorRays = effects_.mirrorRays || (draw.byRays && !rough && !rippled);
    if (rippled && !effects_.ripple) {
      effects_.ripple = nameOf<RecycledString>("mirror", mirror.name, draw.mirror);
    }
  }

  bool anythingLit() const { return lit_.mirrors || lit_.anyInstance || effects_.reflects(); }

  void addShadows() {
    const RecycledVector<int> lights =
        settings_.shadows && anythingLit() ? shadowLights(scene_) : RecycledVector<int>();
    if (lights.empty()) {
      return;
    }
    effects_.shadows = nameOf<RecycledString>("light", scene_.lights[lights.front()].name, lights.front());
    // Light that a mirror reflects is shadowed before and after the mirror, which no map of the light shows.
    const bool asksForMaps = settings_.shadowLookup != ShadowLookup::traced;
    const bool fits = !asksForMaps || fitsShadowMaps(scene_);
    if (!fits) {
      effects_.shadows->append("; traced: too many lights or objects for maps");
    }
    effects_.shadowMaps = asksForMaps && fits && !effects_.castsLight;
    effects_.hybridShadows = effects_.shadowMaps && settings_.shadowLookup == ShadowLookup::hybrid;
    effects_.shadowRays = !effects_.shadowMaps || effects_.hybridShadows || effects_.reflects();
  }

  void addBouncedLights() {
    for (size_t m = 0; settings_.castsLight && anythingLit() && m < scene_.mirrorCount(); ++m) {
      for (size_t i = 0; scene_.mirror(m).castsLight && i < scene_.lights.size(); ++i) {
        const BouncedLight path{static_cast<int>(i), static_cast<int>(m)};
        if (bounces(path) && reachesSomething(path)) {
          effects_.bouncedLights.push_back(path);
        }
      }
    }
    if (!effects_.bouncedLights.empty()) {
      const int mirror = effects_.bouncedLights.front().mirror;
      effects_.castsLight = nameOf<RecycledString>("mirror", scene_.mirror(mirror).name, mirror);
    }
  }

  double heightOf(const BouncedLight& path) const {
    const MirrorState& mirror = state_.mirrors[path.mirror];
    return glm::dot(mirror.normal, state_.lights[path.light].position - mirror.origin);
  }

  bool bounces(const BouncedLight& path) const {
    const PointLight& light = scene_.lights[path.light];
    const double height = heightOf(path);
    return !isBlack(light.color * light.intensity) &&
           (height > 0.0 || (height < 0.0 && scene_.mirror(path.mirror).twoSided));
  }

  // Says whether the reflected light reaches something drawn. The light's mirror image shines through the mirror's
  // polygon as through a window, and lights only objects that meet the cone through the polygon.
  bool reachesSomething(const BouncedLight& path) const {
    if (lit_.mirrors || effects_.reflects()) {
      return true;
    }
    const MirrorState& mirror = state_.mirrors[path.mirror];
    const glm::dvec3 image = reflectPoint(state_.lights[path.light].position, {mirror.origin, mirror.normal});
    const double side = heightOf(path) > 0.0 ? 1.0 : -1.0;
    for (size_t i = 0; i < lit_.instances.size(); ++i) {
      if (lit_.instances[i] && shinesOn(state_.instances[i], mirror, image, side)) {
        return true;
      }
    }
    return false;
  }

  static bool shinesOn(const InstanceState& instance, const MirrorState& mirror, const glm::dvec3& image, double side) {
    bool inside = side * glm::dot(mirror.normal, instance.center - mirror.origin) > -instance.radius;
    for (size_t k = 0; inside && k < mirror.polygon.size(); ++k) {
      const glm::dvec3 a = mirror.polygon[k] - image;
      const glm::dvec3 b = mirror.polygon[(k + 1) % mirror.polygon.size()] - image;
      // Points inwards: the polygon is counter-clockwise seen from the front, and the light's image lies behind it.
      const glm::dvec3 normal = side * glm::cross(a, b);
      inside = glm::dot(normal, instance.center - image) >= -instance.radius * glm::length(normal);
    }
    return inside;
  }

  const Scene& scene_;
  const SceneState& state_;
  const EffectSettings& settings_;
  Lit lit_;
  TracedEffects effects_;
};

}  // namespace

RecycledVector<int> shadowLights(const Scene& scene) {
  RecycledVector<int> lights;
  for (size_t i = 0; i < scene.lights.size(); ++i) {
    const PointLight& light = scene.lights[i];
    if (light.castsShadow && !isBlack(light.color * light.intensity)) {
      lights.push_back(static_cast<int>(i));
    }
  }
  return lights;
}

TracedEffects tracedEffects(const Scene& scene, const SceneState& state, const Settings& settings,
                            std::span<const Pass* const> passes) {
  if (!mayTrace(scene, settings)) {
    return {};
  }
  Collector collector(scene, state, settings.effects);
  for (const Pass* pass : passes) {
    collector.add(*pass);
  }
  return collector.finish();
}

AskedEffects askedEffects(const Scene& scene, const EffectSettings& settings) {
  AskedEffects asked{.shadows = settings.shadows && !shadowLights(scene).empty(),
                     .curved = settings.curved && hasCurvedMirrors(scene)};
  for (const Mirror& mirror : scene.mirrors) {
    const MirrorOptics optics = opticsOf(mirror, settings);
    asked.castsLight = asked.castsLight || (settings.castsLight && mirror.castsLight);
    asked.ripple = asked.ripple || optics.ripple;
    asked.rough = asked.rough || optics.alpha > 0.0;
  }
  return asked;
}

}  // namespace speculum
