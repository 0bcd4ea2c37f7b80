#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace speculum {

// Linear RGB radiance, row 0 at the top.
struct LinearImage {
  int width = 0;
  int height = 0;
  std::vector<glm::vec3> pixels;

  LinearImage() = default;
  LinearImage(int w, int h) : width(w), height(h), pixels(static_cast<size_t>(w) * h) {}
  glm::vec3& at(int x, int y) { return pixels[static_cast<size_t>(y) * width + x]; }
  const glm::vec3& at(int x, int y) const { return pixels[static_cast<size_t>(y) * width + x]; }
};

// Display-referred sRGB, 8 bits a channel, RGBA interleaved, row 0 at the top.
struct Image8 {
  int width = 0;
  int height = 0;
  std::vector<uint8_t> rgba;

  Image8() = default;
  Image8(int w, int h) : width(w), height(h), rgba(static_cast<size_t>(w) * h * 4, 255) {}
  uint8_t* at(int x, int y) { return &rgba[(static_cast<size_t>(y) * width + x) * 4]; }
  const uint8_t* at(int x, int y) const { return &rgba[(static_cast<size_t>(y) * width + x) * 4]; }
};

enum class ToneMap { clamp, aces };

// IEC 61966-2-1. Both take and return [0, 1].
double srgbEncode(double linear);
double srgbDecode(double encoded);

// exposure, tone curve, sRGB curve, 8 bit rounded (to nearest); the shader display.frag does the same.
Image8 toDisplay(const LinearImage& image, double exposure, ToneMap toneMap);

// Baseline JPEG without alpha; quality 1 .. 100, chroma at half the resolution up to 90. Throws std::runtime_error for
// a picture without pixels, one of more than 65535 in a direction, and another quality.
std::vector<uint8_t> encodeJpeg(const Image8& image, int quality);

// All throw std::runtime_error with the file's name, what is wrong and what would be right.
Image8 readImage8(const std::filesystem::path& file);  // PNG, JPEG, of at most 2^26 pixels
void writePng(const std::filesystem::path& file, const Image8& image);
LinearImage readExr(const std::filesystem::path& file);
void writeExr(const std::filesystem::path& file, const LinearImage& image);  // float RGB

}  // namespace speculum
