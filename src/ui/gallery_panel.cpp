#include <imgui.h>
#include <imgui_internal.h>
#include <imgui_versions.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include "image/smooth_enlargement.hpp"
#include "platform/text.hpp"
#include "ui/panels.hpp"

namespace speculum {

namespace {

// The poster's size. Its texels are enlarged once more, linearly, where that is no longer seen. The atlas may be no
// wider than 512 texels.
constexpr glm::ivec2 posterSize(480, 270);

bool drawRect(ImDrawList& list, int rect, const glm::vec2& low, const glm::vec2& high, float rounding) {
  if (rect < 0) {
    return false;
  }
  const ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  ImVec2 first;
  ImVec2 last;
  imgui::atlasCorners(atlas, rect, first, last);
  list.AddImageRounded(imgui::atlasTexture(atlas), {low.x, low.y}, {high.x, high.y}, first, last, IM_COL32_WHITE,
                       rounding);
  return true;
}

}  // namespace

bool Thumbnails::setPoster(const Image8& picture) {
  if (picture.width == 0 && poster_.width == 0) {
    return false;
  }
  poster_ = picture.width > 0 ? smoothlyEnlarged(picture, posterSize.x, posterSize.y) : Image8();
  return true;
}

void Thumbnails::addTo(ImFontAtlas& atlas) {
  const auto picture = [this](size_t i) -> const Image8& { return i < pictures_.size() ? pictures_[i] : poster_; };
  rects_.assign(pictures_.size() + 1, -1);
  for (size_t i = 0; i < rects_.size(); ++i) {
    if (picture(i).width > 0) {
      rects_[i] = imgui::reserveInAtlas(atlas, picture(i).width, picture(i).height);
    }
  }
  for (size_t i = 0; i < rects_.size(); ++i) {
    for (int y = 0; rects_[i] >= 0 && y < picture(i).height; ++y) {
      const uint8_t* row = picture(i).at(0, y);
      std::copy(row, row + static_cast<size_t>(4) * picture(i).width, imgui::atlasTexels(atlas, rects_[i], y));
    }
  }
}

bool Thumbnails::draw(ImDrawList& list, size_t picture, const glm::vec2& low, const glm::vec2& high) const {
  return picture + 1 < rects_.size() && drawRect(list, rects_[picture], low, high, ImGui::GetStyle().FrameRounding);
}

bool Thumbnails::drawPoster(ImDrawList& list, const glm::vec2& low, const glm::vec2& high) const {
  return !rects_.empty() && drawRect(list, rects_.back(), low, high, 0.0f);
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

// Fills the display with the shown scene's thumbnail or, if it has none, draws its title into the free part.
void poster(const PanelContext& ui, const Thumbnails& thumbnails, const WindowRect& free) {
  const ShownScenes& browser = ui.input.browser;
  if (!browser.poster) {
    return;
  }
  const glm::vec2 display(ImGui::GetIO().DisplaySize.x, ImGui::GetIO().DisplaySize.y);
  const glm::vec2 size = std::max(display.x / tileAspect, display.y) * glm::vec2(tileAspect, 1.0f);
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  if (thumbnails.drawPoster(list, 0.5f * (display - size), 0.5f * (display + size))) {
    return;
  }
  list.AddRectFilled({0.0f, 0.0f}, {display.x, display.y}, IM_COL32(20, 20, 23, 255));
  const std::string title = captionOf(browser.scenes, browser.scenes[browser.shown]);
  const glm::vec2 middle = free.corner + 0.5f * free.size;
  list.AddText({middle.x - 0.5f * textWidth(title), middle.y}, IM_COL32_WHITE, title.c_str());
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
