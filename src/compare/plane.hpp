#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace speculum {

// One channel of a picture, row 0 at the top.
struct Plane2d {
  int width = 0;
  int height = 0;
  std::vector<double> values;

  Plane2d() = default;
  Plane2d(int w, int h) : width(w), height(h), values(static_cast<size_t>(w) * h) {}
  double& at(int x, int y) { return values[static_cast<size_t>(y) * width + x]; }
  double at(int x, int y) const { return values[static_cast<size_t>(y) * width + x]; }
};

// Values beyond a picture's border: its outermost pixel, or the picture mirrored with the outermost pixel repeated.
enum class Border { replicate, reflect };

// Return the correlation with an odd number of weights, along rows or along columns. Rows are computed in parallel; the
// result does not depend on the number of threads.
Plane2d filterRows(const Plane2d& plane, std::span<const double> kernel, Border border);
Plane2d filterColumns(const Plane2d& plane, std::span<const double> kernel, Border border);

inline Plane2d filterSeparable(const Plane2d& plane, std::span<const double> kernel, Border border) {
  return filterColumns(filterRows(plane, kernel, border), kernel, border);
}

// Returns exp(-x^2 / (2 sigma^2)) for x = -radius .. radius (pixels), scaled to unit sum.
std::vector<double> gaussianKernel(double sigma, int radius);

}  // namespace speculum
