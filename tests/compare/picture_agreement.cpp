// difference(), on which tests of pictures rely.
#include "picture_support.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

using namespace testing_support;

TEST(PictureAgreement, CountsPixelsOverTheTolerance) {
  const Image8 a(100, 50);
  Image8 b = a;
  b.at(3, 4)[0] = 253;
  b.at(7, 4)[2] = 252;
  b.at(8, 4)[3] = 0;
  PictureAgreement agreement = difference(a, b, 2);
  EXPECT_EQ(agreement.counted, 5000);
  EXPECT_EQ(agreement.over, 1);
  EXPECT_EQ(agreement.largest, 3);
  EXPECT_TRUE(agreement.holds());
  for (int i = 0; i < 5; ++i) {
    b.at(10 * i, 20)[1] = 0;
  }
  EXPECT_FALSE(difference(a, b, 2).holds()) << "6 of 5000";
  EXPECT_THROW(difference(a, Image8(100, 51), 2), std::runtime_error);
}

TEST(PictureAgreement, SmallSolidBlockIsADisagreement) {
  const Image8 a(400, 300);
  Image8 b = a;
  for (int y = 20; y < 23; ++y) {
    for (int x = 30; x < 33; ++x) {
      b.at(x, y)[1] = 0;
    }
  }
  EXPECT_LT(difference(a, b, 2).share(), 0.0001);
  EXPECT_EQ(difference(a, b, 2).block, glm::ivec2(30, 20));
  EXPECT_FALSE(difference(a, b, 2).holds());
  b.at(31, 21)[1] = 255;
  EXPECT_TRUE(difference(a, b, 2).holds());
}

TEST(PictureAgreement, PixelsThatDoNotCountMayDiffer) {
  const Image8 a(10, 10);
  Image8 b = a;
  std::vector<bool> counts(100, true);
  for (size_t i = 0; i < 50; ++i) {
    b.rgba[4 * i] = 0;
    counts[i] = false;
  }
  EXPECT_EQ(difference(a, b, 0, counts).counted, 50);
  EXPECT_EQ(difference(a, b, 0, counts).over, 0);
  EXPECT_FALSE(difference(a, b, 0).holds());
}

}  // namespace
}  // namespace speculum
