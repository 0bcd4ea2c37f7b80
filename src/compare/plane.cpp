#include "compare/plane.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace speculum {

namespace {

int borderIndex(int i, int size, Border border) {
  if (border == Border::replicate) {
    return std::clamp(i, 0, size - 1);
  }
  const int period = 2 * size;
  const int wrapped = ((i % period) + period) % period;
  return wrapped < size ? wrapped : period - 1 - wrapped;
}

}  // namespace

Plane2d filterRows(const Plane2d& plane, std::span<const double> kernel, Border border) {
  Plane2d result(plane.width, plane.height);
  const int radius = static_cast<int>(kernel.size()) / 2;
  tbb::parallel_for(0, plane.height, [&](int y) {
    std::vector<double> row(static_cast<size_t>(plane.width) + 2 * radius);
    for (int x = -radius; x < plane.width + radius; ++x) {
      row[x + radius] = plane.at(borderIndex(x, plane.width, border), y);
    }
    double* out = &result.at(0, y);
    for (size_t k = 0; k < kernel.size(); ++k) {
      for (int x = 0; x < plane.width; ++x) {
        out[x] += kernel[k] * row[x + k];
      }
    }
  });
  return result;
}

Plane2d filterColumns(const Plane2d& plane, std::span<const double> kernel, Border border) {
  Plane2d result(plane.width, plane.height);
  const int radius = static_cast<int>(kernel.size()) / 2;
  tbb::parallel_for(0, plane.height, [&](int y) {
    double* out = &result.at(0, y);
    for (size_t k = 0; k < kernel.size(); ++k) {
      const int row = borderIndex(y + static_cast<int>(k) - radius, plane.height, border);
      const double* in = &plane.values[static_cast<size_t>(row) * plane.width];
      for (int x = 0; x < plane.width; ++x) {
        out[x] += kernel[k] * in[x];
      }
    }
  });
  return result;
}

std::vector<double> gaussianKernel(double sigma, int radius) {
  std::vector<double> kernel;
  for (int x = -radius; x <= radius; ++x) {
    kernel.push_back(std::exp(-0.5 * x * x / (sigma * sigma)));
  }
  const double sum = std::accumulate(kernel.begin(), kernel.end(), 0.0);
  for (double& weight : kernel) {
    weight /= sum;
  }
  return kernel;
}

}  // namespace speculum
