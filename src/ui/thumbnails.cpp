#include "ui/thumbnails.hpp"

#include <imgui.h>

#include <algorithm>

namespace speculum {

void Thumbnails::addTo(ImFontAtlas& atlas) {
  rects_.assign(pictures_.size(), -1);
  for (size_t i = 0; i < pictures_.size(); ++i) {
    if (pictures_[i].width > 0) {
      rects_[i] = atlas.AddCustomRectRegular(pictures_[i].width, pictures_[i].height);
    }
  }
  unsigned char* texels = nullptr;
  int width = 0;
  int height = 0;
  atlas.GetTexDataAsRGBA32(&texels, &width, &height);
  for (size_t i = 0; i < pictures_.size(); ++i) {
    if (rects_[i] < 0) {
      continue;
    }
    const ImFontAtlasCustomRect& rect = *atlas.GetCustomRectByIndex(rects_[i]);
    for (int y = 0; y < pictures_[i].height; ++y) {
      const uint8_t* row = pictures_[i].at(0, y);
      std::copy(row, row + static_cast<size_t>(4) * pictures_[i].width,
                texels + 4 * (static_cast<size_t>(rect.Y + y) * width + rect.X));
    }
  }
}

bool Thumbnails::draw(ImDrawList& list, size_t picture, const glm::vec2& low, const glm::vec2& high) const {
  if (picture >= rects_.size() || rects_[picture] < 0) {
    return false;
  }
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  ImVec2 first;
  ImVec2 last;
  atlas.CalcCustomRectUV(atlas.GetCustomRectByIndex(rects_[picture]), &first, &last);
  list.AddImageRounded(atlas.TexID, {low.x, low.y}, {high.x, high.y}, first, last, IM_COL32_WHITE,
                       ImGui::GetStyle().FrameRounding);
  return true;
}

}  // namespace speculum
