#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace speculum {

// All lengths in pixels of the display, origin top left.
struct WindowRect {
  glm::vec2 corner{0.0f};
  glm::vec2 size{0.0f};

  bool operator==(const WindowRect&) const = default;
};

struct WindowWish {
  glm::vec2 size{0.0f};
  float least = 0.0f;  // height that it can do with
};

struct WindowRoom {
  glm::vec2 display{0.0f};
  float margin = 0.0f;
  float top = 0.0f;     // kept free above
  float bottom = 0.0f;  // and below
  float taken = 0.0f;   // width at the opposite edge
  bool right = false;   // the edge; else the left one
};

// Windows along an edge: below each other, as high as they wish where there is room, then all lower, then in a column
// beside; where there is no room for one either, lower than they can do with. Those of a column never overlap.
std::vector<WindowRect> arrangeWindows(std::span<const WindowWish> wishes, const WindowRoom& room);

// The nearest place that shows the window whole; what is larger than the display becomes as large.
WindowRect fitWindow(const WindowRect& wish, const glm::vec2& display);

}  // namespace speculum
