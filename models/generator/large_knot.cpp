#include <cmath>
#include <cstdio>
#include <fstream>
#include <stdexcept>

#include "models.hpp"

namespace speculum::generator {

int64_t writeLargeKnot(const std::filesystem::path& file, int64_t triangles) {
  const int64_t around = std::max<int64_t>(8, std::llround(std::sqrt(static_cast<double>(triangles) / 2.0 / 9.0)));
  const int64_t along = std::max<int64_t>(24, std::llround(static_cast<double>(triangles) / 2.0 / around));
  const auto spine = [&](double a) {
    const double r = 2.0 + std::cos(3.0 * a);
    return glm::dvec3(r * std::cos(2.0 * a), -1.25 * std::sin(3.0 * a), r * std::sin(2.0 * a));
  };
  const auto point = [&](double u, double v) {
    const double a = 2.0 * kPi * u, w = 2.0 * kPi * v;
    const glm::dvec3 tangent = glm::normalize(spine(a + 1e-4) - spine(a - 1e-4));
    const glm::dvec3 side = glm::normalize(glm::cross(tangent, spine(a) * glm::dvec3(1.0, 0.0, 1.0)));
    const double radius = 0.46 + 0.03 * std::sin(90.0 * a + 6.0 * w);
    return 0.145 * (spine(a) + radius * (std::cos(w) * glm::cross(side, tangent) + std::sin(w) * side)) +
           glm::dvec3(0.0, 0.2545, 0.0);
  };
  std::ofstream out(file, std::ios::binary);
  char line[160];
  for (int64_t i = 0; i < along; ++i) {
    for (int64_t k = 0; k < around; ++k) {
      const double u = static_cast<double>(i) / along, v = static_cast<double>(k) / around, h = 1e-6;
      const glm::dvec3 p = point(u, v);
      const glm::dvec3 n =
          glm::normalize(glm::cross(point(u, v + h) - point(u, v - h), point(u + h, v) - point(u - h, v)));
      const int size =
          std::snprintf(line, sizeof line, "v %.6f %.6f %.6f\nvn %.4f %.4f %.4f\n", p.x, p.y, p.z, n.x, n.y, n.z);
      out.write(line, size);
    }
  }
  for (int64_t i = 0; i < along; ++i) {
    for (int64_t k = 0; k < around; ++k) {
      const int64_t i1 = (i + 1) % along, k1 = (k + 1) % around;
      const long long a = i * around + k + 1, b = i1 * around + k + 1, c = i1 * around + k1 + 1,
                      d = i * around + k1 + 1;
      const int size =
          std::snprintf(line, sizeof line, "f %lld//%lld %lld//%lld %lld//%lld\nf %lld//%lld %lld//%lld %lld//%lld\n",
                        a, a, c, c, b, b, a, a, d, d, c, c);
      out.write(line, size);
    }
  }
  if (!out.flush()) throw std::runtime_error(file.string() + ": cannot be written (a writable folder is needed)");
  return 2 * along * around;
}

}  // namespace speculum::generator
