#pragma once

#include <span>

#include "compare/compared_image.hpp"
#include "compare/plane.hpp"

namespace speculum {

// The display that the metric assumes: 0.7 m away, 3840 pixels on 0.7 m.
constexpr double flipPixelsPerDegree = 67.0206;

// Returns the FLIP error of every pixel, 0 (no visible difference) to 1, on display sRGB: Andersson et al., "FLIP: A
// Difference Evaluator for Alternating Images" (2020), the variant for low dynamic range. Sizes must be equal.
// `perceived` receives `test` minus `reference` of every pixel, in the colors that FLIP compares: filtered to the
// detail that the eye resolves, as CIELAB with color weighted by lightness.
Plane2d flipMap(const ComparedImage& reference, const ComparedImage& test,
                std::vector<glm::dvec3>* perceived = nullptr);

// Returns the flicker between two frames of a movement, 0 to 1, from what flipMap() perceives of them: the mean over
// pixels of FLIP's error of color, taken of (now - before). That is how far the picture's change from frame to frame is
// from the reference's: an error that stays counts nothing, and a pixel that is wrong in one of the frames counts as in
// FLIP without the part for edges and points.
double flickerOf(std::span<const glm::dvec3> before, std::span<const glm::dvec3> now);

}  // namespace speculum
