#pragma once

#include <optional>
#include <span>

namespace speculum {

// In screen coordinates of the desktop.
struct ScreenRect {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;

  bool operator==(const ScreenRect&) const = default;
};

// Where a window goes of which too little lies on any of the monitors' work areas to take hold of it: into the middle
// of the first, no larger than that. Nothing if it may stay, or if there is no monitor.
std::optional<ScreenRect> broughtBack(const ScreenRect& window, std::span<const ScreenRect> workAreas);

}  // namespace speculum
