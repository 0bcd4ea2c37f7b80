#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include "geometry/recycled_memory.hpp"
#include "plan/frame_plan.hpp"
#include "scene/scene_fields.hpp"
#include "scene/scene_state.hpp"

namespace speculum {

// A list of numbers that is compared bit by bit, because 0 and -0 may be drawn differently.
class ContentNumbers {
 public:
  void add(const Plane& plane) { addAll(plane.point, plane.normal); }
  void add(const PixelRect& rect) { addAll(rect.x, rect.y, rect.width, rect.height); }
  void add(const View& view) {
    addAll(view.eye, view.worldToView, view.clip, view.cone, view.rect, view.pictureSize, view.path);
  }
  // Adds how a mirror is drawn, without its image: a cached image is compared by itself, and a mirror without an image
  // shows the background.
  void add(const MirrorDraw& draw) {
    addAll(draw.cached.has_value(), draw.mirror, draw.back, draw.byRays, draw.blurs, draw.ripples, draw.polygon,
           draw.pieces, draw.plane, draw.layer);
  }
  // Adds all numbers of another value; of a node, the fields that are read where it is drawn. The other fields count
  // through SceneState.
  template <typename T>
  void add(const T& value) {
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
      numbers_.push_back(std::bit_cast<uint64_t>(static_cast<double>(value)));
    } else {
      const auto isDrawn = [](const auto& field) { return field.use == FieldUse::appearance; };
      visitParts(value, isDrawn, [&](const auto& part) { add(part); });
    }
  }
  template <typename... T>
  void addAll(const T&... values) {
    (add(values), ...);
  }
  // Adds an integer with all its bits.
  void addCount(uint64_t value) { numbers_.push_back(value); }

  RecycledVector<uint64_t> take() { return std::move(numbers_); }
  const RecycledVector<uint64_t>& numbers() const { return numbers_; }
  void clear() { numbers_.clear(); }  // keeps the memory

 private:
  RecycledVector<uint64_t> numbers_;
};

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
