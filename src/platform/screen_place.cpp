#include "platform/screen_place.hpp"

#include <algorithm>

namespace speculum {

namespace {

constexpr int grip = 48;  // width and height in pixels of a window's visible part by which a user can move it

int overlap(int a, int aSize, int b, int bSize) {
  return std::min(a + aSize, b + bSize) - std::max(a, b);
}

bool canBeGripped(const ScreenRect& window, const ScreenRect& area) {
  return overlap(window.x, window.width, area.x, area.width) >= std::min(grip, window.width) &&
         overlap(window.y, window.height, area.y, area.height) >= std::min(grip, window.height);
}

}  // namespace

std::optional<ScreenRect> rescuedWindow(const ScreenRect& window, std::span<const ScreenRect> workAreas) {
  if (workAreas.empty() ||
      std::ranges::any_of(workAreas, [&](const ScreenRect& area) { return canBeGripped(window, area); })) {
    return std::nullopt;
  }
  const ScreenRect& area = workAreas.front();
  const int width = std::min(window.width, area.width);
  const int height = std::min(window.height, area.height);
  return ScreenRect{area.x + (area.width - width) / 2, area.y + (area.height - height) / 2, width, height};
}

}  // namespace speculum
