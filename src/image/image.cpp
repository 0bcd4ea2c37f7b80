#include "image/image.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace speculum {

namespace {

// The two texels about a position along one axis, and the weight of the second. Beyond the border its texels repeat.
struct Taps {
  int first = 0;
  int second = 0;
  float weight = 0.0f;
};

Taps tapsAt(int pixel, int pixels, int texels) {
  const double position = (pixel + 0.5) * texels / pixels - 0.5;
  const int texel = static_cast<int>(std::floor(position));
  return {std::clamp(texel, 0, texels - 1), std::clamp(texel + 1, 0, texels - 1),
          static_cast<float>(position - std::floor(position))};
}

// Krzysztof Narkowicz, "ACES Filmic Tone Mapping Curve" (2016).
double acesFit(double x) {
  return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
}

uint8_t displayCode(double linear, const DisplayCurve& curve) {
  return static_cast<uint8_t>(std::floor(255.0 * displayValue(linear, curve) + 0.5));
}

}  // namespace

LinearImage enlarged(const LinearImage& image, int width, int height) {
  if (image.width == width && image.height == height) {
    return image;
  }
  LinearImage large(width, height);
  for (int y = 0; y < height; ++y) {
    const Taps rows = tapsAt(y, height, image.height);
    for (int x = 0; x < width; ++x) {
      const Taps columns = tapsAt(x, width, image.width);
      const glm::vec3& a = image.at(columns.first, rows.first);
      const glm::vec3& b = image.at(columns.second, rows.first);
      const glm::vec3& c = image.at(columns.first, rows.second);
      const glm::vec3& d = image.at(columns.second, rows.second);
      const glm::vec3 mean = glm::mix(glm::mix(a, b, columns.weight), glm::mix(c, d, columns.weight), rows.weight);
      // Rounding must not leave the range of the four texels.
      large.at(x, y) =
          glm::clamp(mean, glm::min(glm::min(a, b), glm::min(c, d)), glm::max(glm::max(a, b), glm::max(c, d)));
    }
  }
  return large;
}

std::optional<PictureSize> pictureSize(std::string_view text) {
  constexpr int largestSide = 16384;
  PictureSize size;
  const char* end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, size.width);
  const bool cross = width.ec == std::errc() && width.ptr != end && *width.ptr == 'x';
  const auto height = cross ? std::from_chars(width.ptr + 1, end, size.height) : width;
  if (!cross || height.ec != std::errc() || height.ptr != end || size.width < 1 || size.height < 1 ||
      size.width > largestSide || size.height > largestSide) {
    return std::nullopt;
  }
  return size;
}

double displayValue(double linear, const DisplayCurve& curve) {
  // The bound, the largest half float, keeps numerator and denominator of the fit from overflowing.
  const double x = curve.exposure * linear;
  const double exposed = x > 0.0 ? std::min(x, 65504.0) : 0.0;
  const double mapped = curve.toneMap == ToneMap::aces ? acesFit(exposed) : exposed;
  return srgbEncode(std::min(mapped, 1.0));
}

double srgbEncode(double linear) {
  const double x = std::clamp(linear, 0.0, 1.0);
  return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
}

double srgbDecode(double encoded) {
  const double x = std::clamp(encoded, 0.0, 1.0);
  return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}

const std::array<float, 256>& srgbDecoded() {
  static const std::array<float, 256> decoded = [] {
    std::array<float, 256> table{};
    for (size_t code = 0; code < table.size(); ++code) {
      table[code] = static_cast<float>(srgbDecode(static_cast<double>(code) / 255.0));
    }
    return table;
  }();
  return decoded;
}

std::optional<uint8_t> srgbCode(float linear) {
  const std::array<float, 256>& decoded = srgbDecoded();
  const auto found = std::ranges::lower_bound(decoded, linear);
  return found != decoded.end() && *found == linear ? std::optional(static_cast<uint8_t>(found - decoded.begin()))
                                                    : std::nullopt;
}

Image8 toDisplay(const LinearImage& image, const DisplayCurve& curve) {
  Image8 display(image.width, image.height);
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      display.rgba[i * 4 + c] = displayCode(image.pixels[i][c], curve);
    }
  }
  return display;
}

}  // namespace speculum
