#pragma once

#include <string>

#include "image/image.hpp"

namespace speculum::testing_support {

// Returns a picture of color(x, y), whose four channels wrap around at 256.
template <typename Color>
Image8 madePicture(int width, int height, const Color& color) {
  Image8 image(width, height);
  for (int i = 0; i < width * height; ++i) {
    const glm::ivec4 made = color(i % width, i / width);
    for (int channel = 0; channel < 4; ++channel) {
      image.rgba[static_cast<size_t>(4 * i + channel)] = static_cast<uint8_t>(made[channel]);
    }
  }
  return image;
}

// Returns a TGA file without compression, of 24 or 32 bits a pixel, whose header says how many of these are alpha.
inline std::string tgaFile(const Image8& image, int bits, int alphaBits) {
  const auto byte = [](int value) { return static_cast<char>(value); };
  std::string file("\0\0\2\0\0\0\0\0\0\0\0\0", 12);
  file += {byte(image.width % 256), byte(image.width / 256), byte(image.height % 256), byte(image.height / 256)};
  file += {byte(bits), byte(0x20 | alphaBits)};  // the first row at the top
  for (size_t i = 0; i < image.rgba.size(); i += 4) {
    file += {byte(image.rgba[i + 2]), byte(image.rgba[i + 1]), byte(image.rgba[i])};
    file += bits == 32 ? std::string(1, byte(image.rgba[i + 3])) : "";
  }
  return file;
}

// An opaque picture of one grey.
inline Image8 greyPicture(int width, int height, int grey) {
  return madePicture(width, height, [&](int, int) { return glm::ivec4(grey, grey, grey, 255); });
}

}  // namespace speculum::testing_support
