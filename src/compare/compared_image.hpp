#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "image/image.hpp"

namespace speculum {

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
