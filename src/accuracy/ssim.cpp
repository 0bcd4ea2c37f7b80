#include "accuracy/ssim.hpp"

namespace speculum {

namespace {

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

Plane2d ssimMap(const ComparedImage& reference, const ComparedImage& test) {
  requireSameSize(reference, test);
  Plane2d sum(reference.width, reference.height);
  for (int c = 0; c < 3; ++c) {
    addChannel(channelOf(reference, c), channelOf(test, c), sum);
  }
  return sum;
}

}  // namespace speculum
