#pragma once

#include <array>

#include "core/acceleration_structure.hpp"
#include "core/renderer.hpp"
#include "scene/scene_state.hpp"
#include "systems/trace_scene.hpp"

namespace speculum {

// Acceleration structures for ray queries: one for the triangles of each mesh, one box that stands for every mirror,
// and for each frame in flight one over instances and mirrors, relative to the eye of the main view. Custom indices of
// instances are those of SceneState, those of mirrors count pieces (MirrorState::firstPiece).
class RayStructures {
 public:
  // Builds the meshes' structures, compacted, from the triangles of `trace`. Waits for the GPU.
  RayStructures(Device& device, Uploader& uploader, const TraceScene& trace);

  // Says whether single precision can hold and invert all transforms, and 24 bits all indices.
  static bool canHold(const SceneState& state);

  // Records an update of the frame's structure if transforms have changed, or a build if it cannot be updated; nothing
  // if all transforms are the same.
  void build(const Frame& frame, const Scene& scene, const SceneState& state);

  VkAccelerationStructureKHR top(const Frame& frame) const { return tops_[frame.index].structure.get(); }
  uint32_t count() const;
  uint64_t bytes() const;

 private:
  struct Top {
    Buffer instances;
    Buffer storage;
    Buffer scratch;
    AccelerationStructureHandle structure;  // destroyed before its storage
    uint32_t capacity = 0;                  // instances
    std::vector<VkAccelerationStructureInstanceKHR> built;
    int updates = 0;  // since the last build
  };
  std::vector<VkAccelerationStructureInstanceKHR> instances(const Scene& scene, const SceneState& state) const;
  StructureInput inputOf(const Top& top, uint32_t count) const;
  void grow(Top& top, uint32_t count) const;

  Device* device_;
  Buffer box_;
  Buffer bottomStorage_;
  std::vector<AccelerationStructureHandle> bottom_;  // of the meshes that have triangles, then of the box
  std::vector<VkDeviceAddress> meshes_;              // by mesh; 0: it has no triangles
  VkDeviceAddress mirror_ = 0;
  std::array<Top, framesInFlight> tops_;
};

}  // namespace speculum
