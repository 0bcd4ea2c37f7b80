#include "ui/panel_layout.hpp"

#include <algorithm>

namespace speculum {

namespace {

struct Column {
  std::vector<size_t> windows;
  float least = 0.0f;  // height, margins included
  float width = 0.0f;
};

std::vector<Column> columnsOf(std::span<const WindowWish> wishes, const WindowRoom& room, float height) {
  std::vector<Column> columns;
  float inset = room.margin;
  for (size_t i = 0; i < wishes.size(); ++i) {
    const WindowWish& wish = wishes[i];
    const float least = std::min(wish.least, wish.size.y);
    if (!columns.empty() && columns.back().least + room.margin + least > height) {
      const float beside = inset + columns.back().width + room.margin;
      if (beside + wish.size.x + room.margin + room.taken <= room.display.x) {
        inset = beside;
        columns.emplace_back();
      }
    }
    if (columns.empty()) {
      columns.emplace_back();
    }
    Column& column = columns.back();
    column.least += least + (column.windows.empty() ? 0.0f : room.margin);
    column.width = std::max(column.width, wish.size.x);
    column.windows.push_back(i);
  }
  return columns;
}

// Returns heights: those of `wishes` if all fit, else least heights and a share of the rest, else a share of the room.
std::vector<float> heightsOf(std::span<const WindowWish> wishes, const Column& column, float height) {
  float wished = 0.0f;
  float least = 0.0f;
  for (const size_t i : column.windows) {
    wished += wishes[i].size.y;
    least += std::min(wishes[i].least, wishes[i].size.y);
  }
  std::vector<float> heights;
  for (const size_t i : column.windows) {
    const float low = std::min(wishes[i].least, wishes[i].size.y);
    const float high = wishes[i].size.y;
    if (wished <= height) {
      heights.push_back(high);
    } else if (least <= height) {
      heights.push_back(low + (high - low) * (height - least) / (wished - least));
    } else {
      heights.push_back(low * height / least);
    }
  }
  return heights;
}

}  // namespace

std::vector<WindowRect> arrangeWindows(std::span<const WindowWish> wishes, const WindowRoom& room) {
  std::vector<WindowRect> places(wishes.size());
  const glm::vec2 free =
      glm::max(room.display - 2.0f * room.margin - glm::vec2(0.0f, room.top + room.bottom), glm::vec2(1.0f));
  float inset = room.margin;
  for (const Column& column : columnsOf(wishes, room, free.y)) {
    const float gaps = room.margin * static_cast<float>(column.windows.size() - 1);
    const std::vector<float> heights = heightsOf(wishes, column, std::max(free.y - gaps, 1.0f));
    float top = room.top + room.margin;
    for (size_t i = 0; i < column.windows.size(); ++i) {
      const float width = std::min(wishes[column.windows[i]].size.x, free.x);
      const float left = room.right ? std::max(room.display.x - inset - width, room.margin) : inset;
      places[column.windows[i]] = {glm::floor(glm::vec2(left, top)),
                                   glm::max(glm::floor(glm::vec2(width, heights[i])), glm::vec2(1.0f))};
      top += heights[i] + room.margin;
    }
    inset += column.width + room.margin;
  }
  return places;
}

WindowRect fitWindow(const WindowRect& wish, const glm::vec2& display) {
  const glm::vec2 size = glm::max(glm::min(wish.size, display), glm::vec2(1.0f));
  return {glm::clamp(wish.corner, glm::vec2(0.0f), glm::max(display - size, glm::vec2(0.0f))), size};
}

}  // namespace speculum
