#pragma once

#include "accuracy/compared_image.hpp"
#include "accuracy/plane.hpp"

namespace speculum {

// Structural similarity of every pixel, mean over RGB, on display values with data range 1: Wang, Bovik, Sheikh,
// Simoncelli, "Image Quality Assessment: From Error Visibility to Structural Similarity" (2004), Gaussian window with
// sigma 1.5 and 11 taps, population covariance, K1 = 0.01, K2 = 0.03. Sizes must be equal.
Plane2d ssimMap(const ComparedImage& reference, const ComparedImage& test);

// Width of the border, in pixels, whose windows reach beyond the picture; it does not count in the mean.
constexpr int ssimBorder = 5;

}  // namespace speculum
