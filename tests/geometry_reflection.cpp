#include <gtest/gtest.h>

#include "geometry/reflection.hpp"

namespace speculum {
namespace {

// hard_cases/properties.cpp tests the invariants of reflection.
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
