// Errors due to 16-bit floats in targets: of radiance in steps of 8 bits, of disparity in pixels of reprojection.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>

#include "image/color.hpp"

namespace speculum {
namespace {

constexpr double largest = 65504.0;

double stored(double value) {
  return glm::unpackHalf1x16(glm::packHalf1x16(static_cast<float>(std::min(value, largest))));
}

double steps(double radiance, double exposure) {
  return 255.0 * srgbEncode(std::min(exposure * radiance, 1.0));
}

TEST(HalfFloatTargets, RadianceCostsHalfAStepAtMost) {
  for (double exposure = 1.0 / 4096.0; exposure <= 4096.0; exposure *= 2.0) {
    double worst = 0.0;
    for (double shown = 1e-7; shown < 1e4; shown *= 1.0007) {
      const double radiance = shown / exposure;
      worst = std::max(worst, std::abs(steps(stored(radiance), exposure) - steps(radiance, exposure)));
      // One bright sample of eight is cut to the largest half float before the mean.
      worst = std::max(worst, std::abs(steps(stored(radiance) / 8.0, exposure) - steps(radiance / 8.0, exposure)));
    }
    EXPECT_LE(worst, 0.5) << "exposure " << exposure;
  }
}

// The eye moves sideways between two frames; what is seen at distance w moves by focal * moved / w pixels.
TEST(HalfFloatTargets, DisparityMovesPixelsByATenthAtMost) {
  constexpr double focal = 1000.0;  // pixels
  constexpr double farthest = 200.0;
  double worst = 0.0;
  for (double w = 1.6e-5; w <= 1e7; w *= 1.003) {
    const double moved = std::min(farthest * w / focal, 100.0);
    worst = std::max(worst, focal * moved * std::abs(stored(1.0 / w) - 1.0 / w));
  }
  EXPECT_LE(worst, 0.1);
  EXPECT_GT(focal * 1e-6 * std::abs(stored(1e6) - 1e6), 0.1) << "nearer, disparities are cut";
}

}  // namespace
}  // namespace speculum
