#include "ui/thumbnails.hpp"

#include <imgui.h>
#include <imgui_versions.hpp>

#include <algorithm>

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

}  // namespace speculum
