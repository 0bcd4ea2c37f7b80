#include "ui/panel_dock.hpp"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace speculum {

namespace {

constexpr float lowest = 12.0f;  // sizes of the font that a window is high at least

float margin() {
  return std::floor(0.8f * ImGui::GetFontSize());
}

glm::vec2 displaySize() {
  return {ImGui::GetIO().DisplaySize.x, ImGui::GetIO().DisplaySize.y};
}

}  // namespace

// ImGui remembers only windows that stand where they were put.
void PanelDock::rememberCollapsed() {
  ImGuiSettingsHandler handler;
  handler.TypeName = "Docked";
  handler.TypeHash = ImHashStr(handler.TypeName);
  handler.UserData = &collapsed_;
  handler.ReadOpenFn = [](ImGuiContext*, ImGuiSettingsHandler* self, const char* name) -> void* {
    // What was saved is saved as collapsed: others are not in the file.
    return const_cast<std::string*>(&*static_cast<std::set<std::string>*>(self->UserData)->insert(name).first);
  };
  handler.ReadLineFn = [](ImGuiContext*, ImGuiSettingsHandler*, void*, const char*) {};
  handler.WriteAllFn = [](ImGuiContext*, ImGuiSettingsHandler* self, ImGuiTextBuffer* out) {
    for (const std::string& name : *static_cast<std::set<std::string>*>(self->UserData)) {
      out->appendf("[%s][%s]\nCollapsed=1\n\n", self->TypeName, name.c_str());
    }
  };
  ImGui::GetCurrentContext()->SettingsHandlers.push_back(handler);
}

void PanelDock::followCollapsed(const char* name, Panel& panel) {
  const bool collapsed = panel.docked && ImGui::IsWindowCollapsed();
  if (collapsed != collapsed_.contains(name)) {
    collapsed ? void(collapsed_.insert(name)) : void(collapsed_.erase(name));
    ImGui::MarkIniSettingsDirty();
  }
}

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

// Below the last window of the edge, lower than wanted where there is little room; beside it where there is none; over
// it where there is none either.
void PanelDock::place(Panel& panel, Edge edge, const glm::vec2& ems) {
  Column& column = edge == Edge::left ? left_ : right_;
  const Column& other = edge == Edge::left ? right_ : left_;
  const float em = ImGui::GetFontSize();
  const glm::vec2 display = displaySize();
  const glm::vec2 room = glm::max(display - 2.0f * margin(), glm::vec2(1.0f));
  const glm::vec2 wanted(panel.size.x > 0.0f ? panel.size.x : ems.x * em, panel.size.y > 0.0f ? panel.size.y
                                                                          : ems.y > 0.0f      ? ems.y * em
                                                                                              : room.y);
  glm::vec2 size = glm::floor(glm::min(wanted, room));
  if (column.width > 0.0f && display.y - margin() - column.top < std::min(size.y, lowest * em)) {
    const float beside = column.inset + column.width + margin();
    const bool free = beside + size.x + other.inset + other.width + margin() <= display.x;
    column = {.inset = free ? beside : column.inset, .top = free ? margin() : display.y - margin() - lowest * em};
  }
  column.top = std::max(column.top, margin());
  size.y = std::max(std::min(size.y, std::floor(display.y - margin() - column.top)), 1.0f);
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
  if (!std::exchange(panel.begun, true)) {
    ImGui::SetNextWindowCollapsed(collapsed_.contains(name));
  }
  const bool visible = ImGui::Begin(name, open, windowFlags | ImGuiWindowFlags_NoSavedSettings);
  follow(panel, edge);
  followCollapsed(name, panel);
  return visible;
}

}  // namespace speculum
