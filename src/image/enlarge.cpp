#include "image/enlarge.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace speculum {

namespace {

// Texels about a position along one axis, with their weights.
struct Taps {
  std::array<int, 4> texels;
  std::array<float, 4> weights;
};

// Catmull and Rom, "A class of local interpolating splines" (1974). Beyond the border its texels repeat.
Taps tapsAt(int pixel, int pixels, int texels) {
  const double position = (pixel + 0.5) * texels / pixels - 0.5;
  const double floor = std::floor(position);
  const double t = position - floor;
  const std::array<double, 4> weights{((-0.5 * t + 1.0) * t - 0.5) * t, (1.5 * t - 2.5) * t * t + 1.0,
                                      ((-1.5 * t + 2.0) * t + 0.5) * t, (0.5 * t - 0.5) * t * t};
  Taps taps;
  for (int i = 0; i < 4; ++i) {
    taps.texels[i] = std::clamp(static_cast<int>(floor) - 1 + i, 0, texels - 1);
    taps.weights[i] = static_cast<float>(weights[i]);
  }
  return taps;
}

}  // namespace

LinearImage enlarged(const LinearImage& image, int width, int height) {
  if (image.width == width && image.height == height) {
    return image;
  }
  LinearImage large(width, height);
  for (int y = 0; y < height; ++y) {
    const Taps rows = tapsAt(y, height, image.height);
    for (int x = 0; x < width; ++x) {
      const Taps columns = tapsAt(x, width, image.width);
      glm::vec3 sum(0.0f);
      for (int j = 0; j < 4; ++j) {
        for (int i = 0; i < 4; ++i) {
          sum += rows.weights[j] * columns.weights[i] * image.at(columns.texels[i], rows.texels[j]);
        }
      }
      const auto nearest = [&](int i, int j) { return image.at(columns.texels[i], rows.texels[j]); };
      const glm::vec3 low = glm::min(glm::min(nearest(1, 1), nearest(2, 1)), glm::min(nearest(1, 2), nearest(2, 2)));
      const glm::vec3 high = glm::max(glm::max(nearest(1, 1), nearest(2, 1)), glm::max(nearest(1, 2), nearest(2, 2)));
      large.at(x, y) = glm::clamp(sum, low, high);
    }
  }
  return large;
}

}  // namespace speculum
