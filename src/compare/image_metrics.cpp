#include "compare/image_metrics.hpp"

#include <spdlog/fmt/fmt.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/gtx/component_wise.hpp>
#include <glm/gtx/norm.hpp>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "image/image.hpp"

namespace speculum {

namespace {

using Channels = std::array<Plane2d, 3>;

double quantile(const std::vector<double>& sorted, double part) {
  const double place = part * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<size_t>(std::floor(place));
  const size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

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

constexpr double pi = std::numbers::pi;
constexpr double largestColorError = 41.2761;  // between green and blue, after the exponent
constexpr double colorExponent = 0.7;
constexpr double colorKnee = 0.4;        // pc: up to this part of the range ...
constexpr double colorKneeError = 0.95;  // pt: ... errors take this part of [0, 1]
constexpr double featureExponent = 0.5;
constexpr double featureWidth = 0.082;  // degrees

const glm::dvec3 white(0.950428545, 1.0, 1.088900371);

// Linear sRGB primaries, D65. The constructor takes columns.
const glm::dmat3 xyzFromRgb(10135552.0 / 24577794.0, 2613072.0 / 12288897.0, 1425312.0 / 73733382.0,  //
                            8788810.0 / 24577794.0, 8788810.0 / 12288897.0, 8788810.0 / 73733382.0,   //
                            4435075.0 / 24577794.0, 887015.0 / 12288897.0, 70074185.0 / 73733382.0);
const glm::dmat3 rgbFromXyz = glm::inverse(xyzFromRgb);

template <typename Function>
void forEachPixel(int width, int height, Function&& function) {
  tbb::parallel_for(0, height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      function(static_cast<size_t>(y) * width + x);
    }
  });
}

glm::dvec3 opponentFromXyz(const glm::dvec3& xyz) {
  const glm::dvec3 r = xyz / white;
  return {116.0 * r.y - 16.0, 500.0 * (r.x - r.y), 200.0 * (r.y - r.z)};
}

glm::dvec3 xyzFromOpponent(const glm::dvec3& opponent) {
  const double y = (opponent.x + 16.0) / 116.0;
  return white * glm::dvec3(y + opponent.y / 500.0, y, y - opponent.z / 200.0);
}

double labCurve(double t) {
  constexpr double delta = 6.0 / 29.0;
  return t > delta * delta * delta ? std::cbrt(t) : t / (3.0 * delta * delta) + 4.0 / 29.0;
}

// Returns CIELAB with color channels weighted by lightness (Hunt's effect).
glm::dvec3 huntLab(const glm::dvec3& rgb) {
  const glm::dvec3 r = xyzFromRgb * rgb / white;
  const glm::dvec3 f(labCurve(r.x), labCurve(r.y), labCurve(r.z));
  const double lightness = 116.0 * f.y - 16.0;
  return {lightness, 0.01 * lightness * 500.0 * (f.x - f.y), 0.01 * lightness * 200.0 * (f.y - f.z)};
}

Channels opponentChannels(const ComparedImage& image) {
  Channels channels;
  channels.fill(Plane2d(image.width, image.height));
  forEachPixel(image.width, image.height, [&](size_t i) {
    glm::dvec3 rgb;
    for (int c = 0; c < 3; ++c) {
      rgb[c] = srgbDecode(image.display[i][c] / 255.0);
    }
    const glm::dvec3 opponent = opponentFromXyz(xyzFromRgb * rgb);
    for (int c = 0; c < 3; ++c) {
      channels[c].values[i] = opponent[c];
    }
  });
  return channels;
}

// Term of a contrast sensitivity function: a sqrt(pi / b) exp(-pi^2 d^2 / b) with d in degrees, a Gaussian in space and
// in frequency.
struct ContrastTerm {
  double a;
  double b;

