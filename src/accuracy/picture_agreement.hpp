#pragma once

#include <cstdint>
#include <span>

#include "image/image.hpp"

namespace speculum {

// Tells two pictures that agree but for stray pixels along edges from those that differ in a patch.
struct PictureAgreement {
  int64_t counted = 0;      // pixels that are not excluded
  int64_t over = 0;         // counted pixels that differ by more than the tolerance in any of R, G, B
  int largest = 0;          // difference of a counted pixel, 1/255
  bool solidBlock = false;  // some 3x3 block of counted pixels lies wholly over: not an edge, a patch
  int blockX = -1;          // top left pixel of the first such block
  int blockY = -1;

  double fractionWithin() const {
    return counted == 0 ? 1.0 : 1.0 - static_cast<double>(over) / static_cast<double>(counted);
  }
  bool holds(double requiredFraction) const { return fractionWithin() >= requiredFraction && !solidBlock; }
};

// `exclude`: empty, or one value per pixel, not zero where differences do not count. Throws std::runtime_error when
// sizes differ.
PictureAgreement pictureAgreement(const Image8& a, const Image8& b, int tolerance,
                                  std::span<const uint8_t> exclude = {});

}  // namespace speculum
