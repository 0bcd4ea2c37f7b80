#include "frame/image_content.hpp"

#include <algorithm>

#include "frame/content_numbers.hpp"

namespace speculum {

namespace {

void addEffects(const ImageSurroundings& around, const View& main, ContentNumbers& numbers) {
  const TracedEffects& effects = around.effects;
  numbers.addAll(effects.any(), effects.traces(), effects.shadows.has_value(), effects.shadowMaps,
                 effects.castsLight.has_value(), static_cast<double>(effects.bouncedLights.size()));
  const bool waves = around.settings.effects.ripple && std::ranges::any_of(around.scene.mirrors, [](const Mirror& m) {
                       return m.ripple && m.ripple->speed != 0.0;
                     });
  numbers.add(waves && (effects.any() || effects.ripple) ? around.state.time : 0.0);
  if (!effects.any()) {
    return;
  }
  numbers.add(main.eye);  // origin of the space that rays are traced in
  for (const BouncedLight& bounced : effects.bouncedLights) {
    numbers.addAll(bounced.light, bounced.mirror);
  }
}

}  // namespace

RecycledVector<uint64_t> imageContent(const ImageSurroundings& around, const View& main,
                                      std::span<const Pass* const> passes) {
  ContentNumbers numbers;
  numbers.add(around.scene.environment.cleared(around.settings.view.clearColor));
  numbers.addAll(around.projection.focal, around.projection.aspect, around.projection.near, around.projection.offset);
  addEffects(around, main, numbers);
  const SceneChanges& changes = *around.changes;
  const bool all = around.effects.any() || !around.maps.empty();
  numbers.addCount(around.shadowSerial);
  for (const auto& [instance, serial] : around.maps) {
    numbers.add(instance);
    numbers.addCount(serial);
  }
  uint64_t changed = all ? changes.anyChanged() : 0;
  for (const Pass* pass : passes) {
    numbers.addAll(pass->view, pass->channels, pass->instances, pass->lights, pass->mirrors, pass->quality.samples);
    for (size_t i = 0; !all && i < pass->instances.size(); ++i) {
      changed = std::max(changed, changes.instanceChanged(pass->instances[i]));
    }
    for (const MirrorDraw& draw : pass->mirrors) {
      changed = std::max(changed, changes.mirrorChanged(draw.mirror));
    }
  }
  numbers.addCount(all);
  numbers.addCount(changed);
  numbers.addCount(changes.lightsChanged());
  return numbers.take();
}

RecycledVector<uint64_t> shadowContent(const SceneChanges& changes, const Pass& face, const Pass& casters) {
  ContentNumbers numbers;
  numbers.addAll(casters.view, face.window.low, face.window.high, face.projection.near, casters.instances);
  uint64_t changed = 0;
  for (const int i : casters.instances) {
    changed = std::max(changed, changes.placeChanged(i));
  }
  for (const MirrorDraw& draw : casters.mirrors) {
    numbers.addAll(draw.mirror, draw.polygon);
  }
  numbers.addCount(changed);
  return numbers.take();
}

}  // namespace speculum
