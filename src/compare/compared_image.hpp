#pragma once

#include <cstddef>
#include <filesystem>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "image/image.hpp"

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

// A picture in both encodings that the metrics use, linear and display; row 0 at the top.
struct ComparedImage {
  std::string name;  // for messages
  int width = 0;
  int height = 0;
  std::vector<glm::vec3> linear;   // clamped to [0, 1]
  std::vector<glm::vec3> display;  // sRGB codes, 0 .. 255; whole numbers if the picture had 8 bits
};

ComparedImage comparedImage(const Image8& image, std::string name = "the picture");

// Encodes with exposure 1 and tone curve clamp, without rounding to 8 bits. Throws std::runtime_error that names the
// first pixel that is not a number.
ComparedImage comparedImage(const LinearImage& image, std::string name = "the picture");

// Reads a picture by its file's ending: .exr is linear, everything else 8-bit sRGB. Throws std::runtime_error with the
// file's name.
ComparedImage readComparedImage(const std::filesystem::path& file);

// Pixels whose red channel is 128 or more in a mask picture.
struct PixelMask {
  int width = 0;
  int height = 0;
  std::vector<uint8_t> selected;
};
// Reads a mask picture. Throws std::runtime_error if the file cannot be read.
PixelMask readPixelMask(const std::filesystem::path& file);
// Like readPixelMask(), but also throws if the mask selects no pixel.
PixelMask readNonEmptyMask(const std::filesystem::path& file);

// Throws std::runtime_error that names both pictures and both sizes, unless the sizes are equal and not zero.
void requireSameSize(const ComparedImage& a, const ComparedImage& b);

}  // namespace speculum
