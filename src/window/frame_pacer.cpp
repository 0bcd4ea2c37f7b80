#include "window/frame_pacer.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace speculum {

namespace {

// After a change panels need a frame to show it, another to settle, and two more because the figures in them are two
// frames old.
constexpr int framesAfterChange = 4;
constexpr int longestInterval = 3600;  // frames: a map with a longer interval is meant to stay as it is

// Returns the number of frames in which every cached image is rendered anew.
int framesUntilFresh(const Settings& settings) {
  const EffectSettings& effects = settings.effects;
  const bool maps = effects.curved && effects.curvedLookup == CurvedLookup::environment;
  return std::max(settings.reflection.updateInterval,
                  maps ? std::min(effects.environmentInterval, longestInterval) : 0);
}

}  // namespace

void FramePacer::change(std::span<const Settings> halves) {
  int fresh = 0;
  for (const Settings& settings : halves) {
    fresh = std::max(fresh, framesUntilFresh(settings));
  }
  due_ = static_cast<int>(halves.size()) * (framesAfterChange + fresh);
}

double FramePacer::beginFrame(double seconds) {
  return std::exchange(idled_, false) ? std::numeric_limits<double>::quiet_NaN() : 1000.0 * seconds;
}

}  // namespace speculum
