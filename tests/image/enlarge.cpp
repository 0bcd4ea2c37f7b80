#include "image/image.hpp"
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

}  // namespace
}  // namespace speculum
