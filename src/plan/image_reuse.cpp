#include "plan/image_reuse.hpp"

#include <algorithm>

#include "plan/content_numbers.hpp"

namespace speculum {

namespace {

bool canReuse(const CachedImage& image, const ReuseRequest& request) {
  return sameMirrorImages(image.settings, request.settings) && image.samples == request.samples &&
         image.view.pictureSize == request.view.pictureSize &&
         (unmoved(image, request.view, request.projection, request.visible) ||
          covers(image, request.view, request.visible));
}

// Returns the margin, in pixels on each side, that a new image needs to serve until it is due, if the motion since
// `image` goes on.
int marginFor(const CachedImage& image, const ReuseRequest& request, int due) {
  constexpr double reserve = 1.25;  // motion is not quite even
  constexpr double least = 2.0;     // pixels
  if (image.view.pictureSize != request.view.pictureSize) {
    return 0;
  }
  const double most = largestMargin * request.view.pictureSize.y;
  const double perFrame = largestShift(image, request.view, request.projection, request.visible) / image.age;
  // After a cut, or in motion too fast for even the next frame, a margin would be wasted.
  if (due == 1 || perFrame == 0.0 || !(perFrame < most)) {
    return 0;
  }
  return static_cast<int>(std::min(most, reserve * perFrame * (due - 1) + least));
}

auto imageOf(std::span<const CachedImage> images, int mirror) {
  return std::ranges::find(images, mirror, &CachedImage::mirror);
}

void addEffects(const ImageSurroundings& around, const View& main, ContentNumbers& numbers) {
  const TracedEffects& effects = around.effects;
  numbers.addAll(effects.any(), effects.traces(), effects.shadows.has_value(), effects.shadowMaps,
                 effects.hybridShadows, effects.castsLight.has_value(),
                 static_cast<double>(effects.bouncedLights.size()));
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

bool sameDrawing(const Settings& a, const Settings& b) {
  return sameMirrorImages(a, b) && a.debug == b.debug;
}

ImageChoice chooseImage(std::span<const CachedImage> images, const ReuseRequest& request) {
  const auto before = imageOf(images, request.view.path.back());
  const bool exists = before != images.end();
  const int left = exists ? std::min(before->due, request.interval) - before->age : 0;  // frames
  if (left > 0 && canReuse(*before, request)) {
    ImageChoice cached{.image = *before};
    ++cached.image.age;
    cached.image.pass = -1;
    cached.image.cacheIndex = static_cast<int>(before - images.begin());
    cached.moved = !unmoved(*before, request.view, request.projection, request.visible);
    return cached;
  }
  // New images, such as all of the first frame, become due in different frames. An image that is rendered before it is
  // due keeps its turn.
  const int due = left > 0 ? left : exists ? request.interval : request.interval - request.order % request.interval;
  ImageChoice fresh{.image = {.mirror = request.view.path.back(),
                              .view = request.view,
                              .projection = request.projection,
                              .visible = {request.visible.begin(), request.visible.end()},
                              .settings = request.settings,
                              .samples = request.samples,
                              .due = due}};
  if (const int pixels = exists ? marginFor(*before, request, due) : 0; pixels > 0) {
    widen(fresh.image.view, request.projection, pixels);
  }
  return fresh;
}

void reuseIfUnchanged(CachedImage& image, std::span<const CachedImage> images, const ImageSurroundings& around,
                      const View& main, std::span<const Pass* const> passes) {
  image.content = imageContent(around, main, passes);
  const auto before = imageOf(images, image.mirror);
  if (before != images.end() && before->content == image.content && sameDrawing(before->settings, around.settings)) {
    constexpr int mostFrames = 1'000'000'000;  // largest count: days without a change
    image.unchangedFor = std::min(before->unchangedFor + before->age, mostFrames);
    image.cacheIndex = static_cast<int>(before - images.begin());
  }
}

bool reuseMain(FramePlan& plan, const MainImage* before, const ImageSurroundings& around) {
  const bool renders =
      std::ranges::any_of(plan.passes, [&](const Pass& pass) { return pass.drawn() && &pass != &plan.main(); });
  const bool reprojects = std::ranges::any_of(plan.main().mirrors,
                                              [](const MirrorDraw& draw) { return draw.cached && draw.cached->moved; });
  if (renders || reprojects) {
    return false;
  }
  const Pass* main = &plan.main();
  plan.mainContent = imageContent(around, main->view, {&main, 1});
  const bool same = before && before->content == plan.mainContent && sameMainView(before->settings, around.settings);
  plan.main().source = same && !before->encoded ? PassSource::reused : PassSource::drawn;
  return same;
}

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
    numbers.addAll(pass->view, pass->channels, pass->instances, pass->lights, pass->mirrors, pass->quality.samples,
                   pass->shownIn.samples);
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

RecycledVector<uint64_t> shadowContent(const ImageSurroundings& around, int picture, const Pass& face,
                                       const Pass& casters) {
  const SceneChanges& changes = *around.changes;
  const EffectSettings& effects = around.settings.effects;
  const bool covered = std::ranges::any_of(casters.instances, [&](int i) {
    return isTransparent(around.scene.meshes[around.state.instances[i].mesh], effects);
  });
  ContentNumbers numbers;
  // Marks of edges show neither opacity nor its thresholds.
  const bool thresholds = covered && !around.effects.hybridShadows;
  numbers.addCount(thresholds ? 2 * static_cast<uint64_t>(picture) + (effects.textures ? 2 : 1) : covered);
  numbers.addAll(around.effects.hybridShadows, casters.view, face.window.low, face.window.high, face.projection.near,
                 casters.instances);
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
