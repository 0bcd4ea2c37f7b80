#pragma once

#include <vector>

#include "image/image.hpp"

struct ImDrawList;
struct ImFontAtlas;

namespace speculum {

// Small pictures within the font atlas, the one texture that ImGui's Vulkan backend draws.
class Thumbnails {
 public:
  // A picture without pixels stands for a missing one.
  explicit Thumbnails(std::vector<Image8> pictures = {}) : pictures_(std::move(pictures)) {}

  // Packs the pictures with the fonts. Call it after the fonts are added and before the atlas is uploaded.
  void addTo(ImFontAtlas& atlas);
  // Draws a picture into a rectangle of the screen. Returns false if there is no such picture.
  bool draw(ImDrawList& list, size_t picture, const glm::vec2& low, const glm::vec2& high) const;

 private:
  std::vector<Image8> pictures_;
  std::vector<int> rects_;  // by picture: its rectangle in the atlas; -1: none
};

}  // namespace speculum
