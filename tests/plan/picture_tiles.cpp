#include "plan/pass_mask.hpp"
#include "plan_by_hand.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

TEST(PictureTiles, RectanglesCoverAnImageOnce) {
  for (const auto& [width, height] : {std::pair(1, 1), std::pair(64, 64), std::pair(50, 33), std::pair(17, 75)}) {
    const auto along = [](int texels) { return (texels + tileSide - 1) / tileSide; };
    const auto count = static_cast<size_t>(along(width) * along(height));
    for (size_t step = 1; step <= count; ++step) {
      std::vector<bool> covered(static_cast<size_t>(width * height));
      for (size_t first = 0; first < count; first += step) {
        for (const PixelRect& rect : tileRects(width, height, {first, std::min(first + step, count)})) {
          EXPECT_EQ(rect.x % tileSide, 0);
          EXPECT_EQ(rect.y % tileSide, 0);
          ASSERT_TRUE(rect.x + rect.width <= width && rect.y + rect.height <= height);
          for (int i = 0; i < rect.width * rect.height; ++i) {
            const int x = rect.x + i % rect.width;
            const int y = rect.y + i / rect.width;
            const auto pixel = static_cast<size_t>(y * width + x);
            EXPECT_FALSE(covered[pixel]);
            EXPECT_TRUE(x == 0 || x > rect.x || !covered[pixel - 1]) << "what lies to the left is drawn later";
            EXPECT_TRUE(y == 0 || y > rect.y || !covered[pixel - static_cast<size_t>(width)]) << "and above";
            covered[pixel] = true;
          }
        }
      }
      EXPECT_EQ(std::ranges::count(covered, true), width * height) << width << "x" << height << " by " << step;
    }
    EXPECT_EQ(tileRects(width, height, {0, count}).size(), 1u);
  }
}

TEST(PictureTiles, SubmissionsWithRaysAreBounded) {
  FramePlan plan;
  Settings settings;
  size_t raysToLights = 3;
  const auto tiles = [&] { return tilesAtOnce(plan, settings, raysToLights); };
  EXPECT_EQ(tiles(), SIZE_MAX) << "no rays";
  plan.effects.shadowRays = true;
  const size_t most = (1 << 27) / (tileSide * tileSide);
  EXPECT_EQ(tiles(), most / 4);
  settings.effects.perSample = true;
  settings.view.samples = 4;
  EXPECT_EQ(tiles(), most / 16);
  settings.effects.perSample = false;
  raysToLights = 1023;
  EXPECT_EQ(tiles(), most / 1024);
  raysToLights = 1;
  plan.effects.roughRays = true;
  settings.effects.roughSamples = 1;
  settings.view.samples = 16;
  EXPECT_EQ(tiles(), most / 32 / 4) << "a ray at each sample and bounce";
  settings.reflection.maxDepth = 32;
  EXPECT_EQ(tiles(), most / 32 / 32);
  settings.view.samples = 4;
  settings.effects.roughSamples = 1 << 20;
  EXPECT_EQ(tiles(), 1u);
}

TEST(PictureTiles, FacesCountAsTiles) {
  const auto tilesOfSquare = [](int side) { return tilesIn({0, 0, side, side}); };
  EXPECT_EQ(tilesOfSquare(1), 1u);
  EXPECT_EQ(tilesOfSquare(2 * tileSide), 4u);
  EXPECT_EQ(tilesOfSquare(2 * tileSide + 1), 9u);
}

TEST(PictureTiles, PassesFollowEachOther) {
  FramePlan plan;
  testing_support::addMirror(plan, {0}).view.rect = {10, 10, tileSide + 1, tileSide};
  testing_support::addMirror(plan, {1}).view.rect = {0, 0, 10, 10};
  plan.main().view.rect = {0, 0, 2 * tileSide, 2 * tileSide};
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

TEST(PictureTiles, FacesOfMapsComeFirst) {
  FramePlan plan;
  plan.main().view.rect = {0, 0, 2 * tileSide, tileSide};
  const Pass shadow{.id = {.kind = PassKind::shadow}};
  plan.passes.insert(plan.passes.begin(), {shadow, shadow, shadow, {.id = {.kind = PassKind::environment}}});
  plan.passes[0].isLayer = true;
  plan.passes[1].layer = 0;
  plan.passes[2].source = PassSource::reused;
  EXPECT_EQ(faceCount(plan), 2u) << "without layers and those that are reused";
  EXPECT_EQ(tileCount(plan), 2u + 2u);
  EXPECT_TRUE(beginsPicture(plan) && endsFaces(plan) && endsPicture(plan));
  const TileRange none;
  plan.tiles = {0, 1};
  EXPECT_EQ(tilesOfPasses(plan), (std::vector<TileRange>{none, {0, 1}, none, none, none}));
  EXPECT_FALSE(endsFaces(plan));
  plan.tiles = {1, 3};
  EXPECT_EQ(tilesOfPasses(plan), (std::vector<TileRange>{none, {1, 1}, none, {0, 1}, {0, 1}}));
  EXPECT_TRUE(endsFaces(plan) && !endsPicture(plan));
  plan.tiles = {3, 4};
  EXPECT_EQ(tilesOfPasses(plan).back(), (TileRange{1, 2}));
  EXPECT_TRUE(endsPicture(plan) && !endsFaces(plan)) << "they ended before";
}

}  // namespace
}  // namespace speculum
