#include "ui/panel_dock.hpp"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>

namespace speculum {

namespace {

float margin() {
  return std::floor(0.8f * ImGui::GetFontSize());
}

glm::vec2 displaySize() {
  return {ImGui::GetIO().DisplaySize.x, ImGui::GetIO().DisplaySize.y};
}

}  // namespace

void PanelDock::beginFrame() {
  left_ = right_ = {.inset = margin(), .top = margin()};
}

PanelDock::Panel& PanelDock::panel(const char* name) {
  const auto [found, fresh] = panels_.try_emplace(name);
  if (fresh) {
    // Only what was moved is in the layout file.
    found->second.docked = !ImGui::FindWindowSettings(ImHashStr(name));
  }
  return found->second;
}

void PanelDock::place(Panel& panel, Edge edge, const glm::vec2& ems) {
  Column& column = edge == Edge::left ? left_ : right_;
  const glm::vec2 display = displaySize();
  const glm::vec2 room = glm::max(display - 2.0f * margin(), glm::vec2(1.0f));
  glm::vec2 size = glm::max(panel.size, glm::vec2(0.0f));
  size.x = std::floor(std::min(size.x > 0.0f ? size.x : ems.x * ImGui::GetFontSize(), room.x));
  size.y = std::floor(std::min(size.y > 0.0f ? size.y : ems.y > 0.0f ? ems.y * ImGui::GetFontSize() : room.y, room.y));
  if (column.width > 0.0f && column.top + size.y > display.y - margin()) {
    column = {.inset = column.inset + column.width + margin(), .top = margin()};
  }
  const float x = edge == Edge::left ? column.inset : std::max(display.x - column.inset - size.x, margin());
  const glm::vec2 corner(std::floor(x), std::floor(column.top));
  if (corner != panel.corner || size != panel.given) {
    ImGui::SetNextWindowPos({corner.x, corner.y});
    ImGui::SetNextWindowSize({size.x, size.y});
    panel.corner = corner;
    panel.given = size;
  }
}

// What the person did to the window that was just begun. Without the pointer it was ImGui, in a window too small.
void PanelDock::follow(Panel& panel, Edge edge) {
  const ImVec2 corner = ImGui::GetWindowPos();
  const ImVec2 size = ImGui::GetWindowSize();
  const bool held = ImGui::IsMouseDown(ImGuiMouseButton_Left);
  if (held && glm::distance(glm::vec2(corner.x, corner.y), panel.corner) > 0.5f) {
    panel.docked = false;
    ImGui::MarkIniSettingsDirty();
    return;
  }
  if (held && !ImGui::IsWindowCollapsed() && glm::distance(glm::vec2(size.x, size.y), panel.given) > 0.5f) {
    panel.size = panel.given = {size.x, size.y};
  }
  Column& column = edge == Edge::left ? left_ : right_;
  column.top += size.y + margin();
  column.width = std::max(column.width, size.x);
}

bool PanelDock::begin(const char* name, bool* open, Edge edge, const glm::vec2& ems, int windowFlags) {
  Panel& panel = this->panel(name);
  if (!panel.docked) {
    ImGui::SetNextWindowSize({ems.x * ImGui::GetFontSize(), ems.y * ImGui::GetFontSize()}, ImGuiCond_FirstUseEver);
    return ImGui::Begin(name, open, windowFlags);
  }
  place(panel, edge, ems);
  const bool visible = ImGui::Begin(name, open, windowFlags | ImGuiWindowFlags_NoSavedSettings);
  follow(panel, edge);
  return visible;
}

}  // namespace speculum
