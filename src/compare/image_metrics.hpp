#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compare/compared_image.hpp"

namespace speculum {

// Repeated measurements of one quantity, in the unit of the values.
struct Spread {
  double median = 0.0;
  double minimum = 0.0;
  double lowerQuartile = 0.0;
  double upperQuartile = 0.0;
  int repeats = 0;
};

// Returns median, minimum and quartiles by linear interpolation between order statistics (type 7 of Hyndman and Fan,
// "Sample Quantiles in Statistical Packages", 1996). All zero without values.
Spread spreadOf(std::vector<double> values);

// Returns the least value that `part` of the values, of which there is one at least, do not exceed (nearest rank).
double nearestRank(std::vector<double> values, double part);

struct ImageMetrics {
  double rmse = 0.0;          // root mean square over pixels and channels, linear [0, 1]
  double relativeRmse = 0.0;  // rmse / root mean square of the reference; infinite if only the reference is black
  double psnr = 0.0;          // dB, display sRGB [0, 1]; infinite for equal pictures
  double ssim = 0.0;          // mean structural similarity, without a border of ssimBorder pixels
  double flip = 0.0;          // mean of flipMap()
  double maxDiff = 0.0;       // 1/255, of the channel that differs most
  double p99Diff = 0.0;       // 1/255; 99 % of the pixels differ by no more (nearest rank)
  int64_t pixelsOver = 0;     // pixels that differ by more than the tolerance in any channel
  int64_t pixels = 0;         // pixels compared
};

struct ErrorFigures {
  ImageMetrics whole;
  std::optional<ImageMetrics> mirrors;  // over the inside of mirrors, if any is in view
  std::optional<double> flicker;        // of a movement: mean flickerOf() its frames
};

struct Comparison {
  ImageMetrics whole;
  std::optional<ImageMetrics> masked;  // nothing without a mask or with one that selects no pixel
  Plane2d flip;                        // flipMap() of the whole picture, for a heat map
};

struct CompareOptions {
  double tolerance = 2.0;                        // 1/255
  const PixelMask* mask = nullptr;               // for Comparison::masked; maps always cover the whole picture
  std::vector<glm::dvec3>* perceived = nullptr;  // as for flipMap()
};

// Compares two pictures. Throws std::runtime_error when sizes differ or a picture has no pixels.
Comparison compareImages(const ComparedImage& reference, const ComparedImage& test, const CompareOptions& options = {});

// Returns a table for the terminal: a line per metric, a column for the whole picture and one for the mask.
std::string comparisonTable(const Comparison& comparison, double tolerance);

// Width in pixels of the border where windows reach beyond the picture; the border does not count in the mean.
constexpr int ssimBorder = 5;

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
