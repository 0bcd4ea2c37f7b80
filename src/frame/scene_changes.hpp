#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "scene/scene_state.hpp"

namespace speculum {

// Says in which frame each object, mirror and the lights last changed, bit by bit. Frames are numbered from 1. If two
// frames show the same set of things and the number of the last change among them is the same, none of them changed
// between the frames.
class SceneChanges {
 public:
  // Compares the next frame's scene with that of the frame before. Meshes and textures are taken as unchanged.
  void update(const Scene& scene, const SceneState& state);

  // Of an instance, an index into SceneState::instances: its mesh and its place only.
  uint64_t placed(int instance) const { return placed_[static_cast<size_t>(instance)]; }
  // Of an instance: anything that is drawn.
  uint64_t instance(int instance) const { return drawn_[static_cast<size_t>(instance)]; }
  uint64_t mirror(int mirror) const { return mirrors_[static_cast<size_t>(mirror)].changed; }
  uint64_t lights() const { return lights_.changed; }
  // Of all instances and mirrors.
  uint64_t scene() const { return scene_; }

 private:
  // A place, an object and a mesh.
  using Placement = std::array<uint64_t, 13>;
  struct Tracked {
    std::vector<uint64_t> content;
    uint64_t changed = 0;
  };

  void note(std::vector<uint64_t> content, Tracked& tracked);

  uint64_t frame_ = 0;
  uint64_t scene_ = 0;
  std::vector<Placement> placements_;  // of the instances
  std::vector<uint64_t> placed_;
  std::vector<uint64_t> drawn_;
  std::vector<Tracked> objects_;
  std::vector<Tracked> mirrors_;
  Tracked lights_;
};

}  // namespace speculum
