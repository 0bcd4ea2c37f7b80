#pragma once

#include <algorithm>

#include "ui/views.hpp"

namespace speculum {

// The time of the animation.
class Playback {
 public:
  void seek(double seconds) {
    view_.time = std::max(0.0, seconds);
    ++seeks_;
  }
  void step(int steps) {
    view_.paused = true;
    seek(view_.time + steps * timeStep);
  }
  void setPaused(bool paused) { view_.paused = paused; }
  void setCost(const std::string& cost) { view_.cost = cost; }
  void setSpeed(double speed) { view_.speed = std::clamp(speed, slowestTime, fastestTime); }
  double after(double seconds) const { return view_.time + (view_.paused ? 0.0 : seconds * view_.speed); }
  void advance(double seconds) { view_.time = after(seconds); }
  const PlaybackView& view() const { return view_; }
  int seeks() const { return seeks_; }  // how often the time was set

 private:
  PlaybackView view_;
  int seeks_ = 0;
};

}  // namespace speculum
