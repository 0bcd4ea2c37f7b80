#pragma once

#include <array>

#include "frame/effects.hpp"

namespace speculum {

// After so many frames without a call for it, what only an effect needs is given back.
inline constexpr int idleFramesKept = 120;

// What an effect took part in, of the frame recorded last.
struct EffectCost {
  uint32_t draws = 0;
  uint64_t bytes = 0;      // of device objects that it needs; effects that trace rays share theirs
  uint32_t pipelines = 0;  // alive
};

class EffectLedger {
 public:
  EffectCost& operator[](EffectKind kind) { return costs_[static_cast<size_t>(kind)]; }
  const EffectCost& operator[](EffectKind kind) const { return costs_[static_cast<size_t>(kind)]; }
  void draw(EffectKind kind, bool takesPart = true) { (*this)[kind].draws += takesPart; }
  void pipeline(EffectKind kind, bool takesPart = true) { (*this)[kind].pipelines += takesPart; }

 private:
  std::array<EffectCost, effectKinds> costs_{};
};

}  // namespace speculum
