#include "compare/flip.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

#include "image/color.hpp"

namespace speculum {

namespace {

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

using Channels = std::array<Plane2d, 3>;

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

}  // namespace

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