  double sigma() const { return std::sqrt(b / (2.0 * pi * pi)) * flipPixelsPerDegree; }  // pixels
};

// Returns the two-dimensional sum of a term's samples: its share in the mix of a channel's terms.
double termWeight(const ContrastTerm& term, int radius) {
  double sum = 0.0;
  for (int x = -radius; x <= radius; ++x) {
    sum += std::exp(-0.5 * x * x / (term.sigma() * term.sigma()));
  }
  return term.a * std::sqrt(pi / term.b) * sum * sum;
}

Plane2d contrastFiltered(const Plane2d& plane, const ContrastTerm& first, const ContrastTerm& second) {
  const int radius = static_cast<int>(std::ceil(3.0 * ContrastTerm{1.0, 0.04}.sigma()));
  Plane2d result = filterSeparable(plane, gaussianKernel(first.sigma(), radius), Border::replicate);
  if (second.a == 0.0) {
    return result;
  }
  const Plane2d wide = filterSeparable(plane, gaussianKernel(second.sigma(), radius), Border::replicate);
  const double weight1 = termWeight(first, radius);
  const double weight2 = termWeight(second, radius);
  for (size_t i = 0; i < result.values.size(); ++i) {
    result.values[i] = (weight1 * result.values[i] + weight2 * wide.values[i]) / (weight1 + weight2);
  }
  return result;
}

// Filters the picture to the detail that the eye resolves. Returns weighted CIELAB.
std::vector<glm::dvec3> perceivedColors(const Channels& channels) {
  const Plane2d achromatic = contrastFiltered(channels[0], {1.0, 0.0047}, {0.0, 1e-5});
  const Plane2d redGreen = contrastFiltered(channels[1], {1.0, 0.0053}, {0.0, 1e-5});
  const Plane2d blueYellow = contrastFiltered(channels[2], {34.1, 0.04}, {13.5, 0.025});
  std::vector<glm::dvec3> colors(achromatic.values.size());
  forEachPixel(achromatic.width, achromatic.height, [&](size_t i) {
    const glm::dvec3 opponent(achromatic.values[i], redGreen.values[i], blueYellow.values[i]);
    const glm::dvec3 rgb = rgbFromXyz * xyzFromOpponent(opponent);
    colors[i] = huntLab(glm::clamp(rgb, 0.0, 1.0));
  });
  return colors;
}

// Returns the error, 0 to 1, of colors that differ by `d`. Changes of errors may differ by more than colors do: 1.
double colorError(const glm::dvec3& d) {
  const double hyab = std::abs(d.x) + std::hypot(d.y, d.z);
  const double error = std::pow(hyab, colorExponent);
  constexpr double knee = colorKnee * largestColorError;
  return error < knee
             ? error * colorKneeError / knee
             : std::min(colorKneeError + (error - knee) / (largestColorError - knee) * (1.0 - colorKneeError), 1.0);
}

// Scales positive and negative weights each to a sum of 1.
std::vector<double> balanced(std::vector<double> kernel) {
  double positive = 0.0;
  double negative = 0.0;
  for (const double w : kernel) {
    (w > 0.0 ? positive : negative) += std::abs(w);
  }
  for (double& w : kernel) {
    w /= w > 0.0 ? positive : negative;
  }
  return kernel;
}

struct Features {
  Plane2d edges;   // length of the gradient
  Plane2d points;  // length of the second derivatives
};

Plane2d lengths(const Plane2d& a, const Plane2d& b) {
  Plane2d result(a.width, a.height);
  forEachPixel(a.width, a.height, [&](size_t i) { result.values[i] = std::hypot(a.values[i], b.values[i]); });
  return result;
}

Features featuresOf(Plane2d luminance) {
  for (double& v : luminance.values) {
    v = (v + 16.0) / 116.0;
  }
  const double sigma = 0.5 * featureWidth * flipPixelsPerDegree;
  const int radius = static_cast<int>(std::ceil(3.0 * sigma));
  const std::vector<double> smooth = gaussianKernel(sigma, radius);
  std::vector<double> first;
  std::vector<double> second;
  for (int x = -radius; x <= radius; ++x) {
    first.push_back(-x * smooth[x + radius]);
    second.push_back((x * x / (sigma * sigma) - 1.0) * smooth[x + radius]);
  }
  first = balanced(first);
  second = balanced(second);
  constexpr Border border = Border::replicate;
  const Plane2d smoothRows = filterRows(luminance, smooth, border);
  return {lengths(filterColumns(filterRows(luminance, first, border), smooth, border),
                  filterColumns(smoothRows, first, border)),
          lengths(filterColumns(filterRows(luminance, second, border), smooth, border),
                  filterColumns(smoothRows, second, border))};
}

// Returns the structural similarity of every pixel, mean over RGB, on display values with data range 1: Wang, Bovik,
// Sheikh, Simoncelli, "Image Quality Assessment: From Error Visibility to Structural Similarity" (2004), Gaussian
// window with sigma 1.5 and 11 taps, population covariance, K1 = 0.01, K2 = 0.03. Sizes must be equal.
Plane2d ssimMap(const ComparedImage& reference, const ComparedImage& test) {
  requireSameSize(reference, test);
  Plane2d sum(reference.width, reference.height);
  for (int c = 0; c < 3; ++c) {
    addChannel(channelOf(reference, c), channelOf(test, c), sum);
  }
  return sum;
}

}  // namespace

Spread spreadOf(std::vector<double> values) {
  if (values.empty()) {
    return {};
  }
  std::ranges::sort(values);
  return {.median = quantile(values, 0.5),
          .minimum = values.front(),
          .lowerQuartile = quantile(values, 0.25),
          .upperQuartile = quantile(values, 0.75),
          .repeats = static_cast<int>(values.size())};
}

double nearestRank(std::vector<double> values, double part) {
  const double rank = std::max(std::ceil(part * static_cast<double>(values.size())), 1.0);
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(rank) - 1;
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

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

Plane2d flipMap(const ComparedImage& reference, const ComparedImage& test, std::vector<glm::dvec3>* perceived) {
  requireSameSize(reference, test);
  const Channels referenceChannels = opponentChannels(reference);
  const Channels testChannels = opponentChannels(test);
  const std::vector<glm::dvec3> referenceColors = perceivedColors(referenceChannels);
  const std::vector<glm::dvec3> testColors = perceivedColors(testChannels);
  const Features a = featuresOf(referenceChannels[0]);
  const Features b = featuresOf(testChannels[0]);
  Plane2d error(reference.width, reference.height);
  if (perceived != nullptr) {
    perceived->resize(error.values.size());
  }
  forEachPixel(error.width, error.height, [&](size_t i) {
    const double edge = std::abs(a.edges.values[i] - b.edges.values[i]);
    const double point = std::abs(a.points.values[i] - b.points.values[i]);
    const double feature = std::pow(std::max(edge, point) / std::numbers::sqrt2, featureExponent);
    const glm::dvec3 difference = testColors[i] - referenceColors[i];
    error.values[i] = std::pow(colorError(difference), 1.0 - std::min(feature, 1.0));
    if (perceived != nullptr) {
      (*perceived)[i] = difference;
    }
  });
  return error;
}

double flickerOf(std::span<const glm::dvec3> before, std::span<const glm::dvec3> now) {
  const auto change = [](const glm::dvec3& a, const glm::dvec3& b) { return colorError(b - a); };
  return std::transform_reduce(before.begin(), before.end(), now.begin(), 0.0, std::plus(), change) /
         static_cast<double>(now.size());
}

}  // namespace speculum
