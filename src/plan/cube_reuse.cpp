#include <algorithm>
#include <optional>
#include <utility>

#include "plan/image_reuse.hpp"

namespace speculum {

namespace {

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

// Says whether settings make the same environment maps. reflection.* does not count, because mirrors in maps show the
// background.
bool sameMaps(const Settings& a, Settings b) {
  b.reflection = a.reflection;
  b.view.scale = a.view.scale;
  return sameDrawing(a, b);
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

}  // namespace

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
