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

}  // namespace speculum
