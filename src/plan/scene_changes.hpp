#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/recycled_memory.hpp"
#include "scene/scene_state.hpp"

namespace speculum {

// Says when each object, mirror and the lights last changed, bit by bit, as the number of an update, from 1 on. If two
// frames show the same set of nodes and the number of the last change among them is the same, none of them changed
// between the frames.
class SceneChanges {
 public:
  // Compares the scene with that of the update before. Meshes and textures are taken as unchanged.
  void update(const Scene& scene, const SceneState& state);

  // An instance is an index into SceneState::instances. Its place includes which object and mesh it has.
  uint64_t placeChanged(int instance) const { return placed_[static_cast<size_t>(instance)]; }
  uint64_t instanceChanged(int instance) const { return drawn_[static_cast<size_t>(instance)]; }
  uint64_t mirrorChanged(int mirror) const { return mirrors_[static_cast<size_t>(mirror)].changed; }
  uint64_t lightsChanged() const { return lights_.changed; }
  // Number of the last update that changed any instance or mirror.
  uint64_t anyChanged() const { return any_; }

 private:
  // Place, object and mesh of an instance, as bits.
  using Placement = std::array<uint64_t, 13>;
  struct Tracked {
    RecycledVector<uint64_t> content;
    uint64_t changed = 0;
  };

  uint64_t update_ = 0;  // number of the last update
  uint64_t any_ = 0;
  std::vector<Placement> placements_;  // of the instances
  std::vector<uint64_t> placed_;
  std::vector<uint64_t> drawn_;
  std::vector<Tracked> objects_;
  std::vector<Tracked> mirrors_;
  Tracked lights_;
};

}  // namespace speculum
