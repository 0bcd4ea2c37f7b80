#include "ui/panel_layout.hpp"

#include <algorithm>

namespace speculum {

namespace {

struct Column {
  std::vector<size_t> windows;
  float least = 0.0f;  // least height of all its windows, margins included
  float width = 0.0f;
};

std::vector<Column> columnsOf(std::span<const WindowWish> wishes, const WindowRoom& room, float height) {
  std::vector<Column> columns;
  float inset = room.margin;
  for (size_t i = 0; i < wishes.size(); ++i) {
    const WindowWish& wish = wishes[i];
    const float least = wish.height.least;
    if (!columns.empty() && columns.back().least + room.margin + least > height) {
      const float beside = inset + columns.back().width + room.margin;
      if (beside + wish.width + room.margin + room.taken <= room.display.x) {
        inset = beside;
        columns.emplace_back();
      }
    }
    if (columns.empty()) {
      columns.emplace_back();
    }
    Column& column = columns.back();
    column.least += least + (column.windows.empty() ? 0.0f : room.margin);
    column.width = std::max(column.width, wish.width);
    column.windows.push_back(i);
  }
  return columns;
}

// Folds windows from the lowest rank up until the others fit. The last one is never folded and takes what is left.
void fold(std::vector<WindowPlace>& places, std::vector<Length>& heights, std::span<const WindowWish> wishes,
          const Column& column, const WindowRoom& room, float height) {
  std::vector<size_t> open;
  for (size_t i = 0; i < heights.size(); ++i) {
    if (heights[i].least > room.title) {
      open.push_back(i);
    }
  }
  std::ranges::sort(open, {}, [&](size_t i) { return wishes[column.windows[i]].rank; });
  float excess = column.least - height;
  for (size_t k = 0; k < open.size() && excess > 0.0f; ++k) {
    const bool last = k + 1 == open.size();
    Length& length = heights[open[k]];
    const float low = last ? std::max(length.least - excess, room.title) : room.title;
    places[column.windows[open[k]]].folded = !last;
    excess -= length.least - low;
    length = {low, low, low};
  }
}

}  // namespace

std::vector<float> shareRoom(std::span<const Length> lengths, float room) {
  glm::vec3 sum(0.0f);
  for (const Length& length : lengths) {
    sum += glm::vec3(length.least, length.kept, length.wished);
  }
  const auto part = [&](float low, float high) {
    return std::clamp((room - low) / std::max(high - low, 1e-3f), 0.0f, 1.0f);
  };
  const float toKept = part(sum.x, sum.y);
  const float toWished = part(sum.y, sum.z);
  std::vector<float> shares;
  for (const Length& length : lengths) {
    shares.push_back(length.least + (length.kept - length.least) * toKept + (length.wished - length.kept) * toWished);
  }
  return shares;
}

std::vector<WindowPlace> arrangeWindows(std::span<const WindowWish> wishes, const WindowRoom& room) {
  std::vector<WindowPlace> places(wishes.size());
  const glm::vec2 free =
      glm::max(room.display - 2.0f * room.margin - glm::vec2(0.0f, room.top + room.bottom), glm::vec2(1.0f));
  float inset = room.margin;
  for (const Column& column : columnsOf(wishes, room, free.y)) {
    std::vector<Length> lengths;
    for (const size_t i : column.windows) {
      lengths.push_back(wishes[i].height);
    }
    fold(places, lengths, wishes, column, room, free.y);
    const float gaps = room.margin * static_cast<float>(column.windows.size() - 1);
    const std::vector<float> heights = shareRoom(lengths, free.y - gaps);
    float top = room.top + room.margin;
    for (size_t i = 0; i < column.windows.size(); ++i) {
      const float width = std::min(wishes[column.windows[i]].width, free.x);
      const float left = room.right ? std::max(room.display.x - inset - width, room.margin) : inset;
      WindowPlace& place = places[column.windows[i]];
      place.corner = glm::floor(glm::vec2(left, top));
      place.size = glm::max(glm::floor(glm::vec2(width, heights[i])), glm::vec2(1.0f));
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

WindowRect reachableWindow(const WindowRect& wish, const glm::vec2& display, float top, float part) {
  const glm::vec2 size = glm::max(glm::min(wish.size, display), glm::vec2(part));
  const glm::vec2 low(part - size.x, top);
  return {glm::clamp(wish.corner, low, glm::max(display - part, low)), size};
}

}  // namespace speculum
