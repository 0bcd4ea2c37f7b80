#include <gtest/gtest.h>

#include <algorithm>

#include "frame/picture_tiles.hpp"

namespace speculum {
namespace {

TEST(PictureTiles, RectanglesCoverAnImageOnce) {
  for (const auto& [width, height] : {std::pair(1, 1), std::pair(64, 64), std::pair(200, 130), std::pair(65, 300)}) {
    const size_t count = static_cast<size_t>((width + 63) / 64 * ((height + 63) / 64));
    for (size_t step = 1; step <= count; ++step) {
      std::vector<int> covered(static_cast<size_t>(width * height), 0);
      for (size_t first = 0; first < count; first += step) {
        for (const PixelRect& rect : tileRects(width, height, {first, std::min(first + step, count)})) {
          EXPECT_EQ(rect.x % tileSide, 0);
          EXPECT_EQ(rect.y % tileSide, 0);
          for (int i = 0; i < rect.width * rect.height; ++i) {
            const int x = rect.x + i % rect.width;
            const int y = rect.y + i / rect.width;
            ASSERT_TRUE(x < width && y < height);
            ++covered[static_cast<size_t>(y * width + x)];
          }
        }
      }
      EXPECT_EQ(std::ranges::count(covered, 1), width * height) << width << "x" << height << " by " << step;
    }
    EXPECT_EQ(tileRects(width, height, {0, count}).size(), 1u);
  }
}

TEST(PictureTiles, PassesFollowEachOther) {
  FramePlan plan;
  plan.passes.resize(2);
  plan.passes[0].view.rect = {10, 10, 65, 64};
  plan.passes[1].view.rect = {0, 0, 10, 10};
  plan.main.view.rect = {0, 0, 128, 128};
  EXPECT_EQ(tileCount(plan), 2u + 1u + 4u);
  EXPECT_EQ(tilesOfPasses(plan), (std::vector<TileRange>{{0, 2}, {0, 1}, {0, 4}})) << "all";
  EXPECT_TRUE(beginsPicture(plan) && endsPicture(plan));
  plan.tiles = {1, 5};
  EXPECT_EQ(tilesOfPasses(plan), (std::vector<TileRange>{{1, 2}, {0, 1}, {0, 2}}));
  EXPECT_FALSE(beginsPicture(plan) || endsPicture(plan));
  plan.tiles = {5, 7};
  EXPECT_TRUE(tilesOfPasses(plan)[0].empty());
  EXPECT_TRUE(endsPicture(plan));
}

}  // namespace
}  // namespace speculum
