#include "geometry/affine.hpp"

#include <array>
#include <cmath>
#include <glm/gtx/component_wise.hpp>
#include <utility>

namespace speculum {

namespace {

// Returns sine and cosine, exact at multiples of 90 degrees, where most walls stand, after any number of turns.
std::pair<double, double> sineCosine(double degrees) {
  const double reduced = std::abs(degrees) <= 180.0 ? degrees : std::remainder(degrees, 360.0);
  const double quarter = std::round(reduced / 90.0);
  const double rest = glm::radians(reduced - 90.0 * quarter);
  const double s = std::sin(rest);
  const double c = std::cos(rest);
  const std::array<std::pair<double, double>, 4> turned = {{{s, c}, {c, -s}, {-s, -c}, {-c, s}}};
  return turned[static_cast<size_t>(static_cast<int>(quarter) & 3)];
}

}  // namespace

double productModulo(double a, double b, double m) {
  const double product = a * b;
  const double lost = std::fma(a, b, -product);
  return std::remainder(std::remainder(product, m) + std::remainder(lost, m), m);
}

double largestEntry(const glm::dmat3& m) {
  return glm::compMax(glm::max(glm::abs(m[0]), glm::max(glm::abs(m[1]), glm::abs(m[2]))));
}

glm::dmat3 normalMatrix(const glm::dmat3& linear) {
  const double largest = largestEntry(linear);
  if (largest == 0.0) {
    return glm::dmat3(0.0);
  }
  const glm::dmat3 m = linear * (1.0 / largest);
  const glm::dmat3 cofactor(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
  return glm::dot(m[0], cofactor[0]) < 0.0 ? -1.0 * cofactor : cofactor;
}

glm::dmat3 rotationAboutAxis(const glm::dvec3& axis, double degrees) {
  const glm::dvec3 u = glm::normalize(axis);
  const auto [s, c] = sineCosine(degrees);
  const glm::dmat3 cross(0.0, u.z, -u.y, -u.z, 0.0, u.x, u.y, -u.x, 0.0);
  return c * glm::dmat3(1.0) + s * cross + (1.0 - c) * glm::outerProduct(u, u);
}

glm::dmat3 rotationFromDegrees(const glm::dvec3& pitchYawRoll) {
  const auto [sx, cx] = sineCosine(pitchYawRoll.x);
  const auto [sy, cy] = sineCosine(pitchYawRoll.y);
  const auto [sz, cz] = sineCosine(pitchYawRoll.z);
  const glm::dmat3 x(1, 0, 0, 0, cx, sx, 0, -sx, cx);
  const glm::dmat3 y(cy, 0, -sy, 0, 1, 0, sy, 0, cy);
  const glm::dmat3 z(cz, sz, 0, -sz, cz, 0, 0, 0, 1);
  return y * x * z;
}

}  // namespace speculum
