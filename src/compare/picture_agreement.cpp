#include "compare/picture_agreement.hpp"

#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <utility>

namespace speculum {

PictureAgreement difference(const Image8& a, const Image8& b, int tolerance, const std::vector<bool>& counts) {
  if (a.width != b.width || a.height != b.height) {
    throw std::runtime_error("pictures of different sizes cannot be compared");
  }
  PictureAgreement result;
  std::vector<bool>& over = result.isOver;
  for (size_t i = 0; i < a.rgba.size() / 4; ++i) {
    int difference = -1;
    for (size_t k = 4 * i; k < 4 * i + 3 && (counts.empty() || counts[i]); ++k) {
      difference = std::max(difference, std::abs(a.rgba[k] - b.rgba[k]));
    }
    over.push_back(difference > tolerance);
    result.counted += difference >= 0;
    result.over += over.back();
    result.largest = std::max(result.largest, difference);
  }
  const auto blockAt = [&](int left, int top) {
    for (int i = 0; i < 9; ++i) {
      if (!over[static_cast<size_t>(top + i / 3) * a.width + left + i % 3]) {
        return false;
      }
    }
    return true;
  };
  for (int y = 0; y + 2 < a.height && !result.block; ++y) {
    for (int x = 0; x + 2 < a.width && !result.block; ++x) {
      if (blockAt(x, y)) {
        result.block = glm::ivec2(x, y);
      }
    }
  }
  return result;
}

Image8 differencePicture(const Image8& a, const Image8& b, const PictureAgreement& agreement, double gain) {
  Image8 picture(a.width, a.height);
  const auto raise = [&](int x, int y, const uint8_t* color) {
    if (x >= 0 && y >= 0 && x < picture.width && y < picture.height) {
      for (int c = 0; c < 3; ++c) {
        picture.at(x, y)[c] = std::max(picture.at(x, y)[c], color[c]);
      }
    }
  };
  for (size_t i = 0; i < picture.rgba.size(); ++i) {
    picture.rgba[i] = i % 4 == 3 ? 255 : 0;
  }
  for (size_t i = 0; i < agreement.isOver.size(); ++i) {
    const int x = static_cast<int>(i % a.width);
    const int y = static_cast<int>(i / a.width);
    uint8_t color[3];
    for (size_t c = 0; c < 3; ++c) {
      color[c] = static_cast<uint8_t>(std::min(255.0, gain * std::abs(a.rgba[4 * i + c] - b.rgba[4 * i + c])));
    }
    const int reach = agreement.isOver[i] ? 1 : 0;
    for (int k = 0; k < (2 * reach + 1) * (2 * reach + 1); ++k) {
      raise(x + k % 3 - reach, y + k / 3 - reach, color);
    }
  }
  return picture;
}

// Groups tiles rather than pixels, because the pixels of one fault need not touch.
std::optional<PixelRect> largestGroup(const PictureAgreement& agreement, int width) {
  constexpr int side = 8;  // pixels of a tile
  struct Group {
    int pixels = 0;
    glm::ivec2 low{1 << 30};
    glm::ivec2 high{0};
  };
  const int height = static_cast<int>(agreement.isOver.size()) / std::max(1, width);
  const int columns = (width + side - 1) / side;
  const int rows = (height + side - 1) / side;
  std::vector<Group> tiles(static_cast<size_t>(columns) * rows);
  for (size_t i = 0; i < agreement.isOver.size(); ++i) {
    if (agreement.isOver[i]) {
      const glm::ivec2 at(i % width, i / width);
      Group& tile = tiles[static_cast<size_t>(at.y / side) * columns + at.x / side];
      tile = {tile.pixels + 1, glm::min(tile.low, at), glm::max(tile.high, at)};
    }
  }
  Group largest;
  for (size_t first = 0; first < tiles.size(); ++first) {
    Group group;
    std::vector<size_t> next{first};
    while (!next.empty()) {
      const size_t index = next.back();
      next.pop_back();
      const Group tile = std::exchange(tiles[index], Group());
      if (tile.pixels == 0) {
        continue;
      }
      group = {group.pixels + tile.pixels, glm::min(group.low, tile.low), glm::max(group.high, tile.high)};
      const int x = static_cast<int>(index) % columns;
      const int y = static_cast<int>(index) / columns;
      for (int k = 0; k < 9; ++k) {
        const int column = x + k % 3 - 1;
        const int row = y + k / 3 - 1;
        if (column >= 0 && row >= 0 && column < columns && row < rows) {
          next.push_back(static_cast<size_t>(row) * columns + column);
        }
      }
    }
    if (group.pixels > largest.pixels) {
      largest = group;
    }
  }
  if (largest.pixels == 0) {
    return std::nullopt;
  }
  const glm::ivec2 extent = largest.high - largest.low + 1;
  return PixelRect{largest.low.x, largest.low.y, extent.x, extent.y};
}

}  // namespace speculum
