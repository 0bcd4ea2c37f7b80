#include "image/color.hpp"

#include <algorithm>
#include <cmath>

namespace speculum {

namespace {

// Krzysztof Narkowicz, "ACES Filmic Tone Mapping Curve" (2016).
double acesFit(double x) {
  return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
}

uint8_t displayCode(double linear, const DisplayCurve& curve) {
  return static_cast<uint8_t>(std::floor(255.0 * displayValue(linear, curve) + 0.5));
}

}  // namespace

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
