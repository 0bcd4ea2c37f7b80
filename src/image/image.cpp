#include "image/image.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace speculum {

namespace {

// The two texels about a position along one axis, and the weight of the second. Beyond the border its texels repeat.
struct Taps {
  int first = 0;
  int second = 0;
  float weight = 0.0f;
};

Taps tapsAt(int pixel, int pixels, int texels) {
  const double position = (pixel + 0.5) * texels / pixels - 0.5;
  const int texel = static_cast<int>(std::floor(position));
  return {std::clamp(texel, 0, texels - 1), std::clamp(texel + 1, 0, texels - 1),
          static_cast<float>(position - std::floor(position))};
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
      const glm::vec3& a = image.at(columns.first, rows.first);
      const glm::vec3& b = image.at(columns.second, rows.first);
      const glm::vec3& c = image.at(columns.first, rows.second);
      const glm::vec3& d = image.at(columns.second, rows.second);
      const glm::vec3 mean = glm::mix(glm::mix(a, b, columns.weight), glm::mix(c, d, columns.weight), rows.weight);
      // Rounding must not leave the range of the four texels.
      large.at(x, y) =
          glm::clamp(mean, glm::min(glm::min(a, b), glm::min(c, d)), glm::max(glm::max(a, b), glm::max(c, d)));
    }
  }
  return large;
}

std::optional<PictureSize> pictureSize(std::string_view text) {
  constexpr int largestSide = 16384;
  PictureSize size;
  const char* end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, size.width);
  const bool cross = width.ec == std::errc() && width.ptr != end && *width.ptr == 'x';
  const auto height = cross ? std::from_chars(width.ptr + 1, end, size.height) : width;
  if (!cross || height.ec != std::errc() || height.ptr != end || size.width < 1 || size.height < 1 ||
      size.width > largestSide || size.height > largestSide) {
    return std::nullopt;
  }
  return size;
}

}  // namespace speculum
