#include "compare/image_metrics.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <glm/gtx/component_wise.hpp>
#include <glm/gtx/norm.hpp>
#include <limits>
#include <stdexcept>

#include "compare/flip.hpp"
#include "compare/statistics.hpp"

namespace speculum {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Maps {
  Plane2d flip;
  Plane2d ssim;
};

bool nearBorder(size_t pixel, int width, int height) {
  const int x = static_cast<int>(pixel % width);
  const int y = static_cast<int>(pixel / width);
  return x < ssimBorder || y < ssimBorder || x >= width - ssimBorder || y >= height - ssimBorder;
}

// Returns the mean SSIM of the pixels, without the picture's border unless all pixels lie there.
double meanSsim(const Plane2d& map, const std::vector<size_t>& pixels) {
  double inner = 0.0;
  double all = 0.0;
  size_t innerCount = 0;
  for (const size_t i : pixels) {
    all += map.values[i];
    if (!nearBorder(i, map.width, map.height)) {
      inner += map.values[i];
      ++innerCount;
    }
  }
  return innerCount > 0 ? inner / static_cast<double>(innerCount) : all / static_cast<double>(pixels.size());
}

ImageMetrics metricsOf(const ComparedImage& reference, const ComparedImage& test, const Maps& maps,
                       const std::vector<size_t>& pixels, double tolerance) {
  ImageMetrics metrics{.pixels = static_cast<int64_t>(pixels.size())};
  double linearError = 0.0;
  double linearPower = 0.0;
  double displayError = 0.0;
  std::vector<double> differences;
  differences.reserve(pixels.size());
  for (const size_t i : pixels) {
    linearError += glm::length2(glm::dvec3(reference.linear[i]) - glm::dvec3(test.linear[i]));
    linearPower += glm::length2(glm::dvec3(reference.linear[i]));
    displayError += glm::length2((glm::dvec3(reference.display[i]) - glm::dvec3(test.display[i])) / 255.0);
    metrics.flip += maps.flip.values[i];
    differences.push_back(glm::compMax(glm::abs(reference.display[i] - test.display[i])));
    metrics.pixelsOver += differences.back() > tolerance;
  }
  const double count = static_cast<double>(pixels.size());
  metrics.rmse = std::sqrt(linearError / (3.0 * count));
  metrics.relativeRmse = linearError == 0.0   ? 0.0
                         : linearPower == 0.0 ? infinity
                                              : std::sqrt(linearError / linearPower);
  metrics.psnr = displayError == 0.0 ? infinity : -10.0 * std::log10(displayError / (3.0 * count));
  metrics.ssim = meanSsim(maps.ssim, pixels);
  metrics.flip /= count;
  metrics.maxDiff = *std::ranges::max_element(differences);
  metrics.p99Diff = nearestRank(std::move(differences), 0.99);
  return metrics;
}

std::vector<size_t> selectedPixels(size_t count, const PixelMask* mask) {
  std::vector<size_t> pixels;
  pixels.reserve(count);
  for (size_t i = 0; i < count; ++i) {
    if (mask == nullptr || mask->selected[i]) {
      pixels.push_back(i);
    }
  }
  return pixels;
}

std::string tableLine(const std::string& label, const std::string& whole, const std::string& masked) {
  std::string line = fmt::format("{:<22} {:>14} {:>14}", label, whole, masked);
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

constexpr double sigma = 1.5;
constexpr double c1 = 0.01 * 0.01;
constexpr double c2 = 0.03 * 0.03;

Plane2d channelOf(const ComparedImage& image, int channel) {
  Plane2d plane(image.width, image.height);
  for (size_t i = 0; i < plane.values.size(); ++i) {
    plane.values[i] = image.display[i][channel] / 255.0;
  }
  return plane;
}

Plane2d localMean(const Plane2d& a, const Plane2d& b) {
  Plane2d product(a.width, a.height);
  for (size_t i = 0; i < product.values.size(); ++i) {
    product.values[i] = a.values[i] * b.values[i];
  }
  return filterSeparable(product, gaussianKernel(sigma, ssimBorder), Border::reflect);
}

void addChannel(const Plane2d& a, const Plane2d& b, Plane2d& sum) {
  const auto kernel = gaussianKernel(sigma, ssimBorder);
  const Plane2d meanA = filterSeparable(a, kernel, Border::reflect);
  const Plane2d meanB = filterSeparable(b, kernel, Border::reflect);
  const Plane2d meanAA = localMean(a, a);
  const Plane2d meanBB = localMean(b, b);
  const Plane2d meanAB = localMean(a, b);
  for (size_t i = 0; i < sum.values.size(); ++i) {
    const double ma = meanA.values[i];
    const double mb = meanB.values[i];
    const double varianceA = meanAA.values[i] - ma * ma;
    const double varianceB = meanBB.values[i] - mb * mb;
    const double covariance = meanAB.values[i] - ma * mb;
    sum.values[i] += (2.0 * ma * mb + c1) * (2.0 * covariance + c2) /
                     ((ma * ma + mb * mb + c1) * (varianceA + varianceB + c2)) / 3.0;
  }
}

}  // namespace

Comparison compareImages(const ComparedImage& reference, const ComparedImage& test, const CompareOptions& options) {
  requireSameSize(reference, test);
  const PixelMask* mask = options.mask;
  if (mask != nullptr && (mask->width != reference.width || mask->height != reference.height)) {
    throw std::runtime_error(fmt::format("the mask is {}x{}, but {} is {}x{} (both must have the same size)",
                                         mask->width, mask->height, reference.name, reference.width, reference.height));
  }
  Maps maps{flipMap(reference, test, options.perceived), ssimMap(reference, test)};
  const size_t count = reference.display.size();
  Comparison result;
  result.whole = metricsOf(reference, test, maps, selectedPixels(count, nullptr), options.tolerance);
  if (mask != nullptr) {
    const std::vector<size_t> pixels = selectedPixels(count, mask);
    if (!pixels.empty()) {
      result.masked = metricsOf(reference, test, maps, pixels, options.tolerance);
    }
  }
  result.flip = std::move(maps.flip);
  return result;
}

std::string comparisonTable(const Comparison& comparison, double tolerance) {
  const auto line = [&](const std::string& label, const char* format, auto figure) {
    const auto cell = [&](const ImageMetrics& metrics) { return fmt::format(fmt::runtime(format), metrics.*figure); };
    return tableLine(label, cell(comparison.whole), comparison.masked ? cell(*comparison.masked) : "");
  };
  using M = ImageMetrics;
  return tableLine("", "whole", comparison.masked ? "mask" : "") + line("pixels", "{}", &M::pixels) +
         line("RMSE (linear)", "{:.6f}", &M::rmse) + line("relative RMSE", "{:.6f}", &M::relativeRmse) +
         line("PSNR (dB)", "{:.3f}", &M::psnr) + line("SSIM", "{:.6f}", &M::ssim) + line("FLIP", "{:.6f}", &M::flip) +
         line("largest (1/255)", "{:.4g}", &M::maxDiff) + line("99th perc. (1/255)", "{:.4g}", &M::p99Diff) +
         line(fmt::format("pixels over {:g}/255", tolerance), "{}", &M::pixelsOver);
}

Plane2d ssimMap(const ComparedImage& reference, const ComparedImage& test) {
  requireSameSize(reference, test);
  Plane2d sum(reference.width, reference.height);
  for (int c = 0; c < 3; ++c) {
    addChannel(channelOf(reference, c), channelOf(test, c), sum);
  }
  return sum;
}

}  // namespace speculum
