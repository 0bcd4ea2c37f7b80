#pragma once

#include <array>
#include <glm/glm.hpp>
#include <map>
#include <span>
#include <string>
#include <utility>
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

// Places windows along the left and right edge of the display, below each other, until the user moves them. A moved
// window stays where the user put it, as far as the display shows that place. The others follow the display's size and
// each other: they get narrower if both edges have windows, share the left edge if there is no room for both, and if a
// column is full, those opened first are folded to their titles. The layout file lists the windows that the user moved,
// sized or collapsed.
class PanelDock {
 public:
  enum class Edge { left, right };

  // Saves these windows in the layout file of the present ImGui context. Call it once, before the context's first
  // frame; the dock must outlive the context.
  void remember();
  // Call it in each ImGui frame before the first begin(). Keeps pixels free: `top` above all windows, `bottom` below
  // the windows of the left edge. While all windows are `hidden` they keep their order.
  void beginFrame(float top, float bottom, bool hidden);
  // Calls ImGui::Begin for a window whose size `ems` is in sizes of the font; a height of 0 reaches down to the
  // display's edge. Call ImGui::End whatever begin() returns.
  bool begin(const char* name, bool* open, Edge edge, const glm::vec2& ems, int windowFlags = 0);
  // Folds a window to its title until fold(name, false) or until the user unfolds it. The layout file does not list
  // that. Returns whether it was folded.
  bool fold(const char* name, bool folded);
  // Says whether a window that is closed would cover `place` (pixels of the display) when it opens.
  bool wouldCover(const char* name, Edge edge, const glm::vec2& ems, const glm::vec2& place) const;
  // Returns the part of the display that docked windows leave free, in pixels.
  WindowRect freeRect() const;
  // All windows go back to their original places.
  void reset();

 private:
  struct Panel {
    bool docked = true;
    bool collapsed = false;   // by the user
    bool putAway = false;     // by fold()
    WindowRect wish;          // set by the user; of a docked window only the size, 0: none
    glm::vec2 display{0.0f};  // size of the display when the user put the window there
    WindowRect given;         // rectangle that the window was given last
    WindowPlace place;        // while it is docked
    Edge edge = Edge::left;
    glm::vec2 ems{0.0f};
    bool shown = false;   // in this frame or the last
    bool folded = false;  // to its title, for want of room
    int rank = 0;         // larger for a window that the user opened later
    bool isTitle() const { return collapsed || putAway; }
  };
  static Length widthOf(const Panel& panel);
  // Returns the width in a column of width `most`: the column's, unless the user made the window narrower.
  static float widthIn(const Panel& panel, float most);
  static float heightOf(const Panel& panel);
  // Largest widths of the windows at both edges. `left`: all windows are at the left edge for want of room.
  struct Columns {
    std::array<float, 2> widths{};
    bool left = false;
    Edge edgeOf(const Panel& panel) const { return left ? Edge::left : panel.edge; }
  };
  Columns columns(const Panel* further = nullptr) const;  // with `further`, a window to be opened
  void arrange();
  void arrange(Edge edge, float width, float taken);
  void follow(Panel& panel);
  std::string saved() const;
  void read(Panel& panel, const char* line);

  std::map<std::string, Panel> panels_;
  std::vector<Panel*> order_;  // shown windows in the order of opening
  Columns columns_;
  int lastRank_ = 0;
  float top_ = 0.0f;
  float bottom_ = 0.0f;
};

}  // namespace speculum
