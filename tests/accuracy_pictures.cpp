#include <gtest/gtest.h>

#include "accuracy/heat_map.hpp"
#include "accuracy/picture_agreement.hpp"
#include "image/color.hpp"

namespace speculum {
namespace {

TEST(PictureAgreement, CountsPixelsOverTheTolerance) {
  const Image8 a(100, 50);
  Image8 b = a;
  b.at(3, 4)[0] = 253;
  b.at(7, 4)[2] = 252;
  b.at(8, 4)[3] = 0;
  const PictureAgreement agreement = pictureAgreement(a, b, 2);
  EXPECT_EQ(agreement.counted, 5000);
  EXPECT_EQ(agreement.over, 1);
  EXPECT_EQ(agreement.largest, 3);
  EXPECT_DOUBLE_EQ(agreement.fractionWithin(), 1.0 - 1.0 / 5000);
  EXPECT_TRUE(agreement.holds(0.999));
  EXPECT_FALSE(agreement.holds(1.0));
}

TEST(PictureAgreement, SmallSolidBlockIsADisagreement) {
  const Image8 a(400, 300);
  Image8 b = a;
  for (int y = 20; y < 23; ++y) {
    for (int x = 30; x < 33; ++x) {
      b.at(x, y)[1] = 0;
    }
  }
  PictureAgreement agreement = pictureAgreement(a, b, 2);
  EXPECT_GT(agreement.fractionWithin(), 0.9999);
  EXPECT_TRUE(agreement.solidBlock);
  EXPECT_EQ(agreement.blockX, 30);
  EXPECT_EQ(agreement.blockY, 20);
  EXPECT_FALSE(agreement.holds(0.999));
  b.at(31, 21)[1] = 255;
  agreement = pictureAgreement(a, b, 2);
  EXPECT_FALSE(agreement.solidBlock);
  EXPECT_TRUE(agreement.holds(0.999));
}

TEST(PictureAgreement, ExcludedPixelsDoNotCount) {
  const Image8 a(10, 10);
  Image8 b = a;
  std::vector<uint8_t> exclude(100, 0);
  for (int i = 0; i < 50; ++i) {
    b.rgba[static_cast<size_t>(i) * 4] = 0;
    exclude[i] = 1;
  }
  const PictureAgreement agreement = pictureAgreement(a, b, 0, exclude);
  EXPECT_EQ(agreement.counted, 50);
  EXPECT_EQ(agreement.over, 0);
  EXPECT_TRUE(agreement.holds(1.0));
  EXPECT_FALSE(pictureAgreement(a, b, 0).holds(0.5));
  EXPECT_THROW(pictureAgreement(a, Image8(10, 11), 2), std::runtime_error);
  EXPECT_THROW(pictureAgreement(a, b, 2, std::vector<uint8_t>(3)), std::runtime_error);
}

double luminance(const glm::dvec3& c) {
  return 0.2126 * srgbDecode(c.r) + 0.7152 * srgbDecode(c.g) + 0.0722 * srgbDecode(c.b);
}

TEST(HeatMap, ColoursRiseInLuminance) {
  double last = -1.0;
  for (int i = 0; i <= 255; ++i) {
    const double y = luminance(heatColor(i / 255.0));
    EXPECT_GT(y, last) << i;
    last = y;
  }
  EXPECT_LT(luminance(heatColor(0.0)), 0.01);
  EXPECT_GT(luminance(heatColor(1.0)), 0.8);
  EXPECT_EQ(heatColor(-1.0), heatColor(0.0));
  EXPECT_EQ(heatColor(2.0), heatColor(1.0));
}

TEST(HeatMap, ShowsTheMapAboveALegend) {
  Plane2d map(64, 20);
  map.at(10, 5) = 0.5;
  const Image8 image = heatMap(map, 0.5);
  EXPECT_EQ(image.width, 64);
  EXPECT_EQ(image.height, 20 + legendHeight(64));
  const glm::dvec3 brightest = heatColor(1.0);
  const glm::dvec3 darkest = heatColor(0.0);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(image.at(10, 5)[c], 255.0 * brightest[c], 0.51);
    EXPECT_NEAR(image.at(11, 5)[c], 255.0 * darkest[c], 0.51);
    EXPECT_NEAR(image.at(63, 26)[c], 255.0 * brightest[c], 0.51);
    EXPECT_NEAR(image.at(0, 26)[c], 255.0 * darkest[c], 0.51);
  }
  int white = 0;
  for (int y = 20 + 16; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      white += image.at(x, y)[0] == 255 && image.at(x, y)[2] == 255;
    }
  }
  EXPECT_GT(white, 20) << "the legend's numbers";
  EXPECT_NO_THROW(heatMap(Plane2d(1, 1)));
}

}  // namespace
}  // namespace speculum
