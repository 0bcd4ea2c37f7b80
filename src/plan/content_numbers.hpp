#pragma once

#include <bit>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "geometry/recycled_memory.hpp"
#include "plan/frame_plan.hpp"
#include "scene/scene_fields.hpp"

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

}  // namespace speculum
