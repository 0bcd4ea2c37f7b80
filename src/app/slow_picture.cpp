#include "app/slow_picture.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace speculum {

namespace {

constexpr double caution = 4.0;  // a tile that was never drawn may take that much longer than expected

}  // namespace

void SlowPicture::begin(size_t faces, size_t count, double ms) {
  tiles_ = {};
  faces_ = faces;
  faceMs_ = std::numeric_limits<double>::infinity();
  totalMs_ = 0.0;
  const std::vector<double> before = std::exchange(tileMs_, std::vector<double>(count));
  if (before.empty()) {
    std::ranges::fill(tileMs_, caution * ms / std::max(static_cast<double>(count), 1.0));
    return;
  }
  // The offset of another picture may move a mirror image's border over a tile's, which changes the number of tiles.
  for (size_t i = 0; i < count; ++i) {
    tileMs_[i] = before[i * before.size() / count];
  }
  measured_ = measured_ * count / before.size();
}

TileRange SlowPicture::next(double ms) {
  tiles_ = {tiles_.end, tiles_.end + 1};
  const bool faces = tiles_.first < faces_;
  const auto expected = [&](size_t tile) { return faces ? faceMs_ : tileMs_[tile - faces_]; };
  const size_t end = faces ? faces_ : faces_ + tileMs_.size();
  for (double sum = expected(tiles_.first); tiles_.end < end; ++tiles_.end) {
    sum += expected(tiles_.end);
    if (sum > ms) {
      break;
    }
  }
  return tiles_;
}

void SlowPicture::took(double ms) {
  totalMs_ += ms;
  const double tileMs = ms / static_cast<double>(tiles_.end - tiles_.first);
  if (tiles_.first < faces_) {
    faceMs_ = tileMs;
    return;
  }
  std::fill(tileMs_.data() + tiles_.first - faces_, tileMs_.data() + tiles_.end - faces_, tileMs);
  measured_ = std::max(measured_, tiles_.end - faces_);
  dearestMs_ = std::max(dearestMs_, tileMs);
  std::fill(tileMs_.data() + measured_, tileMs_.data() + tileMs_.size(), std::max(tileMs, dearestMs_ / caution));
}

}  // namespace speculum
