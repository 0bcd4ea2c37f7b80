#include "image/smooth_enlargement.hpp"

#include <algorithm>
#include <cmath>

namespace speculum {

namespace {

// The filter with B = C = 1/3, `x` texels from its middle.
double mitchell(double x) {
  const double d = std::abs(x);
  return d < 1.0   ? ((7.0 * d - 12.0) * d * d + 16.0 / 3.0) / 6.0
         : d < 2.0 ? (((12.0 - 7.0 / 3.0 * d) * d - 20.0) * d + 32.0 / 3.0) / 6.0
                   : 0.0;
}

// Four texels about a position along one axis, and their weights. Beyond the border its texels repeat.
struct CubicTaps {
  std::array<int, 4> texels{};
  std::array<float, 4> weights{};
};

std::vector<CubicTaps> cubicTaps(int pixels, int texels) {
  std::vector<CubicTaps> taps;
  for (int pixel = 0; pixel < pixels; ++pixel) {
    const double position = (pixel + 0.5) * texels / pixels - 0.5;
    const int first = static_cast<int>(std::floor(position)) - 1;
    CubicTaps& at = taps.emplace_back();
    for (int i = 0; i < 4; ++i) {
      at.texels[i] = std::clamp(first + i, 0, texels - 1);
      at.weights[i] = static_cast<float>(mitchell(position - (first + i)));
    }
  }
  return taps;
}

}  // namespace

Image8 smoothlyEnlarged(const Image8& picture, int width, int height) {
  const std::vector<CubicTaps> columns = cubicTaps(width, picture.width);
  const std::vector<CubicTaps> rows = cubicTaps(height, picture.height);
  LinearImage wide(width, picture.height);  // holds codes
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int i = 0; i < 4; ++i) {
        const uint8_t* code = picture.at(columns[x].texels[i], y);
        wide.at(x, y) += columns[x].weights[i] * glm::vec3(code[0], code[1], code[2]);
      }
    }
  }
  Image8 large(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      glm::vec3 sum(0.5f);  // for rounding
      for (int i = 0; i < 4; ++i) {
        sum += rows[y].weights[i] * wide.at(x, rows[y].texels[i]);
      }
      const glm::vec3 codes = glm::clamp(sum, 0.0f, 255.0f);
      for (int channel = 0; channel < 3; ++channel) {
        large.at(x, y)[channel] = static_cast<uint8_t>(codes[channel]);
      }
    }
  }
  return large;
}

}  // namespace speculum
