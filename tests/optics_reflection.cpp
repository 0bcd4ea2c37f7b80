#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

#include "optics/reflection.hpp"

namespace speculum {
namespace {

// Log-uniform over 1e-6 .. 1e7, either sign.
double coordinate() {
  const double exponent = *rc::gen::inRange(-6000, 7001) / 1000.0;
  return (*rc::gen::arbitrary<bool>() ? 1.0 : -1.0) * std::pow(10.0, exponent);
}

glm::dvec3 point() {
  const double x = coordinate();
  const double y = coordinate();
  return {x, y, coordinate()};
}

Plane plane() {
  const glm::dvec3 normal = point();
  return {point(), glm::normalize(normal)};
}

template <typename Property>
void expectProperty(const char* name, Property property) {
  EXPECT_TRUE(rc::check(name, property)) << "see the counterexample above";
}

double scaleOf(const glm::dvec3& p, const Plane& m) {
  return std::max({glm::length(p), glm::length(m.point), 1e-6});
}

TEST(Reflection, TwiceIsIdentity) {
  expectProperty("R R = I", [] {
    const Plane m = plane();
    const glm::dvec3 p = point();
    const glm::dvec3 twice = reflectPoint(reflectPoint(p, m), m);
    RC_ASSERT(glm::length(twice - p) <= 1e-14 * scaleOf(p, m));
  });
}

TEST(Reflection, TurnsHandedness) {
  expectProperty("det R = -1", [] { RC_ASSERT(std::abs(glm::determinant(reflectionLinear(point())) + 1.0) <= 1e-14); });
}

TEST(Reflection, KeepsDistances) {
  expectProperty("|Ra - Rb| = |a - b|", [] {
    const Plane m = plane();
    const glm::dvec3 a = point();
    const glm::dvec3 b = point();
    const double before = glm::length(a - b);
    const double after = glm::length(reflectPoint(a, m) - reflectPoint(b, m));
    RC_ASSERT(std::abs(before - after) <= 1e-14 * std::max(scaleOf(a, m), scaleOf(b, m)));
  });
}

TEST(Reflection, PointsOfThePlaneStay) {
  expectProperty("R q = q", [] {
    const Plane m = plane();
    RC_ASSERT(reflectPoint(m.point, m) == m.point);
  });
}

TEST(Reflection, ParallelPlanesTranslateByTwiceTheirDistance) {
  expectProperty("R2 R1 = translation", [] {
    const Plane first = plane();
    const double gap = coordinate();
    const Plane second{first.point + gap * first.normal, first.normal};
    const glm::dvec3 p = point();
    const glm::dvec3 moved = reflectPoint(reflectPoint(p, first), second);
    const double scale = std::max({scaleOf(p, first), scaleOf(p, second), std::abs(gap)});
    RC_ASSERT(glm::length(moved - (p + 2.0 * gap * first.normal)) <= 1e-14 * scale);
  });
}

TEST(Reflection, IsUnaffectedByTheNormalsLength) {
  const glm::dvec3 n = glm::normalize(glm::dvec3(1, 2, 3));
  const Plane unit{{1, 1, 1}, n};
  const Plane scaled{{1, 1, 1}, 10.0 * n};
  const glm::dvec3 p(4, -2, 7);
  EXPECT_NEAR(glm::length(reflectPoint(p, unit) - reflectPoint(p, scaled)), 0.0, 1e-14);
  const glm::dmat3 difference = reflectionLinear(n) - reflectionLinear(10.0 * n);
  EXPECT_NEAR(glm::length(difference[0]) + glm::length(difference[1]) + glm::length(difference[2]), 0.0, 1e-14);
}

}  // namespace
}  // namespace speculum
