#include "geometry/texture.hpp"

#include <algorithm>

namespace speculum {

namespace {

// Part of a row or column that a texel of a smaller picture covers.
struct Share {
  int index;
  float weight;
};

std::vector<Share> sharesOf(int texel, int count, int size) {
  const double from = static_cast<double>(texel) * size / count;
  const double to = static_cast<double>(texel + 1) * size / count;
  std::vector<Share> shares;
  for (int i = static_cast<int>(from); i < size && i < to; ++i) {
    const double covered = std::min(to, i + 1.0) - std::max<double>(from, i);
    shares.push_back({i, static_cast<float>(covered / (to - from))});
  }
  return shares;
}

}  // namespace

Texture shrunk(const Texture& texture, int width, int height) {
  Texture small{.source = texture.source, .width = width, .height = height};
  for (int y = 0; y < small.height; ++y) {
    for (int x = 0; x < small.width; ++x) {
      glm::vec3 sum(0.0f);
      for (const Share& row : sharesOf(y, small.height, texture.height)) {
        for (const Share& column : sharesOf(x, small.width, texture.width)) {
          sum += row.weight * column.weight *
                 texture.texels[static_cast<size_t>(row.index) * static_cast<size_t>(texture.width) +
                                static_cast<size_t>(column.index)];
        }
      }
      small.texels.push_back(sum);
    }
  }
  return small;
}

}  // namespace speculum
