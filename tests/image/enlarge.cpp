#include "image/image.hpp"
#include "image/smooth_enlargement.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

TEST(Enlarge, StaysWithinTheFourNearestTexels) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> side(1, 9);
  std::uniform_real_distribution<float> exponent(-20.0f, 15.9f);
  for (int round = 0; round < 50; ++round) {
    LinearImage image(side(random), side(random));
    for (glm::vec3& texel : image.pixels) {
      texel = {std::exp2(exponent(random)), random() % 2 == 0 ? 0.0f : 65504.0f, 0.3f};
    }
    const int width = image.width * side(random) + side(random);
    const int height = image.height * side(random) + side(random);
    const LinearImage large = enlarged(image, width, height);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const double u = (x + 0.5) * image.width / width - 0.5;
        const double v = (y + 0.5) * image.height / height - 0.5;
        glm::vec3 low(1e9f);
        glm::vec3 high(-1e9f);
        for (const double ty : {std::floor(v), std::floor(v) + 1.0}) {
          for (const double tx : {std::floor(u), std::floor(u) + 1.0}) {
            const glm::vec3& texel = image.at(std::clamp(static_cast<int>(tx), 0, image.width - 1),
                                              std::clamp(static_cast<int>(ty), 0, image.height - 1));
            low = glm::min(low, texel);
            high = glm::max(high, texel);
          }
        }
        const glm::vec3& pixel = large.at(x, y);
        ASSERT_TRUE(glm::all(glm::greaterThanEqual(pixel, low)) && glm::all(glm::lessThanEqual(pixel, high)));
        ASSERT_EQ(pixel.b, 0.3f) << "a constant stays what it is";
      }
    }
  }
}

TEST(Enlarge, RampsStayStraight) {
  LinearImage ramp(8, 1);
  for (int x = 0; x < 8; ++x) {
    ramp.at(x, 0) = glm::vec3(static_cast<float>(x));
  }
  const LinearImage large = enlarged(ramp, 20, 3);
  for (int x = 5; x < 15; ++x) {
    EXPECT_NEAR(large.at(x, 1).r, (x + 0.5) * 8 / 20 - 0.5, 1e-5);
  }
}

// Returns a row of gray texels.
Image8 rowOf(const std::vector<uint8_t>& codes) {
  Image8 row(static_cast<int>(codes.size()), 1);
  for (size_t x = 0; x < codes.size(); ++x) {
    std::fill_n(row.at(static_cast<int>(x), 0), 3, codes[x]);
  }
  return row;
}

TEST(SmoothEnlargement, KeepsFlatPartsAndRamps) {
  const Image8 flat =
      smoothlyEnlarged(rowOf({0, 0, 0, 0, 0, 77, 77, 77, 77, 77, 77, 255, 255, 255, 255, 255}), 160, 30);
  for (const auto& [x, code] : {std::pair(20, 0), std::pair(85, 77), std::pair(140, 255)}) {
    for (const int y : {0, 15, 29}) {
      EXPECT_EQ(flat.at(x, y)[1], code);
      EXPECT_EQ(flat.at(x, y)[3], 255);
    }
  }
  const Image8 ramp = smoothlyEnlarged(rowOf({0, 20, 40, 60, 80, 100, 120, 140, 160}), 90, 1);
  for (int x = 20; x < 70; ++x) {
    EXPECT_NEAR(ramp.at(x, 0)[0], 20.0 * ((x + 0.5) / 10.0 - 0.5), 0.51);
  }
}

TEST(SmoothEnlargement, EdgesHaveNoCorners) {
  const std::vector<uint8_t> step{40, 40, 40, 40, 200, 200, 200, 200};
  const Image8 large = smoothlyEnlarged(rowOf(step), 160, 1);
  int most = 0;  // change of the slope, which bilinear interpolation has in one pixel: 160 / 20 codes
  for (int x = 1; x < 159; ++x) {
    most = std::max(most, std::abs(large.at(x - 1, 0)[0] - 2 * large.at(x, 0)[0] + large.at(x + 1, 0)[0]));
  }
  EXPECT_LE(most, 2);
  EXPECT_NEAR(large.at(79, 0)[0] + large.at(80, 0)[0], 240, 1) << "the edge stays where it is";
}

TEST(SmoothEnlargement, OvershootsDoNotWrap) {
  const Image8 large = smoothlyEnlarged(rowOf({0, 0, 0, 255, 255, 255}), 60, 1);
  for (int x = 0; x < 60; ++x) {
    EXPECT_TRUE(x < 30 ? large.at(x, 0)[0] < 128 : large.at(x, 0)[0] > 127) << x;
  }
}

}  // namespace
}  // namespace speculum
