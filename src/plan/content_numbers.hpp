#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "geometry/recycled_memory.hpp"
#include "plan/frame_plan.hpp"
#include "scene/scene_fields.hpp"

namespace speculum {

// A list of numbers that is compared bit by bit, because 0 and -0 may be drawn differently.
class ContentNumbers {
 public:
  void add(double value) { numbers_.push_back(std::bit_cast<uint64_t>(value)); }
  void add(const glm::dvec2& v) { addAll(v.x, v.y); }
  void add(const glm::dvec3& v) { addAll(v.x, v.y, v.z); }
  void add(const glm::dmat3& m) { addAll(m[0], m[1], m[2]); }
  void add(const Plane& plane) { addAll(plane.point, plane.normal); }
  void add(const PixelRect& rect) { addAll(rect.x, rect.y, rect.width, rect.height); }
  template <typename T>
  void add(const std::optional<T>& value) {
    add(value.has_value());
    if (value) {
      add(*value);
    }
  }
  template <typename T, typename Allocator>
  void add(const std::vector<T, Allocator>& values) {
    add(static_cast<double>(values.size()));
    for (const T& value : values) {
      add(value);
    }
  }
  template <typename... T>
  void addAll(const T&... values) {
    (add(values), ...);
  }

  void add(const std::string& text) {
    add(static_cast<double>(text.size()));
    std::ranges::for_each(text, [&](char c) { add(static_cast<double>(c)); });
  }
  template <typename Enum>
  requires std::is_enum_v<Enum>
  void add(Enum value) { add(static_cast<double>(value)); }
  // Adds the fields that are read where the node is drawn. The other fields count through SceneState.
  template <Described Node>
  void add(const Node& node) {
    forEachField<Node>([&](const auto& field) {
      if (field.use == FieldUse::appearance) {
        add(node.*field.member);
      }
    });
  }
  void add(const View& view) {
    addAll(view.eye, view.worldToView, view.clip, view.cone, view.rect, view.pictureSize, view.path);
  }
  // Adds how a mirror is drawn, without its image: a cached image is compared by itself, and a mirror without an image
  // shows the background.
  void add(const MirrorDraw& draw) {
    addAll(draw.cached.has_value(), draw.mirror, draw.back, draw.byRays, draw.blurs, draw.ripples, draw.polygon,
           draw.pieces, draw.plane, draw.layer);
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
