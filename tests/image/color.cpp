
#include <cmath>
#include <limits>

#include "image/image.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

// Reference values computed from IEC 61966-2-1 with 30 digits.
TEST(Srgb, EncodesReferenceValues) {
  EXPECT_EQ(srgbEncode(0.0), 0.0);
  EXPECT_NEAR(srgbEncode(1.0), 1.0, 1e-15);
  EXPECT_NEAR(srgbEncode(0.001), 0.01292, 1e-15);
  EXPECT_NEAR(srgbEncode(0.18), 0.461356129500441650, 1e-14);
  EXPECT_NEAR(srgbEncode(0.5), 0.735356983052449491, 1e-14);
}

TEST(Srgb, DecodesReferenceValues) {
  EXPECT_EQ(srgbDecode(0.0), 0.0);
  EXPECT_NEAR(srgbDecode(1.0), 1.0, 1e-15);
  EXPECT_NEAR(srgbDecode(0.04), 0.0030959752321981426, 1e-16);
  EXPECT_NEAR(srgbDecode(0.5), 0.214041140482232431, 1e-14);
}

TEST(Srgb, ClampsWhatLiesOutside) {
  EXPECT_EQ(srgbEncode(-1.0), 0.0);
  EXPECT_EQ(srgbDecode(-1.0), 0.0);
  EXPECT_NEAR(srgbEncode(7.0), 1.0, 1e-15);
  EXPECT_NEAR(srgbDecode(7.0), 1.0, 1e-15);
}

TEST(Srgb, EveryCodeSurvivesDecodingAndDisplay) {
  for (int code = 0; code < 256; ++code) {
    LinearImage image(1, 1);
    image.at(0, 0) = glm::vec3(static_cast<float>(srgbDecode(code / 255.0)));
    EXPECT_EQ(toDisplay(image).at(0, 0)[0], code);
  }
}

TEST(Srgb, CodesAreFoundByTheirExactValue) {
  for (int code = 0; code < 256; ++code) {
    const float value = srgbDecoded()[static_cast<size_t>(code)];
    EXPECT_EQ(srgbCode(value), code);
    EXPECT_EQ(srgbCode(std::nextafter(value, 2.0f)), std::nullopt) << code;
    EXPECT_EQ(srgbCode(std::nextafter(value, -1.0f)), std::nullopt) << code;
  }
  for (const float value : {-0.5f, 0.3f, 1.5f, std::numeric_limits<float>::infinity(), std::nanf("")}) {
    EXPECT_EQ(srgbCode(value), std::nullopt) << value;
  }
}

uint8_t shown(float linear, const DisplayCurve& curve = {}) {
  LinearImage image(1, 1);
  image.at(0, 0) = glm::vec3(linear);
  return toDisplay(image, curve).at(0, 0)[1];
}

TEST(ToDisplay, RoundsToTheNearestCode) {
  // Half way between the codes 127 and 128.
  const double middle = srgbDecode(127.5 / 255.0);
  EXPECT_EQ(shown(static_cast<float>(middle * (1 - 1e-5))), 127);
  EXPECT_EQ(shown(static_cast<float>(middle * (1 + 1e-5))), 128);
}

TEST(ToDisplay, ExposureScalesRadiance) {
  EXPECT_EQ(shown(0.25f, {2.0, ToneMap::clamp}), shown(0.5f));
  EXPECT_EQ(shown(0.5f), 188);
  EXPECT_EQ(shown(0.5f, {2.0, ToneMap::clamp}), 255);
}

TEST(ToDisplay, AcesFollowsNarkowiczFit) {
  // 0.5 -> 0.5 * 1.285 / (0.5 * 1.805 + 0.14) = 0.61630695...
  EXPECT_EQ(shown(0.5f, {1.0, ToneMap::aces}), std::lround(255 * srgbEncode(0.5 * 1.285 / (0.5 * 1.805 + 0.14))));
  EXPECT_EQ(shown(0.5f, {1.0, ToneMap::aces}), 206);
  EXPECT_EQ(shown(1e6f, {1.0, ToneMap::aces}), 255);
  EXPECT_EQ(shown(0.0f, {1.0, ToneMap::aces}), 0);
}

TEST(ToDisplay, TakesEveryFloat) {
  const float infinity = std::numeric_limits<float>::infinity();
  for (const ToneMap toneMap : {ToneMap::clamp, ToneMap::aces}) {
    EXPECT_EQ(shown(infinity, {1.0, toneMap}), 255);
    EXPECT_EQ(shown(-infinity, {1.0, toneMap}), 0);
    EXPECT_EQ(shown(-0.5f, {1.0, toneMap}), 0);
    EXPECT_EQ(shown(std::numeric_limits<float>::quiet_NaN(), {1.0, toneMap}), 0);
  }
}

TEST(ToDisplay, IsOpaqueAndKeepsPixelPositions) {
  LinearImage image(3, 2);
  image.at(2, 1) = glm::vec3(1.0f, 0.0f, 0.5f);
  const Image8 display = toDisplay(image);
  ASSERT_EQ(display.width, 3);
  ASSERT_EQ(display.height, 2);
  const uint8_t* pixel = display.at(2, 1);
  EXPECT_EQ(pixel[0], 255);
  EXPECT_EQ(pixel[1], 0);
  EXPECT_EQ(pixel[2], 188);
  EXPECT_EQ(pixel[3], 255);
  EXPECT_EQ(display.at(0, 0)[0], 0);
  EXPECT_EQ(display.at(0, 0)[3], 255);
}

}  // namespace
}  // namespace speculum
