#pragma once

#include <vector>

#include "image/image.hpp"

struct ImFontAtlas;

namespace speculum {

// Small pictures within the font atlas, the one texture that ImGui's Vulkan backend draws.
class Thumbnails {
 public:
  // A picture without pixels stands for none.
  explicit Thumbnails(std::vector<Image8> pictures = {}) : pictures_(std::move(pictures)) {}

  // After the fonts were added and before the atlas is uploaded: packs the pictures with them.
  void addTo(ImFontAtlas& atlas);
  // Draws one into a rectangle of the screen, by the current window's draw list; false if there is none.
  bool draw(size_t picture, const glm::vec2& low, const glm::vec2& high) const;

 private:
  std::vector<Image8> pictures_;
  std::vector<int> rects_;  // of the atlas; -1: none
};

}  // namespace speculum
