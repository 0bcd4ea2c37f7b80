#include "plan/image_reuse.hpp"

#include <algorithm>
#include <optional>

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

uint64_t largestSerial(std::span<const Cube> cubes) {
  uint64_t serial = 0;
  for (const Cube& cube : cubes) {
    serial = std::max(serial, cube.serial);
  }
  return serial;
}

// Appends a face of the plan's last cube to the plan's list of passes.
void addFace(FramePlan& plan, Pass face) {
  face.cube = static_cast<int>(plan.cubes.size()) - 1;
  if (!face.isLayer) {
    plan.cubes.back().faces[static_cast<size_t>(face.id.face)] = static_cast<int>(plan.passes.size());
  }
  plan.passes.push_back(std::move(face));
}

// Returns the face with only the casters that stand still, or with only those that move.
Pass castersOf(Pass face, bool still, const Scene& scene, const SceneState& state) {
  const auto isOther = [&](int instance) {
    const int object = state.instances[static_cast<size_t>(instance)].object;
    return spins(scene.objects[static_cast<size_t>(object)]) == still;
  };
  std::erase_if(face.instances, isOther);
  std::erase_if(face.partial, [&](const PartialInstance& partial) { return isOther(partial.instance); });
  std::erase_if(face.mirrors,
                [&](const MirrorDraw& draw) { return spins(scene.mirror(static_cast<size_t>(draw.mirror))) == still; });
  return face;
}

bool castsNothing(const Pass& face) {
  return face.instances.empty() && face.mirrors.empty();
}

// Moves the casters of the face that stand still to a layer and returns the layer; the face keeps the moving casters.
// Returns nothing, and leaves the face as it is, if all casters stand still or all move.
std::optional<Pass> divided(Pass& face, const ImageSurroundings& around) {
  Pass moving = castersOf(face, false, around.scene, around.state);
  Pass layer = castersOf(face, true, around.scene, around.state);
  if (castsNothing(moving) || castsNothing(layer)) {
    return std::nullopt;
  }
  layer.isLayer = true;
  face = std::move(moving);
  return layer;
}

// Says whether settings draw the same image bit for bit. debug.* counts too, which sameMirrorImages leaves out.
bool sameDrawing(const Settings& a, const Settings& b) {
  return sameMirrorImages(a, b) && a.debug == b.debug;
}

// Says whether settings make the same environment maps. reflection.* does not count, because mirrors in maps show the
// background.
bool sameMaps(const Settings& a, Settings b) {
  b.reflection = a.reflection;
  b.view.scale = a.view.scale;
  return sameDrawing(a, b);
}

// Returns, as numbers, everything but settings, meshes and textures that the image of a mirror depends on: views, the
// nodes in them, and when any of these nodes last changed. Images with equal content, under settings that
// sameMirrorImages() calls equal, are the same bit for bit. `passes` are the pass of the mirror and the passes of all
// mirrors seen in it. If the frame traces rays or looks up environment maps, the image depends on the whole scene, and
// on the time if rays may meet ripples. `around.changes` must not be null.
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

// Reuses the map that the frame before had of the same mirror, if possible, and says whether it did.
bool reuseMap(Cube& map, std::span<const Pass> faces, std::span<const Cube> maps, const ImageSurroundings& around,
              const View& main) {
  const int interval = around.settings.effects.environmentInterval;
  for (size_t i = 0; around.changes && i < faces.size(); ++i) {
    const Pass* face = &faces[i];
    map.content[i] = imageContent(around, main, {&face, 1});
  }
  const auto before = std::ranges::find_if(maps, [&](const Cube& other) {
    return other.object == map.object && other.copy == map.copy && other.mesh == map.mesh;
  });
  if (before == maps.end() || !sameMaps(before->settings, around.settings)) {
    map.due = interval - map.instance % interval;  // so that maps become due in turn
    return false;
  }
  map.due = interval;
  const bool unchanged = around.changes && before->content == map.content;
  const bool young = before->age < std::min(before->due, interval);
  if (!unchanged && !young) {
    return false;
  }
  map.cacheIndex = static_cast<int>(before - maps.begin());
  map.serial = before->serial;
  map.center = before->center;
  if (!unchanged) {
    map.content = before->content;
    map.age = before->age + 1;
    map.due = before->due;
  }
  return true;
}

// Returns, as numbers, everything that the texels of a shadow map's face depend on if `casters` are drawn into it.
// `picture`: index in a mean of pictures, on which the coverage of casters depends. `around.changes` is not null.
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

}  // namespace

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

void addShadowMaps(FramePlan& plan, PlannedCubes maps, std::span<const Cube> before, const ImageSurroundings& around) {
  constexpr size_t mostCompared = 4'000'000;  // instances of all faces together
  size_t instances = 0;
  for (const Pass& face : maps.faces) {
    instances += face.instances.size();
  }
  const bool compares = around.changes && instances <= mostCompared;
  // Draws the maps of a mean once, although its settings reuse no images: its pictures share scene and time.
  const bool skips = compares && (around.settings.reflection.skipUnchanged || plan.picture > 0);
  const bool reuses = std::ranges::equal(maps.cubes, before, [](const Cube& a, const Cube& b) {
    return a.light == b.light && a.size == b.size && a.slots == b.slots;
  });
  const uint64_t next = largestSerial(before) + 1;
  for (size_t i = 0; i < maps.cubes.size(); ++i) {
    const Cube* old = reuses ? &before[i] : nullptr;
    Cube& map = plan.cubes.emplace_back(std::move(maps.cubes[i]));
    map.serial = old ? old->serial : next;
    for (size_t f = 0; f < map.faces.size(); ++f) {
      Pass& face = maps.faces[i * map.faces.size() + f];
      if (face.source != PassSource::unread) {
        map.content[f] = compares ? shadowContent(around, plan.picture, face, face) : RecycledVector<uint64_t>();
        const bool same = skips && old && old->content[f] == map.content[f];
        face.source = same ? PassSource::reused : PassSource::drawn;
        map.serial = same ? map.serial : next;
      } else if (old) {
        map.content[f] = old->content[f];
      }
      std::optional<Pass> layer;
      if (!face.drawn() && old) {
        map.layerContent[f] = old->layerContent[f];
      } else if (skips && old && !old->content[f].empty() &&
                 !orbits(around.scene.lights[static_cast<size_t>(map.light)])) {
        layer = divided(face, around);
      }
      if (layer) {
        map.layerContent[f] = shadowContent(around, plan.picture, face, *layer);
        layer->source = old->layerContent[f] == map.layerContent[f] ? PassSource::reused : PassSource::drawn;
        face.layer = static_cast<int>(plan.passes.size());
        addFace(plan, std::move(*layer));
      }
      addFace(plan, std::move(face));
    }
  }
}

void addEnvironmentMaps(FramePlan& plan, PlannedCubes maps, std::span<const Cube> before,
                        const ImageSurroundings& around, const View& main) {
  uint64_t serial = largestSerial(before);
  for (size_t i = 0; i < maps.cubes.size(); ++i) {
    Cube& map = maps.cubes[i];
    const std::span<Pass> faces = std::span(maps.faces).subspan(i * map.faces.size(), map.faces.size());
    const bool reused = reuseMap(map, faces, before, around, main);
    map.serial = reused ? map.serial : ++serial;
    plan.cubes.push_back(std::move(map));
    for (Pass& face : faces) {
      face.source = reused ? PassSource::reused : PassSource::drawn;
      addFace(plan, std::move(face));
    }
  }
}

}  // namespace speculum
