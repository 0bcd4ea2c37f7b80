#include "ui/panel_dock.hpp"

#include <imgui.h>
#include <imgui_internal.h>
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

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

// Least sizes of a window in sizes of the font, if the display has room.
constexpr float narrowest = 18.0f;
constexpr float lowest = 12.0f;
// Bounds of what a layout file may say, in screen coordinates.
constexpr float smallest = 16.0f;
constexpr float farthest = 32767.0f;

float margin() {
  return std::floor(0.8f * ImGui::GetFontSize());
}

glm::vec2 displaySize() {
  return {ImGui::GetIO().DisplaySize.x, ImGui::GetIO().DisplaySize.y};
}

glm::vec2 vec(const ImVec2& v) {
  return {v.x, v.y};
}

bool apart(const glm::vec2& a, const glm::vec2& b) {
  return glm::distance(a, b) > 0.5f;
}

// Says whether the active widget is an edge of the present window, which the user drags to resize it.
bool holdsEdge(ImGuiID active) {
  ImGuiWindow* window = ImGui::GetCurrentWindow();
  bool held = false;
  for (int i = 0; active != 0 && i < 4; ++i) {
    held = held || active == ImGui::GetWindowResizeCornerID(window, i) ||
           active == ImGui::GetWindowResizeBorderID(window, static_cast<ImGuiDir>(i));
  }
  return held;
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

void PanelDock::remember() {
  ImGuiSettingsHandler handler;
  handler.TypeName = "Panel";
  handler.TypeHash = ImHashStr(handler.TypeName);
  handler.UserData = this;
  handler.ReadOpenFn = [](ImGuiContext*, ImGuiSettingsHandler* self, const char* name) -> void* {
    return &static_cast<PanelDock*>(self->UserData)->panels_[name];
  };
  handler.ReadLineFn = [](ImGuiContext*, ImGuiSettingsHandler* self, void* entry, const char* line) {
    static_cast<PanelDock*>(self->UserData)->read(*static_cast<Panel*>(entry), line);
  };
  handler.WriteAllFn = [](ImGuiContext*, ImGuiSettingsHandler* self, ImGuiTextBuffer* out) {
    out->append(static_cast<PanelDock*>(self->UserData)->saved().c_str());
  };
  // Removes the handlers of Dear ImGui's own settings, which trust the numbers in a file, such as a table's columns. No
  // window here has such settings.
  ImGui::GetCurrentContext()->SettingsHandlers.clear();
  ImGui::GetCurrentContext()->SettingsHandlers.push_back(handler);
}

// Ignores values that no window can have. begin() moves windows to where they can be reached.
void PanelDock::read(Panel& panel, const char* line) {
  glm::vec2 v(0.0f);
  const auto reads = [&](const char* format, float least) {
    return std::sscanf(line, format, &v.x, &v.y) == 2 && glm::all(glm::greaterThanEqual(v, glm::vec2(least))) &&
           glm::all(glm::lessThanEqual(v, glm::vec2(farthest)));
  };
  if (reads("Pos=%f,%f", -farthest)) {
    panel.docked = false;
    panel.wish.corner = v;
  } else if (reads("Display=%f,%f", 0.0f)) {
    panel.display = v;
  } else if (reads("Size=%f,%f", smallest)) {
    panel.wish.size = v;
  } else if (std::string_view(line) == "Collapsed=1") {
    panel.collapsed = true;
  }
}

std::string PanelDock::saved() const {
  std::string text;
  for (const auto& [name, panel] : panels_) {
    std::string lines = panel.collapsed ? "Collapsed=1\n" : "";
    const auto line = [&](const char* key, const glm::vec2& v) {
      lines += fmt::format("{}={:.0f},{:.0f}\n", key, v.x, v.y);
    };
    if (!panel.docked) {
      line("Pos", panel.wish.corner);
      line("Display", panel.display);
    }
    if (panel.wish.size.x > 0.0f) {
      line("Size", panel.wish.size);
    }
    text += lines.empty() ? "" : "[Panel][" + name + "]\n" + lines + "\n";
  }
  return text;
}

bool PanelDock::fold(const char* name, bool folded) {
  Panel& panel = panels_[name];
  const bool before = panel.isTitle();
  panel.putAway = folded;
  return before;
}

bool PanelDock::wouldCover(const char* name, Edge edge, const glm::vec2& ems, const glm::vec2& place) const {
  const auto known = panels_.find(name);
  Panel panel = known != panels_.end() ? known->second : Panel();
  panel.edge = edge;
  panel.ems = ems;
  if (!panel.docked) {
    const WindowRect& wish = panel.wish;
    return glm::all(glm::greaterThanEqual(place, wish.corner)) &&
           glm::all(glm::lessThan(place, wish.corner + wish.size));
  }
  const Columns columns = this->columns(&panel);
  const Edge shown = columns.edgeOf(panel);
  const float inward = shown == Edge::left ? place.x : displaySize().x - place.x;
  return inward < widthIn(panel, columns.widths[static_cast<size_t>(shown)]) + margin();
}

WindowRect PanelDock::freeRect() const {
  const glm::vec2 display = displaySize();
  float left = 0.0f;
  float right = display.x;
  float top = top_;
  for (const Panel* panel : order_) {
    const WindowRect& place = panel->given;
    if (panel->docked && panel->shown && panel->isTitle()) {
      top = std::max(top, place.corner.y + place.size.y);
    } else if (panel->docked && panel->shown) {
      columns_.edgeOf(*panel) == Edge::left ? void(left = std::max(left, place.corner.x + place.size.x))
                                            : void(right = std::min(right, place.corner.x));
    }
  }
  return {{std::min(left, right), top}, {std::max(right - left, 0.0f), std::max(display.y - top, 0.0f)}};
}

void PanelDock::reset() {
  for (auto& [name, panel] : panels_) {
    panel.docked = true;
    panel.collapsed = panel.putAway = false;
    panel.wish = {};
  }
  ImGui::MarkIniSettingsDirty();
}

void PanelDock::beginFrame(float top, float bottom, bool hidden) {
  top_ = top;
  bottom_ = bottom;
  if (hidden) {
    return;
  }
  std::erase_if(order_, [](const Panel* panel) { return !panel->shown; });
  arrange();
  for (auto& [name, panel] : panels_) {
    panel.shown = false;
  }
}

Length PanelDock::widthOf(const Panel& panel) {
  const float em = ImGui::GetFontSize();
  const float kept = panel.wish.size.x;
  const float wished = kept > 0.0f ? kept : panel.ems.x * em;
  const float least = std::min(narrowest * em, wished);
  return {least, std::max(kept, least), wished};
}

float PanelDock::widthIn(const Panel& panel, float most) {
  return panel.wish.size.x > 0.0f ? std::min(panel.wish.size.x, most) : most;
}

float PanelDock::heightOf(const Panel& panel) {
  return panel.wish.size.y > 0.0f ? panel.wish.size.y
         : panel.ems.y > 0.0f     ? panel.ems.y * ImGui::GetFontSize()
                                  : displaySize().y;
}

PanelDock::Columns PanelDock::columns(const Panel* further) const {
  std::array<Length, 2> widest;
  const auto merge = [](const Length& a, const Length& b) {
    return Length{std::max(a.least, b.least), std::max(a.kept, b.kept), std::max(a.wished, b.wished)};
  };
  const auto add = [&](const Panel& panel) {
    Length& length = widest[static_cast<size_t>(panel.edge)];
    length = merge(length, widthOf(panel));
  };
  for (const Panel* panel : order_) {
    if (panel->docked) {
      add(*panel);
    }
  }
  if (further) {
    add(*further);
  }
  const float room = displaySize().x - 3.0f * margin();
  if (widest[0].least + widest[1].least > room) {
    return {{merge(widest[0], widest[1]).wished, 0.0f}, true};
  }
  const std::vector<float> shares = shareRoom(widest, room);
  return {{shares[0], shares[1]}, false};
}

void PanelDock::arrange() {
  columns_ = columns();
  arrange(Edge::left, columns_.widths[0], columns_.widths[1]);
  arrange(Edge::right, columns_.widths[1], columns_.widths[0]);
}

void PanelDock::arrange(Edge edge, float width, float taken) {
  const float em = ImGui::GetFontSize();
  WindowRoom room{.display = displaySize(), .margin = margin(), .title = ImGui::GetFrameHeight(), .top = top_};
  room.bottom = edge == Edge::left ? bottom_ : 0.0f;
  room.taken = taken > 0.0f ? room.margin + taken : 0.0f;
  room.right = edge == Edge::right;
  std::vector<Panel*> panels;
  std::vector<WindowWish> wishes;
  for (Panel* panel : order_) {
    if (panel->docked && columns_.edgeOf(*panel) == edge) {
      const float kept = panel->wish.size.y;
      const float wished = panel->isTitle() ? room.title : heightOf(*panel);
      const float least = std::min(lowest * em, wished);
      const Length height{least, std::clamp(kept, least, wished), wished};
      panels.push_back(panel);
      wishes.push_back({widthIn(*panel, width), height, panel->rank});
    }
  }
  const std::vector<WindowPlace> places = arrangeWindows(wishes, room);
  for (size_t i = 0; i < panels.size(); ++i) {
    panels[i]->place = places[i];
  }
}

// Records that the user moved or sized the window that was just begun, if the display's size did not.
void PanelDock::follow(Panel& panel) {
  const ImGuiContext& context = *ImGui::GetCurrentContext();
  const ImGuiWindow* window = ImGui::GetCurrentWindow();
  const WindowRect now{vec(window->Pos), vec(window->SizeFull)};
  const bool moved =
      context.MovingWindow && context.MovingWindow->RootWindow == window && apart(now.corner, panel.given.corner);
  const bool sized = holdsEdge(context.ActiveId) && apart(now.size, panel.given.size);
  if (moved || sized) {
    panel.docked = panel.docked && !moved;
    panel.wish = now;
    panel.given = now;
    panel.display = displaySize();
    ImGui::MarkIniSettingsDirty();
  }
  if ((panel.isTitle() || panel.folded) != window->Collapsed) {
    panel.collapsed = window->Collapsed;
    panel.putAway = false;
    panel.rank = window->Collapsed ? panel.rank : ++lastRank_;
    ImGui::MarkIniSettingsDirty();
  }
}

bool PanelDock::begin(const char* name, bool* open, Edge edge, const glm::vec2& ems, int windowFlags) {
  Panel& panel = panels_[name];
  panel.edge = edge;
  panel.ems = ems;
  panel.shown = true;
  if (std::ranges::find(order_, &panel) == order_.end()) {
    order_.push_back(&panel);
    panel.rank = ++lastRank_;
    arrange();
    panel.given = {};
  }
  const glm::vec2 size = panel.wish.size.x > 0.0f ? panel.wish.size : ems * ImGui::GetFontSize();
  const WindowRect wish{panel.wish.corner, size};
  const bool room = glm::all(glm::greaterThanEqual(displaySize(), panel.display));
  const WindowRect free = reachableWindow(room ? wish : fitWindow(wish, displaySize()), displaySize(), top_, margin());
  const WindowRect place = panel.docked ? panel.place : free;
  panel.folded = panel.docked && panel.place.folded;
  const bool collapsed = panel.isTitle() || panel.folded;
  const bool held = ImGui::GetCurrentContext()->ActiveId != 0 && ImGui::IsMouseDown(ImGuiMouseButton_Left);
  if (place != panel.given && !(held && !panel.docked)) {
    ImGui::SetNextWindowPos({place.corner.x, place.corner.y});
    ImGui::SetNextWindowSize({place.size.x, collapsed ? heightOf(panel) : place.size.y});
    panel.given = place;
  }
  ImGui::SetNextWindowCollapsed(collapsed);
  const bool visible = ImGui::Begin(name, open, windowFlags | ImGuiWindowFlags_NoSavedSettings);
  follow(panel);
  return visible;
}

}  // namespace speculum
