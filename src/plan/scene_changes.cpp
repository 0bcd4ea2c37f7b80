#include "plan/scene_changes.hpp"

#include <algorithm>

namespace speculum {

namespace {

struct PlacementParts {
  Affine worldFromMesh;
  int object;
  int mesh;
};

}  // namespace

void SceneChanges::update(const Scene& scene, const SceneState& state) {
  ++update_;
  if (placements_.size() != state.instances.size() || mirrors_.size() != scene.mirrorCount()) {
    any_ = update_;
  }
  ContentNumbers content;
  const auto note = [&](Tracked& tracked) {
    if (tracked.changed == 0 || content.numbers() != tracked.content) {
      tracked = {content.numbers(), update_};
    }
    content.clear();
  };
  objects_.resize(scene.objects.size());
  for (size_t i = 0; i < scene.objects.size(); ++i) {
    content.add(scene.objects[i]);
    note(objects_[i]);
    any_ = std::max(any_, objects_[i].changed);
  }
  const size_t known = std::min(placements_.size(), state.instances.size());
  placements_.resize(state.instances.size());
  placed_.resize(state.instances.size());
  drawn_.resize(state.instances.size());
  for (size_t i = 0; i < state.instances.size(); ++i) {
    const InstanceState& instance = state.instances[i];
    const auto placement =
        std::bit_cast<Placement>(PlacementParts{instance.worldFromMesh, instance.object, instance.mesh});
    if (i >= known || placement != placements_[i]) {
      placements_[i] = placement;
      placed_[i] = any_ = update_;
    }
    drawn_[i] = std::max(placed_[i], objects_[static_cast<size_t>(instance.object)].changed);
  }
  mirrors_.resize(scene.mirrorCount());
  for (size_t i = 0; i < scene.mirrorCount(); ++i) {
    const MirrorState& placed = state.mirrors[i];
    content.addAll(placed.polygon, placed.pieces, placed.origin, placed.normal, placed.axisX, placed.axisY,
                   scene.mirror(i));
    note(mirrors_[i]);
    any_ = std::max(any_, mirrors_[i].changed);
  }
  for (size_t i = 0; i < scene.lights.size(); ++i) {
    content.addAll(state.lights[i].position, scene.lights[i]);
  }
  note(lights_);
}

}  // namespace speculum
