#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "image/image.hpp"

namespace speculum {

enum class ToneMap { clamp, aces };

// The curve of sRGB (IEC 61966-2-1) and its inverse. Both take and return [0, 1].
double srgbEncode(double linear);
double srgbDecode(double encoded);
const std::array<float, 256>& srgbDecoded();  // srgbDecode() by 8-bit code
// Returns the 8-bit code for which srgbDecoded() has exactly this value; nothing if there is none.
std::optional<uint8_t> srgbCode(float linear);

// Settings that turn radiance into a picture, besides the sRGB curve.
struct DisplayCurve {
  double exposure = 1.0;
  ToneMap toneMap = ToneMap::clamp;

  bool operator==(const DisplayCurve&) const = default;
};

// Applies exposure, tone curve and sRGB curve to one channel. Returns [0, 1]; 0 for what is no number.
double displayValue(double linear, const DisplayCurve& curve);
// Does so for a picture and rounds to the nearest 8 bits, as shaders/display.glsl does.
Image8 toDisplay(const LinearImage& image, const DisplayCurve& curve = {});

}  // namespace speculum
