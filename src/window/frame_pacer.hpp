#pragma once

#include <algorithm>
#include <span>

#include "settings/settings.hpp"

namespace speculum {

// Says when a frame has to be drawn: after each change until everything shown is up to date, and never while the window
// is idle.
class FramePacer {
 public:
  // Call when something changed or is changing. `halves`: settings of the pictures that are drawn in turn.
  void change(std::span<const Settings> halves);
  void requestFrames(int frames) { due_ = std::max(due_, frames); }
  bool due() const { return due_ > 0; }
  void idle() { idled_ = true; }  // call when the window sleeps

  // Begins a frame, `seconds` after the last step. Returns the milliseconds since the last frame, NaN if the window was
  // idle.
  double beginFrame(double seconds);
  void frameDrawn() { due_ = std::max(0, due_ - 1); }

 private:
  int due_ = 0;        // frames to draw, although nothing changes any more
  bool idled_ = true;  // the window slept before the frame that is drawn next
};

}  // namespace speculum
