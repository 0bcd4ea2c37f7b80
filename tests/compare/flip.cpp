#include "compare/image_metrics.hpp"
#include "made_pictures.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

constexpr int size = 128;
constexpr double tolerance = 2e-4;

template <typename Color>
ComparedImage picture(Color&& color) {
  return comparedImage(testing_support::madePicture(
      size, size, [&](int x, int y) { return glm::ivec4(255.0 * glm::dvec4(color(x, y), 1.0)); }));
}

ComparedImage constant(const glm::dvec3& c) {
  return picture([&](int, int) { return c; });
}

glm::dvec3 checker(int x, int y) {
  return glm::dvec3(((x / 8 + y / 8) & 1) != 0 ? 204.0 / 255.0 : 51.0 / 255.0);
}

double meanFlip(const ComparedImage& a, const ComparedImage& b) {
  const Plane2d map = flipMap(a, b);
  return std::accumulate(map.values.begin(), map.values.end(), 0.0) / static_cast<double>(map.values.size());
}

TEST(Flip, MeansAreThoseOfThePublishedImplementation) {
  const auto black = constant(glm::dvec3(0.0));
  EXPECT_NEAR(meanFlip(black, constant(glm::dvec3(1.0))), 0.967380, tolerance);
  EXPECT_NEAR(meanFlip(constant({0, 1, 0}), constant({0, 0, 1})), 1.0, tolerance);
  for (const int moved : {1, 15}) {
    const auto other = picture([&](int x, int y) { return checker(x + moved, y); });
    EXPECT_NEAR(meanFlip(picture(checker), other), 0.232971, tolerance) << moved;
  }
  const auto dot = picture([](int x, int y) { return glm::dvec3(x == 64 && y == 64 ? 1.0 : 0.0); });
  EXPECT_NEAR(meanFlip(black, dot), 0.000874, 2e-6);
}

TEST(Flip, IsZeroForEqualPicturesAndSymmetric) {
  const auto a = picture(checker);
  const auto b = picture([](int x, int y) { return checker(x, y) * glm::dvec3(1.0, 0.8, 0.6); });
  EXPECT_EQ(meanFlip(a, a), 0.0);
  EXPECT_GT(meanFlip(a, b), 0.05);
  EXPECT_NEAR(meanFlip(a, b), meanFlip(b, a), 1e-12);
}

// Returns the flicker of two frames, each { reference, test }.
double flicker(const std::pair<ComparedImage, ComparedImage>& before,
               const std::pair<ComparedImage, ComparedImage>& now) {
  const auto perceived = [](const std::pair<ComparedImage, ComparedImage>& frame) {
    std::vector<glm::dvec3> differences;
    flipMap(frame.first, frame.second, &differences);
    return differences;
  };
  return flickerOf(perceived(before), perceived(now));
}

TEST(Flicker, ErrorsThatStayCountNothing) {
  const auto dark = picture([](int x, int y) { return 0.7 * checker(x, y); });
  EXPECT_EQ(flicker({picture(checker), dark}, {picture(checker), dark}), 0.0);
  const auto moved = picture([](int x, int y) { return checker(x + 3, y); });
  EXPECT_EQ(flicker({picture(checker), picture(checker)}, {moved, moved}), 0.0) << "a movement that is drawn right";
}

TEST(Flicker, ErrorsThatComeAndGoCountAsFlip) {
  const auto grey = constant(glm::dvec3(0.2));
  for (const glm::dvec3& wrong : {glm::dvec3(0.0), glm::dvec3(0.25, 0.2, 0.2), glm::dvec3(1.0)}) {
    const double once = flicker({grey, grey}, {grey, constant(wrong)});
    EXPECT_NEAR(once, meanFlip(grey, constant(wrong)), 1e-9);
    EXPECT_NEAR(flicker({grey, constant(wrong)}, {grey, grey}), once, 1e-12);
  }
}

TEST(Flicker, GrowsWithTheChangeOfTheError) {
  const auto black = constant(glm::dvec3(0.0));
  double last = 0.0;
  for (const double level : {0.1, 0.3, 0.9}) {
    const double now = flicker({black, black}, {black, constant(glm::dvec3(level))});
    EXPECT_GT(now, last);
    last = now;
  }
}

TEST(Flicker, OppositeErrorsCountAtMostOne) {
  const auto green = constant({0.0, 1.0, 0.0});
  const auto blue = constant({0.0, 0.0, 1.0});
  EXPECT_DOUBLE_EQ(flicker({blue, green}, {green, blue}), 1.0);
}

TEST(Flicker, EdgesAndPointsCountLessThanInFlip) {
  const auto grey = constant(glm::dvec3(0.2));
  const auto wrong = picture(checker);
  const double once = flicker({grey, grey}, {grey, wrong});
  EXPECT_GT(once, 0.0);
  EXPECT_LT(once, meanFlip(grey, wrong));
}

// What moves too late by a frame flickers, and a picture that stands still while the reference moves does.
TEST(Flicker, WrongAndMissingChangesCountAlike) {
  const auto a = picture(checker);
  const auto b = picture([](int x, int y) { return checker(x + 3, y); });
  EXPECT_GT(flicker({a, a}, {b, a}), 0.01);
  EXPECT_NEAR(flicker({a, a}, {b, a}), flicker({a, a}, {a, b}), 1e-12);
}

TEST(Flip, WorksOnPicturesSmallerThanItsFilters) {
  Image8 one(1, 1);
  Image8 other(1, 1);
  other.at(0, 0)[0] = 0;
  EXPECT_GT(flipMap(comparedImage(one), comparedImage(other)).values[0], 0.1);
}

}  // namespace
}  // namespace speculum
