#include "scene/triangulate.hpp"

#include <numeric>

#include "optics/polygon.hpp"

namespace speculum {

namespace {

class EarClipper {
 public:
  explicit EarClipper(std::span<const glm::dvec3> polygon)
      : points_(polygon), normal_(newellVector(polygon)), left_(polygon.size()) {
    std::iota(left_.begin(), left_.end(), 0);
  }

  std::vector<std::array<int, 3>> run() {
    std::vector<std::array<int, 3>> triangles;
    while (left_.size() >= 3) {
      const size_t ear = findEar();
      const size_t n = left_.size();
      triangles.push_back({left_[(ear + n - 1) % n], left_[ear], left_[(ear + 1) % n]});
      left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    return triangles;
  }

 private:
  // Positive when a, b, c turn left seen against the polygon's normal.
  double turn(int a, int b, int c) const {
    return glm::dot(normal_, glm::cross(points_[b] - points_[a], points_[c] - points_[b]));
  }

  bool inside(int p, int a, int b, int c) const {
    if (points_[p] == points_[a] || points_[p] == points_[b] || points_[p] == points_[c]) {
      return false;
    }
    return turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0;
  }

  bool isEar(size_t i) const {
    const size_t n = left_.size();
    const int a = left_[(i + n - 1) % n];
    const int b = left_[i];
    const int c = left_[(i + 1) % n];
    if (turn(a, b, c) <= 0.0) {
      return false;
    }
    for (size_t k = 2; k + 1 < n; ++k) {
      if (inside(left_[(i + k) % n], a, b, c)) {
        return false;
      }
    }
    return true;
  }

  // From the second vertex on, which makes fans of convex polygons. Without any ear left the second vertex goes.
  size_t findEar() const {
    for (size_t k = 0; k < left_.size(); ++k) {
      const size_t i = (k + 1) % left_.size();
      if (isEar(i)) {
        return i;
      }
    }
    return 1;
  }

  std::span<const glm::dvec3> points_;
  glm::dvec3 normal_;
  std::vector<int> left_;
};

}  // namespace

std::vector<std::array<int, 3>> triangulate(std::span<const glm::dvec3> polygon) {
  return EarClipper(polygon).run();
}

}  // namespace speculum
