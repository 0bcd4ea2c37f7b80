#pragma once

#include <array>
#include <string_view>

#include "plan/effects.hpp"

namespace speculum {

// Number of frames without a call for an effect after which its resources are released.
inline constexpr int idleFramesKept = 120;

// How the rays of the last recorded frame were traced.
struct RayUse {
  bool traced = false;
  bool hardware = false;    // by ray queries
  std::string_view why;     // reason for the choice of rays; static lifetime
  uint32_t structures = 0;  // acceleration structures, alive
  uint64_t structureBytes = 0;
};

// Costs of the effects in a frame.
class EffectLedger {
 public:
  RayUse rays;

  EffectCost& operator[](EffectKind kind) { return costs_[static_cast<size_t>(kind)]; }
  const EffectCost& operator[](EffectKind kind) const { return costs_[static_cast<size_t>(kind)]; }
  // Counts a draw for an effect, if the effect takes part in it.
  void draw(EffectKind kind, bool takesPart = true) { (*this)[kind].draws += takesPart; }
  // Adds the draws of a later picture and takes over its bytes and pipelines.
  void add(const EffectLedger& later) {
    for (size_t i = 0; i < costs_.size(); ++i) {
      const uint32_t before = costs_[i].draws;
      costs_[i] = later.costs_[i];
      costs_[i].draws += before;
    }
    rays = later.rays;
  }
  void pipeline(EffectKind kind, bool takesPart = true) { (*this)[kind].pipelines += takesPart; }

 private:
  std::array<EffectCost, static_cast<size_t>(EffectKind::count)> costs_{};
};

}  // namespace speculum
