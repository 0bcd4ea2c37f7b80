#include "compare/compared_image.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "image/color.hpp"
#include "image/picture_files.hpp"
#include "platform/text.hpp"

namespace speculum {

namespace {

bool isLinearFile(const std::filesystem::path& file) {
  return lowerCase(file.extension().string()) == ".exr";
}

}  // namespace

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
