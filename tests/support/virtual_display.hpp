#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace speculum::test {

// An X server without a screen and a window manager in it; DISPLAY points there while this lives.
class VirtualDisplay {
 public:
  // Throws std::runtime_error when Xvfb or openbox cannot be started.
  VirtualDisplay(int width = 1280, int height = 800);
  ~VirtualDisplay();
  VirtualDisplay(const VirtualDisplay&) = delete;
  VirtualDisplay& operator=(const VirtualDisplay&) = delete;

 private:
  pid_t server_ = 0;
  pid_t manager_ = 0;
};

}  // namespace speculum::test
