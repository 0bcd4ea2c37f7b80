#include "geometry/triangulate.hpp"

#include <algorithm>
#include <glm/gtx/norm.hpp>
#include <numeric>

#include "geometry/polygon.hpp"

namespace speculum {

namespace {

// Triangles of lower quality, 2 area / longest edge^2, are slivers: their normals are inexact.
constexpr double leastGoodQuality = 1e-5;

double longestSquared(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  return std::max({glm::length2(b - a), glm::length2(c - b), glm::length2(a - c)});
}

// Takes no ear that is a sliver, nor one beside whose new edge a vertex lies, until there is no other; from then on,
// takes these too. Vertices of a straight edge, which rounding moves off it, would else make slivers.
class EarClipper {
 public:
  explicit EarClipper(std::span<const glm::dvec3> polygon)
      : points_(polygon),
        normal_(newellVector(polygon)),
        normalLength_(glm::length(normal_)),
        left_(polygon.size()),
        isLeft_(polygon.size(), true),
        searches_(polygon.size()) {
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
  // Progress of a vertex's search for others inside the triangle of it and its neighbours. Vertices found outside stay
  // outside until a neighbour changes, so repeated searches test each other vertex once.
  struct Search {
    int before = -1;
    int after = -1;
    int next = -1;  // vertex to test; `before` when all are outside
  };

  // Positive when a, b, c turn left seen against the polygon's normal.
  double turn(int a, int b, int c) const {
    return glm::dot(normal_, glm::cross(points_[b] - points_[a], points_[c] - points_[b]));
  }

  // Twice the area, times the length of the normal, of a sliver with this longest edge.
  double sliverTurn(double squaredEdge) const { return leastQuality_ * squaredEdge * normalLength_; }

  bool inside(int p, int a, int b, int c) const {
    if (points_[p] == points_[a] || points_[p] == points_[b] || points_[p] == points_[c]) {
      return false;
    }
    return turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 &&
           turn(c, a, p) >= -sliverTurn(glm::length2(points_[a] - points_[c]));
  }

  bool isEar(size_t i) {
    const size_t n = left_.size();
    const int a = left_[(i + n - 1) % n];
    const int b = left_[i];
    const int c = left_[(i + 1) % n];
    const double area = turn(a, b, c);
    if (area <= 0.0 || area < sliverTurn(longestSquared(points_[a], points_[b], points_[c]))) {
      return false;
    }
    Search& search = searches_[b];
    if (search.before != a || search.after != c) {
      search = {a, c, follower(c)};
    }
    while (search.next != a && !(isLeft_[search.next] && inside(search.next, a, b, c))) {
      search.next = follower(search.next);
    }
    return search.next == a;
  }

  int follower(int vertex) const { return vertex + 1 == static_cast<int>(points_.size()) ? 0 : vertex + 1; }

  // Starts at the second vertex, which makes fans of convex polygons. If there is no ear, takes slivers from then on,
  // and if there is none of these, the second vertex.
  size_t findEar() {
    for (size_t k = 0; k < left_.size(); ++k) {
      const size_t i = (k + 1) % left_.size();
      if (isEar(i)) {
        return i;
      }
    }
    if (leastQuality_ == 0.0) {
      return 1;
    }
    leastQuality_ = 0.0;
    searches_.assign(searches_.size(), {});
    return findEar();
  }

  std::span<const glm::dvec3> points_;
  glm::dvec3 normal_;
  double normalLength_ = 0.0;
  double leastQuality_ = leastGoodQuality;
  std::vector<int> left_;
  std::vector<bool> isLeft_;
  std::vector<Search> searches_;
};

// Returns the quality of the worse triangle; negative if their diagonal leaves the quad, which need not be convex.
double qualityOf(std::span<const glm::dvec3> quad, const std::array<std::array<int, 3>, 2>& triangles) {
  const glm::dvec3 normal = newellVector(quad);
  const auto quality = [&](const std::array<int, 3>& t) {
    return glm::dot(normal, glm::cross(quad[t[1]] - quad[t[0]], quad[t[2]] - quad[t[0]])) /
           longestSquared(quad[t[0]], quad[t[1]], quad[t[2]]);
  };
  return std::min(quality(triangles[0]), quality(triangles[1])) / glm::length(normal);
}

// Cuts along the shorter diagonal, unless only the other one leaves two good triangles.
std::vector<std::array<int, 3>> triangulateQuad(std::span<const glm::dvec3> quad) {
  constexpr std::array<std::array<int, 3>, 2> fromFirst{{{0, 1, 2}, {0, 2, 3}}};
  constexpr std::array<std::array<int, 3>, 2> fromSecond{{{0, 1, 3}, {1, 2, 3}}};
  const bool firstIsShorter = glm::length2(quad[2] - quad[0]) < glm::length2(quad[3] - quad[1]);
  const auto& shorter = firstIsShorter ? fromFirst : fromSecond;
  const auto& other = firstIsShorter ? fromSecond : fromFirst;
  const double quality = qualityOf(quad, shorter);
  const auto& chosen = quality < leastGoodQuality && qualityOf(quad, other) > quality ? other : shorter;
  return {chosen.begin(), chosen.end()};
}

}  // namespace

bool isFan(std::span<const glm::dvec3> polygon) {
  const glm::dvec3 normal = newellVector(polygon);
  const glm::dvec3 first = polygon[1] - polygon[0];
  for (size_t i = 1; i + 1 < polygon.size(); ++i) {
    const glm::dvec3 next = polygon[i + 1] - polygon[0];
    // The edges turn one way, and by less than half a turn in all.
    if (glm::dot(normal, glm::cross(polygon[i] - polygon[0], next)) < 0.0 ||
        glm::dot(normal, glm::cross(first, next)) < 0.0) {
      return false;
    }
  }
  return true;
}

std::vector<std::array<int, 3>> triangulate(std::span<const glm::dvec3> polygon) {
  constexpr size_t fewVertices = 1000;
  if (polygon.size() == 3) {
    return {{0, 1, 2}};
  }
  if (polygon.size() == 4) {
    return triangulateQuad(polygon);
  }
  if (polygon.size() > fewVertices && isFan(polygon)) {
    std::vector<std::array<int, 3>> triangles(polygon.size() - 2);
    for (int i = 0; i < static_cast<int>(triangles.size()); ++i) {
      triangles[i] = {0, i + 1, i + 2};
    }
    return triangles;
  }
  return EarClipper(polygon).run();
}

}  // namespace speculum
