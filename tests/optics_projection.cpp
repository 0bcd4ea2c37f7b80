#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

#include "optics/projection.hpp"

namespace speculum {
namespace {

const Projection projection(glm::radians(60.0), 16.0 / 9.0, 0.001);

glm::dvec3 toNdc(const glm::dvec4& clip) {
  return glm::dvec3(clip) / clip.w;
}

TEST(Projection, MatrixAndFunctionAgree) {
  const glm::dvec3 p(0.3, -0.7, -2.5);
  EXPECT_EQ(projection.matrix() * glm::dvec4(p, 1.0), projection.clip(p));
}

TEST(Projection, TopOfTheViewIsTheFirstRow) {
  const double y = 2.0 * std::tan(glm::radians(30.0));
  EXPECT_NEAR(toNdc(projection.clip({0.0, y, -2.0})).y, -1.0, 1e-15);
}

TEST(Projection, DepthFallsStrictlyWithDistance) {
  EXPECT_TRUE(rc::check("depth is monotone", [] {
    const double near = std::pow(10.0, *rc::gen::inRange(-3000, 7000) / 1000.0);
    const double far = near * (1.0 + std::pow(10.0, *rc::gen::inRange(-6000, 3000) / 1000.0));
    const float a = static_cast<float>(toNdc(projection.clip({0, 0, -near})).z);
    const float b = static_cast<float>(toNdc(projection.clip({0, 0, -far})).z);
    RC_ASSERT(a > b);
  }));
}

TEST(Projection, ObliqueDepthIsZeroDistanceAtThePlane) {
  // A floor 1 m below a reflected eye that looks down at it: kept is what lies below the floor's image.
  const glm::dvec4 plane(0.0, glm::normalize(glm::dvec2(1.0, -1.0)).x, glm::normalize(glm::dvec2(1.0, -1.0)).y, -1.0);
  const auto oblique = obliqueProjection(projection, plane);
  ASSERT_TRUE(oblique);
  const glm::dvec3 normal(plane);
  const glm::dvec3 onPlane = normal * 1.0 + glm::dvec3(0.2, 0, 0);
  const glm::dvec4 at = *oblique * glm::dvec4(onPlane, 1.0);
  EXPECT_NEAR(at.z, at.w, 1e-12);
  const glm::dvec4 behind = *oblique * glm::dvec4(onPlane - 0.01 * normal, 1.0);
  EXPECT_GT(behind.z, behind.w);
  const glm::dvec4 front = *oblique * glm::dvec4(onPlane + 0.01 * normal, 1.0);
  EXPECT_LT(front.z, front.w);
}

TEST(Projection, ObliqueDoesNotExistForAnEyeOnTheKeptSide) {
  EXPECT_FALSE(obliqueProjection(projection, {0, 0, -1, 0.5}));
  EXPECT_FALSE(obliqueProjection(projection, {0, 0, 1, -0.5}));
}

TEST(ScreenRect, RoundsOutwardsAndPads) {
  const std::vector<glm::dvec4> clip = {{-0.5, -0.5, 0, 1}, {0.5, -0.5, 0, 1}, {0.5, 0.5, 0, 1}, {-0.5, 0.5, 0, 1}};
  EXPECT_EQ(screenRect(clip, 100, 100, {0, 0, 100, 100}), (PixelRect{24, 24, 52, 52}));
  EXPECT_EQ(screenRect(clip, 100, 100, {50, 0, 50, 100}), (PixelRect{50, 24, 26, 52}));
  EXPECT_DOUBLE_EQ(screenArea(clip, 100, 100), 2500.0);
}

TEST(ScreenRect, IsEverythingWhenAVertexIsInTheEyesPlane) {
  const std::vector<glm::dvec4> clip = {{0, 0, 0, 1}, {1e-14, 0, 0, 1e-13}, {0, 0.5, 0, 1}};
  EXPECT_EQ(screenRect(clip, 64, 32, {0, 0, 64, 32}), (PixelRect{0, 0, 64, 32}));
}

TEST(ScreenRect, IsEmptyWithoutVertices) {
  EXPECT_TRUE(screenRect({}, 64, 32, {0, 0, 64, 32}).empty());
  EXPECT_EQ(screenArea({}, 64, 32), 0.0);
}

}  // namespace
}  // namespace speculum
