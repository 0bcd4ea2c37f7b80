#include "compare/heat_map.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtx/component_wise.hpp>
#include <numbers>
#include <string>
#include <string_view>

#include "image/color.hpp"

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

void drawLegend(Image8& image, int top, double largest) {
  const int scale = textScale(image.width);
  for (int y = top; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const bool bar = y >= top + margin && y < top + margin + barHeight;
      setPixel(image, x, y, bar ? heatColor(x / std::max(1.0, image.width - 1.0)) : glm::dvec3(0.0));
    }
  }
  // Draws the most labels that fit with a gap between them, at least both ends.
  const int widest = textWidth(fmt::format("{:.3g}", largest * 0.25), scale) + 8 * scale;
  const int steps = image.width >= 5 * widest ? 4 : image.width >= 3 * widest ? 2 : 1;
  for (int i = 0; i <= steps; ++i) {
    const std::string text = fmt::format("{:.3g}", largest * i / steps);
    const int width = textWidth(text, scale);
    const int x = std::clamp((image.width - 1) * i / steps - width / 2, 1, std::max(1, image.width - 1 - width));
    drawText(image, x, top + margin + barHeight + margin, text, scale);
  }
}

}  // namespace

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

Image8 heatMap(const Plane2d& map, double top) {
  Image8 image(map.width, map.height + legendHeight(map.width));
  const Image8 colors = heatColors(map, top);
  std::ranges::copy(colors.rgba, image.rgba.begin());
  drawLegend(image, map.height, top);
  return image;
}

}  // namespace speculum
