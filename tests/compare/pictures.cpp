#include "compare/picture_agreement.hpp"
#include "image/image.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

double luminance(const glm::dvec3& c) {
  return 0.2126 * srgbDecode(c.r) + 0.7152 * srgbDecode(c.g) + 0.0722 * srgbDecode(c.b);
}

TEST(HeatMap, ColorsRiseInLuminance) {
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
  map.at(10, 5) = 1.0;
  const Image8 image = heatMap(map);
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
  EXPECT_GE(white, 20) << "the legend's numbers";
  EXPECT_NO_THROW(heatMap(Plane2d(1, 1)));
}

}  // namespace
}  // namespace speculum
