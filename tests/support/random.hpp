#pragma once

#include <array>
#include <glm/glm.hpp>
#include <random>
#include <sstream>
#include <string>

namespace speculum::testing_support {

// Random numbers, the same for the same seed.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}

  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  bool chance(double probability) { return uniform(0.0, 1.0) < probability; }

  // Returns an index below `count`.
  size_t index(size_t count) { return static_cast<size_t>(uniform(0.0, static_cast<double>(count) - 1e-9)); }

  template <size_t n>
  std::string pick(const std::array<const char*, n>& names) {
    return names[index(n)];
  }

  glm::dvec3 inBox(double halfSide) {
    const double x = uniform(-halfSide, halfSide);
    const double y = uniform(-halfSide, halfSide);
    return {x, y, uniform(-halfSide, halfSide)};
  }

  // Returns a direction of unit length.
  glm::dvec3 direction() {
    for (;;) {
      const glm::dvec3 v = inBox(1.0);
      const double length = glm::length(v);
      if (length > 0.1 && length <= 1.0) {
        return v / length;
      }
    }
  }

  // Returns a vector as a scene file takes it.
  std::string vec(double low, double high) {
    std::ostringstream out;
    out << "[" << uniform(low, high) << ", " << uniform(low, high) << ", " << uniform(low, high) << "]";
    return out.str();
  }

 private:
  std::mt19937 engine_;
};

}  // namespace speculum::testing_support
