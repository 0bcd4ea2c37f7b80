#pragma once

#include "image/image.hpp"

namespace speculum {

enum class ToneMap { clamp, aces };

// IEC 61966-2-1. Both take and return [0, 1].
double srgbEncode(double linear);
double srgbDecode(double encoded);

// Applies exposure, tone curve and sRGB curve and rounds to the nearest 8 bits, as the shader display.frag does.
Image8 toDisplay(const LinearImage& image, double exposure, ToneMap toneMap);

}  // namespace speculum
