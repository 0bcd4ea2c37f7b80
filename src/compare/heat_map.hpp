#pragma once

#include <glm/glm.hpp>

#include "compare/plane.hpp"
#include "image/image.hpp"

namespace speculum {

// Returns a color of the perceptual color map for t in [0, 1] (clamped): lightness rises evenly in Oklab (Ottosson
// 2020) from near black to pale yellow while the hue turns from violet over red, so the map also reads in grey. Display
// sRGB, 0 .. 1.
glm::dvec3 heatColor(double t);

// Draws the map in colors of heatColor(), with `top` (> 0) and above in the brightest one.
Image8 heatColors(const Plane2d& map, double top = 1.0);

// Returns the number of rows that a legend adds below a map of this width.
int legendHeight(int width);

// Draws heatColors() with a legend from 0 to `top` below it.
Image8 heatMap(const Plane2d& map, double top = 1.0);

}  // namespace speculum
