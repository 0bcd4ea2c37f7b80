#include "compare/compared_image.hpp"

#include <spdlog/fmt/fmt.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "image/picture_files.hpp"
#include "platform/text.hpp"

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

bool isLinearFile(const std::filesystem::path& file) {
  return lowerCase(file.extension().string()) == ".exr";
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

ComparedImage comparedImage(const Image8& image, std::string name) {
  ComparedImage result{std::move(name), image.width, image.height};
  const size_t count = static_cast<size_t>(image.width) * image.height;
  result.linear.resize(count);
  result.display.resize(count);
  for (size_t i = 0; i < count; ++i) {
    for (int c = 0; c < 3; ++c) {
      const uint8_t code = image.rgba[i * 4 + c];
      result.linear[i][c] = srgbDecoded()[code];
      result.display[i][c] = code;
    }
  }
  return result;
}

ComparedImage comparedImage(const LinearImage& image, std::string name) {
  ComparedImage result{std::move(name), image.width, image.height};
  result.linear.resize(image.pixels.size());
  result.display.resize(image.pixels.size());
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const float value = image.pixels[i][c];
      if (std::isnan(value)) {
        const int width = std::max(image.width, 1);
        throw std::runtime_error(fmt::format("{}: pixel ({}, {}) is not a number (every channel must be one)",
                                             result.name, i % width, i / width));
      }
      result.linear[i][c] = std::clamp(value, 0.0f, 1.0f);
      result.display[i][c] = static_cast<float>(255.0 * srgbEncode(result.linear[i][c]));
    }
  }
  return result;
}

ComparedImage readComparedImage(const std::filesystem::path& file) {
  return isLinearFile(file) ? comparedImage(readExr(file), file.string())
                            : comparedImage(readImage8(file), file.string());
}

PixelMask readPixelMask(const std::filesystem::path& file) {
  const Image8 image = readImage8(file);
  PixelMask mask{image.width, image.height};
  for (size_t i = 0; i < image.rgba.size(); i += 4) {
    mask.selected.push_back(image.rgba[i] >= 128);
  }
  return mask;
}

PixelMask readNonEmptyMask(const std::filesystem::path& file) {
  PixelMask mask = readPixelMask(file);
  if (std::ranges::none_of(mask.selected, [](auto selected) { return selected != 0; })) {
    throw std::runtime_error(file.string() + ": the mask leaves out every pixel (pixels of at least 128 count)");
  }
  return mask;
}

void requireSameSize(const ComparedImage& a, const ComparedImage& b) {
  if (a.width != b.width || a.height != b.height) {
    throw std::runtime_error(fmt::format("{}: is {}x{}, but {} is {}x{} (both must have the same size)", b.name,
                                         b.width, b.height, a.name, a.width, a.height));
  }
  if (a.width < 1 || a.height < 1) {
    throw std::runtime_error(a.name + ": has no pixels");
  }
}

}  // namespace speculum
