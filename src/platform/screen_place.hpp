#pragma once

#include <optional>
#include <span>

namespace speculum {

// A rectangle in screen coordinates of the desktop.
struct ScreenRect {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;

  bool operator==(const ScreenRect&) const = default;
};

// Returns where to put a window that cannot be gripped because too little of it lies on any monitor's work area: in the
// middle of the first work area, no larger than that. Nothing if the window may stay, or if there is no monitor.
std::optional<ScreenRect> rescuedWindow(const ScreenRect& window, std::span<const ScreenRect> workAreas);

}  // namespace speculum
