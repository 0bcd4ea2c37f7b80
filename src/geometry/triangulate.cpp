#include "geometry/triangulate.hpp"

#include <numeric>

#include "geometry/polygon.hpp"

namespace speculum {

namespace {

class EarClipper {
 public:
  explicit EarClipper(std::span<const glm::dvec3> polygon)
      : points_(polygon),
        normal_(newellVector(polygon)),
        left_(polygon.size()),
        isLeft_(polygon.size(), true),
        looks_(polygon.size()) {
    std::iota(left_.begin(), left_.end(), 0);
  }

  std::vector<std::array<int, 3>> run() {
    std::vector<std::array<int, 3>> triangles;
    while (left_.size() >= 3) {
      const size_t ear = findEar();
      const size_t n = left_.size();
      triangles.push_back({left_[(ear + n - 1) % n], left_[ear], left_[(ear + 1) % n]});
      isLeft_[left_[ear]] = false;
      left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    return triangles;
  }

 private:
  // How far the search for a vertex inside the triangle of a vertex and its neighbours has come. While the neighbours
  // stay, those passed stay outside, so that all searches of a vertex together pass every other one only once.
  struct Look {
    int before = -1;
    int after = -1;
    int next = -1;  // vertex to look at; `before` when all are outside
  };

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

  bool isEar(size_t i) {
    const size_t n = left_.size();
    const int a = left_[(i + n - 1) % n];
    const int b = left_[i];
    const int c = left_[(i + 1) % n];
    if (turn(a, b, c) <= 0.0) {
      return false;
    }
    Look& look = looks_[b];
    if (look.before != a || look.after != c) {
      look = {a, c, follower(c)};
    }
    while (look.next != a && !(isLeft_[look.next] && inside(look.next, a, b, c))) {
      look.next = follower(look.next);
    }
    return look.next == a;
  }

  int follower(int vertex) const { return vertex + 1 == static_cast<int>(points_.size()) ? 0 : vertex + 1; }

  // From the second vertex on, which makes fans of convex polygons. Without any ear left the second vertex goes.
  size_t findEar() {
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
  std::vector<bool> isLeft_;
  std::vector<Look> looks_;
};

}  // namespace

std::vector<std::array<int, 3>> triangulate(std::span<const glm::dvec3> polygon) {
  if (polygon.size() == 3) {
    return {{0, 1, 2}};
  }
  return EarClipper(polygon).run();
}

}  // namespace speculum
