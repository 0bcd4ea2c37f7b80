#pragma once

namespace speculum::test {

// An X server without a screen, 1280 x 900, and a window manager in it; DISPLAY points there. One serves the whole
// program: the first to need it starts it.
struct VirtualDisplay {
  // Throws std::runtime_error when Xvfb or openbox cannot be started.
  VirtualDisplay();
};

}  // namespace speculum::test
