#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace speculum {

// All lengths here are in pixels of the display, origin top left.
struct WindowRect {
  glm::vec2 corner{0.0f};
  glm::vec2 size{0.0f};

  bool operator==(const WindowRect&) const = default;
};

// A length in three sizes, each at least as large as the one before.
struct Length {
  float least = 0.0f;   // smallest usable
  float kept = 0.0f;    // what the user gave it, kept if possible
  float wished = 0.0f;  // what it gets if there is room
};

struct WindowWish {
  float width = 0.0f;
  Length height;
  int rank = 0;  // without room for all, windows of the lowest ranks are folded
};

struct WindowPlace : WindowRect {
  bool folded = false;  // only its title has room

  bool operator==(const WindowPlace&) const = default;
};

struct WindowRoom {
  glm::vec2 display{0.0f};
  float margin = 0.0f;
  float title = 0.0f;   // height of a folded window
  float top = 0.0f;     // kept free above all windows
  float bottom = 0.0f;  // kept free below all windows
  float taken = 0.0f;   // width that windows at the opposite edge take
  bool right = false;   // the windows are at the right edge, else at the left one
};

// Shares `room` among lengths. All get their wished, kept or least length, or a length between two of these at the same
// ratio.
std::vector<float> shareRoom(std::span<const Length> lengths, float room);

// Arranges windows along an edge: below each other as high as wished if there is room, else all lower, else in a
// further column beside. Without room for a further column, windows of the last column are folded until the others have
// their least height. Windows of a column never overlap.
std::vector<WindowPlace> arrangeWindows(std::span<const WindowWish> wishes, const WindowRoom& room);

// Returns the rectangle nearest to `wish` that shows the whole window, no larger than the display.
WindowRect fitWindow(const WindowRect& wish, const glm::vec2& display);
// Returns the rectangle nearest to `wish` of which the display shows a `part` of the title, in width and height, below
// `top`.
WindowRect reachableWindow(const WindowRect& wish, const glm::vec2& display, float top, float part);

}  // namespace speculum
