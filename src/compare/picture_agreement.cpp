#include "compare/picture_agreement.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <glm/gtx/component_wise.hpp>
#include <numbers>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace speculum {

namespace {

constexpr int glyphWidth = 3;
constexpr int glyphHeight = 5;
constexpr int barHeight = 10;
constexpr int margin = 3;

// Bitmaps of the characters in glyphNames: each octal digit is a row of three pixels, the first digit the top one.
constexpr std::string_view glyphNames = "0123456789.e-";
constexpr std::array<uint16_t, 13> glyphs{075557, 026227, 071747, 071717, 055711, 074717, 074757,
                                          071111, 075757, 075717, 000002, 007747, 000700};

glm::dvec3 linearFromOklab(const glm::dvec3& lab) {
  const double l = lab.x + 0.3963377774 * lab.y + 0.2158037573 * lab.z;
  const double m = lab.x - 0.1055613458 * lab.y - 0.0638541728 * lab.z;
  const double s = lab.x - 0.0894841775 * lab.y - 1.2914855480 * lab.z;
  const glm::dvec3 lms(l * l * l, m * m * m, s * s * s);
  return {4.0767416621 * lms.x - 3.3077115913 * lms.y + 0.2309699292 * lms.z,
          -1.2684380046 * lms.x + 2.6097574011 * lms.y - 0.3413193965 * lms.z,
          -0.0041960863 * lms.x - 0.7034186147 * lms.y + 1.7076147010 * lms.z};
}

bool inGamut(const glm::dvec3& c) {
  return glm::compMin(c) >= 0.0 && glm::compMax(c) <= 1.0;
}

void setPixel(Image8& image, int x, int y, const glm::dvec3& color) {
  if (x < 0 || y < 0 || x >= image.width || y >= image.height) {
    return;
  }
  for (int c = 0; c < 3; ++c) {
    image.at(x, y)[c] = static_cast<uint8_t>(std::lround(255.0 * color[c]));
  }
}

int textScale(int width) {
  return width >= 480 ? 2 : 1;
}

int textWidth(const std::string& text, int scale) {
  return static_cast<int>(text.size()) * (glyphWidth + 1) * scale - scale;
}

void drawText(Image8& image, int x, int y, const std::string& text, int scale) {
  for (size_t i = 0; i < text.size(); ++i) {
    const size_t index = glyphNames.find(text[i]);
    if (index == std::string_view::npos) {
      continue;
    }
    const int left = x + static_cast<int>(i) * (glyphWidth + 1) * scale;
    for (int p = 0; p < glyphWidth * scale * glyphHeight * scale; ++p) {
      const int column = p % (glyphWidth * scale);
      const int row = p / (glyphWidth * scale);
      const int bitsAfter = glyphWidth * glyphHeight - 1 - row / scale * glyphWidth - column / scale;
      if (glyphs[index] >> bitsAfter & 1) {
        setPixel(image, left + column, y + row, glm::dvec3(1.0));
      }
    }
  }
}

void drawLegend(Image8& image, int top) {
  const int scale = textScale(image.width);
  for (int y = top; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const bool bar = y >= top + margin && y < top + margin + barHeight;
      setPixel(image, x, y, bar ? heatColor(x / std::max(1.0, image.width - 1.0)) : glm::dvec3(0.0));
    }
  }
  // Draws the most labels that fit with a gap between them, at least both ends.
  const int widest = textWidth("0.25", scale) + 8 * scale;
  const int steps = image.width >= 5 * widest ? 4 : image.width >= 3 * widest ? 2 : 1;
  for (int i = 0; i <= steps; ++i) {
    const std::string text = fmt::format("{:.3g}", 1.0 * i / steps);
    const int width = textWidth(text, scale);
    const int x = std::clamp((image.width - 1) * i / steps - width / 2, 1, std::max(1, image.width - 1 - width));
    drawText(image, x, top + margin + barHeight + margin, text, scale);
  }
}

}  // namespace

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

glm::dvec3 heatColor(double t) {
  const double at = std::clamp(t, 0.0, 1.0);
  const double lightness = 0.12 + 0.85 * at;
  const double hue = (300.0 + 165.0 * at) * std::numbers::pi / 180.0;
  const glm::dvec2 direction(std::cos(hue), std::sin(hue));
  double chroma = 0.22 * std::sin(std::numbers::pi * (0.1 + 0.78 * at));
  glm::dvec3 linear = linearFromOklab({lightness, chroma * direction});
  while (!inGamut(linear) && chroma > 0.0) {
    chroma = std::max(0.0, chroma - 0.002);
    linear = linearFromOklab({lightness, chroma * direction});
  }
  return {srgbEncode(linear.r), srgbEncode(linear.g), srgbEncode(linear.b)};
}

int legendHeight(int width) {
  return margin + barHeight + margin + glyphHeight * textScale(width) + margin;
}

Image8 heatColors(const Plane2d& map, double top) {
  Image8 image(map.width, map.height);
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      setPixel(image, x, y, heatColor(map.at(x, y) / top));
    }
  }
  return image;
}

Image8 heatMap(const Plane2d& map) {
  Image8 image(map.width, map.height + legendHeight(map.width));
  const Image8 colors = heatColors(map);
  std::ranges::copy(colors.rgba, image.rgba.begin());
  drawLegend(image, map.height);
  return image;
}

}  // namespace speculum
