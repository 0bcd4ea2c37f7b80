#include <imgui.h>

#include <algorithm>

#include "ui/panels.hpp"

namespace speculum::panels {

namespace {

constexpr float tileEms = 10.5f;  // width of a tile, in sizes of the font
constexpr float tileAspect = 192.0f / 108.0f;

// Draws text that is clipped at the tile's border.
void textWithin(const std::string& text, const ImVec2& low, const ImVec2& high, float align) {
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const ImVec2 at(low.x + std::max(0.0f, align * (high.x - low.x - size.x)), low.y + 0.5f * (high.y - low.y - size.y));
  ImGui::PushClipRect(low, high, true);
  ImGui::GetWindowDrawList()->AddText(at, ImGui::GetColorU32(ImGuiCol_Text), text.c_str());
  ImGui::PopClipRect();
}

void tile(PanelContext& ui, const Thumbnails& thumbnails, size_t index, const ImVec2& size) {
  const SceneEntry& scene = ui.view.browser.scenes[index];
  const bool shown = index == ui.view.browser.shown;
  const float titleHeight = 1.35f * ImGui::GetFontSize();
  ImGui::PushID(static_cast<int>(index));
  if (ImGui::InvisibleButton("scene", {size.x, size.y + titleHeight}) && !shown) {
    ui.send(OpenScene{scene.file});
  }
  recordWidget(ui, "gallery." + scene.name);
  const bool hot = ImGui::IsItemHovered() || (ImGui::IsItemFocused() && ImGui::GetIO().NavVisible);
  if (ImGui::IsItemHovered()) {
    ImGui::SetTooltip("%s\n%s", scene.name.c_str(), scene.file.c_str());
  }
  const ImVec2 low = ImGui::GetItemRectMin();
  const ImVec2 high(low.x + size.x, low.y + size.y);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (!thumbnails.draw(index, {low.x, low.y}, {high.x, high.y})) {
    list.AddRectFilled(low, high, ImGui::GetColorU32(ImGuiCol_FrameBg), ImGui::GetStyle().FrameRounding);
    textWithin(scene.name, low, high, 0.5f);
  }
  if (hot || shown) {
    const ImGuiCol color = hot ? ImGuiCol_ButtonHovered : ImGuiCol_CheckMark;
    list.AddRect(low, high, ImGui::GetColorU32(color), ImGui::GetStyle().FrameRounding, 0,
                 0.17f * ImGui::GetFontSize());
  }
  textWithin(scene.title.empty() ? scene.name : scene.title, {low.x, high.y}, {high.x, high.y + titleHeight}, 0.0f);
  ImGui::PopID();
}

}  // namespace

void gallery(PanelContext& ui, const Thumbnails& thumbnails) {
  const float width = tileEms * ImGui::GetFontSize();
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const int columns = std::max(1, static_cast<int>((ImGui::GetContentRegionAvail().x + gap) / (width + gap)));
  for (size_t i = 0; i < ui.view.browser.scenes.size(); ++i) {
    if (i % static_cast<size_t>(columns) > 0) {
      ImGui::SameLine();
    }
    tile(ui, thumbnails, i, {width, width / tileAspect});
  }
}

}  // namespace speculum::panels
