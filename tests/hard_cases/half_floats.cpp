// Errors due to 16-bit floats in targets: of radiance in steps of 8 bits, of disparity in pixels of reprojection.
#include <glm/gtc/packing.hpp>

#include "image/image.hpp"
#include "shaders/gpu_data.h"
#include "systems/gpu_conversion.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

constexpr double largest = 65504.0;
constexpr double halfLeast = 6e-8;  // as in shaders/shading.glsl: a disparity is stored as no less

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

// A clear color, which the CPU rounds: the nearest half float in a single picture; in a mean, what the pictures share
// is a small part of a step, for views behind any number of mirrors.
TEST(HalfFloatTargets, ClearColorsOfAMeanAverageOut) {
  EXPECT_EQ(storedRadiance(1e9, 0, 0.0f), largest);
  EXPECT_EQ(storedRadiance(0.0, 7, halfTurn(0, 7)), 0.0f);
  for (double value = 1e-6; value < 6e4; value *= 1.37) {
    const double step = std::exp2(std::max(std::floor(std::log2(value)), -14.0) - 10.0);
    EXPECT_EQ(storedRadiance(value, 0, 0.3f), stored(value)) << value;
    for (const size_t depth : {0, 1, 2, 5, 31}) {
      double sum = 0.0;
      for (int picture = 0; picture < 64; ++picture) {
        const float rounded = storedRadiance(value, picture, halfTurn(depth, picture));
        EXPECT_EQ(stored(rounded), rounded) << "a half float";
        EXPECT_LE(std::abs(rounded - value), step);
        sum += rounded;
      }
      EXPECT_NEAR(sum / 64.0, value, 0.06 * step) << value << " behind " << depth << " mirrors";
    }
  }
}

// The eye moves sideways between two frames; what is seen at distance w moves by focal * moved / w pixels.
TEST(HalfFloatTargets, DisparityMovesPixelsByATenthAtMost) {
  constexpr double focal = 1000.0;  // pixels
  constexpr double farthest = 200.0;
  // Returns the largest error in pixels if targets store `length` / w.
  const auto worst = [&](double length) {
    double error = 0.0;
    for (double w = 1e-6; w <= 1e7; w *= 1.003) {
      const double moved = std::min(farthest * w / focal, 100.0);
      error = std::max(error, focal * moved * std::abs(stored(std::max(length / w, halfLeast)) / length - 1.0 / w));
    }
    return error;
  };
  EXPECT_LE(worst(gpu::disparityLength), 0.1);
  EXPECT_GT(worst(1.0), 1.0) << "nearer than 15 um, disparities are cut";
}

}  // namespace
}  // namespace speculum
