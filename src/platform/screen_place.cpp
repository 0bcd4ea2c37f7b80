#include "platform/screen_place.hpp"

#include <algorithm>

namespace speculum {

namespace {

constexpr int hold = 48;  // as much of a window, each way, can be taken hold of

int overlap(int a, int aSize, int b, int bSize) {
  return std::min(a + aSize, b + bSize) - std::max(a, b);
}

bool canBeHeld(const ScreenRect& window, const ScreenRect& area) {
  return overlap(window.x, window.width, area.x, area.width) >= std::min(hold, window.width) &&
         overlap(window.y, window.height, area.y, area.height) >= std::min(hold, window.height);
}

}  // namespace

std::optional<ScreenRect> broughtBack(const ScreenRect& window, std::span<const ScreenRect> workAreas) {
  if (workAreas.empty() || std::any_of(workAreas.begin(), workAreas.end(),
                                       [&](const ScreenRect& area) { return canBeHeld(window, area); })) {
    return std::nullopt;
  }
  const ScreenRect& area = workAreas.front();
  const int width = std::min(window.width, area.width);
  const int height = std::min(window.height, area.height);
  return ScreenRect{area.x + (area.width - width) / 2, area.y + (area.height - height) / 2, width, height};
}

}  // namespace speculum
