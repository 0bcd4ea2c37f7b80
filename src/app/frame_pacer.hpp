#pragma once

#include "frame/settings.hpp"

namespace speculum {

// Decides whether a frame is drawn: after each change until everything shown is up to date, and none while the window
// is idle.
class FramePacer {
 public:
  // Something changed, or goes on changing.
  void change(const Settings& settings);
  void requestFrames(int frames);
  bool due() const { return due_ > 0; }
  void idle() { idled_ = true; }

  // A frame begins, `seconds` after the last look at the window. Returns the milliseconds since the last frame, NaN if
  // the window was idle.
  double beginFrame(double seconds);
  void frameDrawn();

 private:
  int due_ = 0;        // frames to draw, although nothing changes any more
  bool idled_ = true;  // before the frame that is drawn next
};

}  // namespace speculum
