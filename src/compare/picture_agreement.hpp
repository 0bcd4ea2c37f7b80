#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "compare/compared_image.hpp"
#include "geometry/projection.hpp"
#include "image/image.hpp"

namespace speculum {

// Agreement of two pictures. Distinguishes pictures that agree except for stray pixels along edges from those that
// differ in a patch.
struct PictureAgreement {
  int counted = 0;                  // pixels that were compared
  int over = 0;                     // pixels that differ by more than the tolerance in red, green or blue
  int largest = 0;                  // largest difference in red, green or blue, 1/255
  std::vector<bool> isOver;         // of each pixel
  std::optional<glm::ivec2> block;  // top left pixel of the first 3x3 block that lies wholly over: a patch, no edge

  double share() const { return counted == 0 ? 0.0 : static_cast<double>(over) / counted; }  // of `over` in `counted`
  bool holds() const { return share() <= 0.001 && !block; }
};

// Compares the pixels whose `counts` is set, all of them if it is empty; the tolerance is in 1/255. Throws
// std::runtime_error when sizes differ.
PictureAgreement difference(const Image8& a, const Image8& b, int tolerance, const std::vector<bool>& counts = {});

// Returns red, green and blue of the difference times `gain`. Pixels over the tolerance also fill their neighbours, so
// that single pixels are seen.
Image8 differencePicture(const Image8& a, const Image8& b, const PictureAgreement& agreement, double gain);

// Returns the bounds of the largest group of near pixels over the tolerance; nothing if no pixel is over.
std::optional<PixelRect> largestGroup(const PictureAgreement& agreement, int width);

// Returns a color of the perceptual color map for t in [0, 1] (clamped): lightness rises evenly in Oklab (Ottosson
// 2020) from near black to pale yellow while the hue turns from violet over red, so the map also reads in grey. Display
// sRGB, 0 .. 1.
glm::dvec3 heatColor(double t);

// Draws the map in colors of heatColor(), with `top` (> 0) and above in the brightest one.
Image8 heatColors(const Plane2d& map, double top = 1.0);

// Returns the number of rows that a legend adds below a map of this width.
int legendHeight(int width);

// Draws heatColors() with a legend from 0 to 1 below it.
Image8 heatMap(const Plane2d& map);

}  // namespace speculum
