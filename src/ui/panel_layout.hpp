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
  float least = 0.0f;  // smallest usable height
};

struct WindowRoom {
  glm::vec2 display{0.0f};
  float margin = 0.0f;
  float top = 0.0f;     // kept free above
  float bottom = 0.0f;  // and below
  float taken = 0.0f;   // width at the opposite edge
  bool right = false;   // right edge, else the left one
};

// Arranges windows along an edge: below each other at the height they have in `wishes` if there is room, else all
// lower, else in a further column beside; without room for one, lower than `least`. Windows of a column never overlap.
std::vector<WindowRect> arrangeWindows(std::span<const WindowWish> wishes, const WindowRoom& room);

// Returns the nearest rectangle that shows the whole window, no larger than the display.
WindowRect fitWindow(const WindowRect& wish, const glm::vec2& display);

}  // namespace speculum
