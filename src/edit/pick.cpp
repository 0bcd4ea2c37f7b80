#include "edit/pick.hpp"

#include <algorithm>

#include "geometry/reflection.hpp"

namespace speculum {

namespace {

Selection selectionOf(const SceneHit& hit, const TraceWorld& world) {
  switch (hit.kind) {
    case HitKind::object: {
      const InstanceState& instance = world.instances()[hit.index];
      return {Selection::Kind::object, instance.object, instance.copy};
    }
    case HitKind::mirror:
      return mirrorNode(world.scene(), hit.index);
    case HitKind::glyph:
      return {Selection::Kind::light, hit.index};
  }
  return {};
}

// Says whether the plan skipped the mirror at the end of the path, so that it shows no image.
bool isSkipped(const PickLimits& limits, const MirrorPath& path) {
  return std::ranges::any_of(limits.skipped, [&](const SkippedMirror& skip) {
    const bool shown = skip.reason == SkipReason::maxPasses || skip.reason == SkipReason::maxDepth ||
                       skip.reason == SkipReason::minPixels || skip.reason == SkipReason::minThroughput;
    return shown && skip.path == path;
  });
}

}  // namespace

std::vector<Picked> Picker::at(const SceneState& state, const PictureView& picture, const glm::dvec2& pixel,
                               const PickLimits& limits) {
  world_.place(state);
  const glm::dvec3& eye = state.camera.eye;
  Ray ray{glm::dvec3(0.0), glm::normalize(picture.ray(pixel).direction)};
  Skip skip;
  std::vector<Picked> found;
  MirrorPath path;
  glm::dvec3 throughput(1.0);
  while (const auto hit = world_.closest(ray, skip, path.empty() ? Onlooker::eye : Onlooker::mirror)) {
    found.push_back({selectionOf(*hit, world_), path, eye + ray.at(hit->t)});
    if (hit->kind != HitKind::mirror) {
      break;
    }
    const Mirror& mirror = world_.scene().mirror(hit->index);
    const MirrorState& placed = world_.mirrors()[hit->index];
    path.push_back(hit->index);
    throughput *= opticsOf(mirror).reflectanceAt(std::abs(glm::dot(placed.normal, ray.direction)));
    const double largest = std::max({throughput.r, throughput.g, throughput.b});
    if (!(hit->mirrorFront || mirror.twoSided) || static_cast<int>(path.size()) > limits.maxDepth || largest == 0.0 ||
        largest < limits.minThroughput || isSkipped(limits, path)) {
      break;
    }
    // The reflected ray starts at the reflected eye and reaches the mirror at the same t, so that it needs no offset
    // off the surface.
    ray = {reflectPoint(ray.origin, {placed.origin, placed.normal}), reflectionLinear(placed.normal) * ray.direction,
           hit->t};
    skip = {.mirror = hit->index};
  }
  std::ranges::reverse(found);
  return found;
}

}  // namespace speculum
