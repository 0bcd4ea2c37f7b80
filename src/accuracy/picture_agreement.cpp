#include "accuracy/picture_agreement.hpp"

#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <vector>

namespace speculum {

namespace {

int largestDifference(const uint8_t* a, const uint8_t* b) {
  return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
}

bool blockOver(const std::vector<uint8_t>& over, int width, int x, int y) {
  for (int dy = 0; dy < 3; ++dy) {
    const uint8_t* row = &over[static_cast<size_t>(y + dy) * width + x];
    if (!row[0] || !row[1] || !row[2]) {
      return false;
    }
  }
  return true;
}

void findBlock(const std::vector<uint8_t>& over, int width, int height, PictureAgreement& result) {
  for (int y = 0; y + 2 < height; ++y) {
    for (int x = 0; x + 2 < width; ++x) {
      if (blockOver(over, width, x, y)) {
        result.solidBlock = true;
        result.blockX = x;
        result.blockY = y;
        return;
      }
    }
  }
}

}  // namespace

PictureAgreement pictureAgreement(const Image8& a, const Image8& b, int tolerance, std::span<const uint8_t> exclude) {
  const size_t count = static_cast<size_t>(a.width) * a.height;
  if (a.width != b.width || a.height != b.height) {
    throw std::runtime_error("pictures of " + std::to_string(a.width) + "x" + std::to_string(a.height) + " and " +
                             std::to_string(b.width) + "x" + std::to_string(b.height) + " cannot be compared");
  }
  if (!exclude.empty() && exclude.size() != count) {
    throw std::runtime_error("the mask of excluded pixels has " + std::to_string(exclude.size()) +
                             " pixels, the pictures have " + std::to_string(count));
  }
  PictureAgreement result;
  std::vector<uint8_t> over(count, 0);
  for (size_t i = 0; i < count; ++i) {
    if (!exclude.empty() && exclude[i]) {
      continue;
    }
    const int difference = largestDifference(&a.rgba[i * 4], &b.rgba[i * 4]);
    over[i] = difference > tolerance;
    result.over += over[i];
    result.largest = std::max(result.largest, difference);
    ++result.counted;
  }
  findBlock(over, a.width, a.height, result);
  return result;
}

}  // namespace speculum
