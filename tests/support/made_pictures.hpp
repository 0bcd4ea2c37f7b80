#pragma once

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

// An opaque picture of one grey.
inline Image8 greyPicture(int width, int height, int grey) {
  return madePicture(width, height, [&](int, int) { return glm::ivec4(grey, grey, grey, 255); });
}

}  // namespace speculum::testing_support
