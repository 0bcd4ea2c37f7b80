#include <imgui.h>

#include <algorithm>

#include "ui/panels.hpp"

namespace speculum::panels {

namespace {

constexpr float tileEms = 10.5f;  // width of a tile, in sizes of the font
constexpr float tileAspect = 192.0f / 108.0f;

// Text that does not fit ends at the tile's border.
void textWithin(const std::string& text, const ImVec2& low, const ImVec2& high, float align) {
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const ImVec2 at(low.x + std::max(0.0f, align * (high.x - low.x - size.x)), low.y + 0.5f * (high.y - low.y - size.y));
  ImGui::PushClipRect(low, high, true);
  ImGui::GetWindowDrawList()->AddText(at, ImGui::GetColorU32(ImGuiCol_Text), text.c_str());
  ImGui::PopClipRect();
}

void tile(UiModel& model, const Thumbnails& thumbnails, int scene, const ImVec2& size) {
  const float titleHeight = 1.35f * ImGui::GetFontSize();
  const std::string& name = model.scenes[static_cast<size_t>(scene)];
  const std::string& title = model.sceneTitles[static_cast<size_t>(scene)];
  ImGui::PushID(scene);
  if (ImGui::InvisibleButton("scene", {size.x, size.y + titleHeight})) {
    model.scene = scene;
  }
  notePlace(model, "gallery." + name);
  const bool hot = ImGui::IsItemHovered() || (ImGui::IsItemFocused() && ImGui::GetIO().NavVisible);
  if (ImGui::IsItemHovered()) {
    ImGui::SetTooltip("%s\n%s", name.c_str(), model.scenePaths[static_cast<size_t>(scene)].c_str());
  }
  const ImVec2 low = ImGui::GetItemRectMin();
  const ImVec2 high(low.x + size.x, low.y + size.y);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (!thumbnails.draw(static_cast<size_t>(scene), {low.x, low.y}, {high.x, high.y})) {
    list.AddRectFilled(low, high, ImGui::GetColorU32(ImGuiCol_FrameBg), ImGui::GetStyle().FrameRounding);
    textWithin(name, low, high, 0.5f);
  }
  if (hot || scene == model.scene) {
    const ImGuiCol color = hot ? ImGuiCol_ButtonHovered : ImGuiCol_CheckMark;
    list.AddRect(low, high, ImGui::GetColorU32(color), ImGui::GetStyle().FrameRounding, 0,
                 0.17f * ImGui::GetFontSize());
  }
  textWithin(title.empty() ? name : title, {low.x, high.y}, {high.x, high.y + titleHeight}, 0.0f);
  ImGui::PopID();
}

}  // namespace

void gallery(UiModel& model, const Thumbnails& thumbnails) {
  const float width = tileEms * ImGui::GetFontSize();
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const int columns = std::max(1, static_cast<int>((ImGui::GetContentRegionAvail().x + gap) / (width + gap)));
  for (int i = 0; i < static_cast<int>(model.scenes.size()); ++i) {
    if (i % columns > 0) {
      ImGui::SameLine();
    }
    tile(model, thumbnails, i, {width, width / tileAspect});
  }
}

}  // namespace speculum::panels
