#include <imgui.h>
#include <imgui_internal.h>
#include <imgui_versions.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include "platform/text.hpp"
#include "ui/panels.hpp"

namespace speculum {

void Thumbnails::addTo(ImFontAtlas& atlas) {
  rects_.assign(pictures_.size(), -1);
  for (size_t i = 0; i < pictures_.size(); ++i) {
    if (pictures_[i].width > 0) {
      rects_[i] = imgui::reserveInAtlas(atlas, pictures_[i].width, pictures_[i].height);
    }
  }
  for (size_t i = 0; i < pictures_.size(); ++i) {
    if (rects_[i] < 0) {
      continue;
    }
    for (int y = 0; y < pictures_[i].height; ++y) {
      const uint8_t* row = pictures_[i].at(0, y);
      std::copy(row, row + static_cast<size_t>(4) * pictures_[i].width, imgui::atlasTexels(atlas, rects_[i], y));
    }
  }
}

bool Thumbnails::draw(ImDrawList& list, size_t picture, const glm::vec2& low, const glm::vec2& high) const {
  if (picture >= rects_.size() || rects_[picture] < 0) {
    return false;
  }
  const ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  ImVec2 first;
  ImVec2 last;
  imgui::atlasCorners(atlas, rects_[picture], first, last);
  list.AddImageRounded(imgui::atlasTexture(atlas), {low.x, low.y}, {high.x, high.y}, first, last, IM_COL32_WHITE,
                       ImGui::GetStyle().FrameRounding);
  return true;
}

namespace panels {

namespace {

constexpr float tileEms = 8.2f;  // least width of a tile, in sizes of the font
constexpr float tileAspect = 192.0f / 108.0f;

// Draws as much of the text as fits into the tile.
void textWithin(const std::string& whole, const ImVec2& low, const ImVec2& high, float align) {
  const std::string text = endsThatFit(whole, high.x - low.x, textWidth);
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const ImVec2 at(low.x + std::max(0.0f, align * (high.x - low.x - size.x)), low.y + 0.5f * (high.y - low.y - size.y));
  ImGui::GetWindowDrawList()->AddText(at, ImGui::GetColorU32(ImGuiCol_Text), text.c_str());
}

// Returns the title; the file's name if there is no title or another scene has the same one.
std::string captionOf(const std::vector<SceneEntry>& scenes, const SceneEntry& scene) {
  const auto same = std::ranges::count(scenes, scene.title, &SceneEntry::title);
  return scene.title.empty() || same > 1 ? scene.file.filename().string() : scene.title;
}

void tile(PanelContext& ui, const Thumbnails& thumbnails, size_t index, const ImVec2& size) {
  const SceneEntry& scene = ui.input.browser.scenes[index];
  const bool shown = index == ui.input.browser.shown;
  const float titleHeight = 1.35f * ImGui::GetFontSize();
  ImGui::PushID(static_cast<int>(index));
  if (ImGui::InvisibleButton("scene", {size.x, size.y + titleHeight}) && !shown) {
    ui.send(OpenScene{scene.file});
  }
  recordWidget(ui, "gallery." + scene.name);
  const bool hot = ImGui::IsItemHovered() || (ImGui::IsItemFocused() && ImGui::GetIO().NavVisible);
  if (ImGui::IsItemHovered()) {
    showTip(scene.name + "\n" + scene.file.string());
  }
  const ImVec2 low = ImGui::GetItemRectMin();
  const ImVec2 high(low.x + size.x, low.y + size.y);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (!thumbnails.draw(list, index, {low.x, low.y}, {high.x, high.y})) {
    list.AddRectFilled(low, high, ImGui::GetColorU32(ImGuiCol_FrameBg), ImGui::GetStyle().FrameRounding);
    textWithin(scene.name, low, high, 0.5f);
  }
  if (hot || shown) {
    const ImGuiCol color = hot ? ImGuiCol_ButtonHovered : ImGuiCol_CheckMark;
    list.AddRect(low, high, ImGui::GetColorU32(color), ImGui::GetStyle().FrameRounding, 0,
                 0.17f * ImGui::GetFontSize());
  }
  textWithin(captionOf(ui.input.browser.scenes, scene), {low.x, high.y}, {high.x, high.y + titleHeight}, 0.0f);
  ImGui::PopID();
}

}  // namespace

// Draws the shown scene's thumbnail, if it has one, and its title where panels leave room.
void poster(const PanelContext& ui, const Thumbnails& thumbnails, const WindowRect& picture) {
  constexpr float ems = 28.0f;
  const ShownScenes& browser = ui.input.browser;
  if (!browser.poster) {
    return;
  }
  const float width = std::min(ems * ImGui::GetFontSize(), 0.9f * picture.size.x);
  const glm::vec2 size(width, width / tileAspect);
  const glm::vec2 low = glm::floor(picture.corner + 0.5f * (picture.size - size));
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.AddRectFilled({0.0f, 0.0f}, ImGui::GetIO().DisplaySize, IM_COL32(20, 20, 23, 255));
  const bool drawn = thumbnails.draw(list, browser.shown, low, low + size);
  const std::string title = captionOf(browser.scenes, browser.scenes[browser.shown]);
  list.AddText({low.x + 0.5f * (width - textWidth(title)),
                low.y + (drawn ? size.y + 0.5f * ImGui::GetFontSize() : 0.5f * size.y)},
               IM_COL32_WHITE, title.c_str());
}

void gallery(PanelContext& ui, const Thumbnails& thumbnails) {
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const float room = ImGui::GetContentRegionAvail().x + gap;
  const int columns = std::max(1, static_cast<int>(room / (tileEms * ImGui::GetFontSize() + gap)));
  const float width = std::floor(room / static_cast<float>(columns) - gap);
  int* found = ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("shown"), -1);  // the tile that was scrolled to
  for (size_t i = 0; i < ui.input.browser.scenes.size(); ++i) {
    if (i % static_cast<size_t>(columns) > 0) {
      ImGui::SameLine();
    }
    tile(ui, thumbnails, i, {width, width / tileAspect});
    const int index = static_cast<int>(i);
    if (i == ui.input.browser.shown && std::exchange(*found, index) != index) {
      ImGui::ScrollToBringRectIntoView(ImGui::GetCurrentWindow(), ImGui::GetCurrentContext()->LastItemData.Rect);
    }
  }
}

}  // namespace panels
}  // namespace speculum
