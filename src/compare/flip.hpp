#pragma once

#include "compare/compared_image.hpp"
#include "compare/plane.hpp"

namespace speculum {

// The display that the metric assumes: 0.7 m away, 3840 pixels on 0.7 m.
constexpr double flipPixelsPerDegree = 67.0206;

// Returns the FLIP error of every pixel, 0 (no visible difference) to 1, on display sRGB: Andersson et al., "FLIP: A
// Difference Evaluator for Alternating Images" (2020), the variant for low dynamic range. Sizes must be equal.
Plane2d flipMap(const ComparedImage& reference, const ComparedImage& test);

}  // namespace speculum
