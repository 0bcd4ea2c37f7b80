#include "geometry/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtx/norm.hpp>
#include <limits>

namespace speculum {

namespace {

double diameter(std::span<const glm::dvec3> polygon) {
  double largest = 0.0;
  for (const glm::dvec3& p : polygon) {
    largest = std::max(largest, farthestDistance(p, polygon));
  }
  return largest;
}

// Says whether no vertex lies farther than `tolerance` outside the line of any edge. Comparing each edge with the next
// is not enough: many small turns to the wrong side add up to a hollow.
bool isConvex(std::span<const glm::dvec3> polygon, const glm::dvec3& normal, double tolerance) {
  const size_t n = polygon.size();
  double turning = 0.0;
  for (size_t i = 0; i < n; ++i) {
    const glm::dvec3 edge = polygon[(i + 1) % n] - polygon[i];
    const glm::dvec3 inwards = glm::cross(normal, edge);
    const double most = tolerance * glm::length(inwards);
    for (const glm::dvec3& p : polygon) {
      if (glm::dot(inwards, p - polygon[i]) < -most) {
        return false;
      }
    }
    const glm::dvec3 next = polygon[(i + 2) % n] - polygon[(i + 1) % n];
    turning += std::atan2(glm::dot(normal, glm::cross(edge, next)), glm::dot(edge, next));
  }
  // A convex outline turns once; a pentagram turns left at every vertex as well, but twice around.
  return turning < 3.0 * 3.14159265358979323846;
}

// Triangles of lower quality, 2 area / longest edge^2, are slivers: their normals are inexact.
constexpr double leastGoodQuality = 1e-5;

double longestSquared(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  return std::max({glm::length2(b - a), glm::length2(c - b), glm::length2(a - c)});
}

// Takes no ear that is a sliver, nor one beside whose new edge a vertex lies, until there is no other; from then on,
// takes these too. Vertices of a straight edge, which rounding moves off it, would else make slivers. Spikes, which
// have no area, go first: they are no ears, but the corners beside them are once the spike is gone.
class EarClipper {
 public:
  explicit EarClipper(std::span<const glm::dvec3> polygon)
      : points_(polygon),
        normal_(newellVector(polygon)),
        normalLength_(glm::length(normal_)),
        left_(static_cast<int>(polygon.size())),
        before_(polygon.size()),
        after_(polygon.size()),
        searches_(polygon.size()) {
    for (int i = 0; i < left_; ++i) {
      before_[i] = i == 0 ? left_ - 1 : i - 1;
      after_[i] = i + 1 == left_ ? 0 : i + 1;
    }
  }

  std::vector<std::array<int, 3>> run() {
    for (int i = 0; i < static_cast<int>(points_.size()) && left_ >= 3; ++i) {
      if (isLeft(i) && isSpike(i)) {
        cut(i);
      }
    }
    while (left_ >= 3) {
      cut(findEar());
    }
    return std::move(triangles_);
  }

 private:
  // Progress of a vertex's search for others that stand in the triangle of it and its neighbours. Vertices found
  // outside stay outside until a neighbour changes, so repeated searches test each other vertex once.
  struct Search {
    int before = -1;
    int after = -1;
    int next = -1;  // vertex to test; `before` when all are outside
  };

  static constexpr int taken = -1;

  bool isLeft(int vertex) const { return before_[vertex] != taken; }

  // Makes a triangle of the vertex and its neighbours, and then of the spikes that this leaves.
  void cut(int vertex) {
    do {
      const int a = before_[vertex];
      const int c = after_[vertex];
      triangles_.push_back({a, vertex, c});
      before_[vertex] = taken;
      after_[a] = c;
      before_[c] = a;
      first_ = vertex == first_ ? c : first_;
      --left_;
      vertex = isSpike(a) ? a : c;
    } while (left_ >= 3 && isSpike(vertex));
  }

  // Positive when a, b, c turn left seen against the polygon's normal.
  double turn(int a, int b, int c) const {
    return glm::dot(normal_, glm::cross(points_[b] - points_[a], points_[c] - points_[b]));
  }

  // Twice the area, times the length of the normal, of a sliver with this longest edge.
  double sliverTurn(double squaredEdge) const { return leastQuality_ * squaredEdge * normalLength_; }

  // Says whether the outline goes straight back at the vertex, as far as rounding allows, or stays where it is.
  bool isSpike(int vertex) const {
    const glm::dvec3& a = points_[before_[vertex]];
    const glm::dvec3& b = points_[vertex];
    const glm::dvec3& c = points_[after_[vertex]];
    return b == c || (glm::dot(b - a, c - b) < 0.0 && std::abs(turn(before_[vertex], vertex, after_[vertex])) <=
                                                          leastGoodQuality * longestSquared(a, b, c) * normalLength_);
  }

  // Says whether the outline that touches the ear's corner `at`, which lies between `from` and `to`, enters the ear.
  bool enters(int p, int from, int at, int to) const {
    const auto isBetween = [&](int q) {
      const glm::dvec3 edge = points_[q] - points_[p];
      const auto isLeftOf = [&](const glm::dvec3& u, const glm::dvec3& v) {
        return glm::dot(normal_, glm::cross(u, v)) > sliverTurn(std::max(glm::length2(u), glm::length2(v)));
      };
      return isLeftOf(points_[to] - points_[at], edge) && isLeftOf(edge, points_[from] - points_[at]);
    };
    return isBetween(before_[p]) || isBetween(after_[p]);
  }

  bool inside(int p, int a, int b, int c) const {
    if (points_[p] == points_[a]) {
      return enters(p, c, a, b);
    }
    if (points_[p] == points_[b]) {
      return enters(p, a, b, c);
    }
    if (points_[p] == points_[c]) {
      return enters(p, b, c, a);
    }
    return turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 &&
           turn(c, a, p) >= -sliverTurn(glm::length2(points_[a] - points_[c]));
  }

  bool isEar(int b) {
    const int a = before_[b];
    const int c = after_[b];
    const double area = turn(a, b, c);
    if (area <= 0.0 || area < sliverTurn(longestSquared(points_[a], points_[b], points_[c]))) {
      return false;
    }
    Search& search = searches_[b];
    if (search.before != a || search.after != c) {
      search = {a, c, after_[c]};
    }
    while (search.next != a && !(isLeft(search.next) && inside(search.next, a, b, c))) {
      search.next = after_[search.next];
    }
    return search.next == a;
  }

  // Starts at the second vertex, which makes fans of convex polygons. If there is no ear, takes slivers from then on,
  // and if there is none of these, the second vertex.
  int findEar() {
    int vertex = first_;
    for (int k = 0; k < left_; ++k) {
      vertex = after_[vertex];
      if (isEar(vertex)) {
        return vertex;
      }
    }
    if (leastQuality_ == 0.0) {
      return after_[first_];
    }
    leastQuality_ = 0.0;
    searches_.assign(searches_.size(), {});
    return findEar();
  }

  std::span<const glm::dvec3> points_;
  glm::dvec3 normal_;
  double normalLength_ = 0.0;
  double leastQuality_ = leastGoodQuality;
  int left_ = 0;             // vertices that are left, as a ring
  int first_ = 0;            // the lowest of them
  std::vector<int> before_;  // `taken` for a vertex that is not left
  std::vector<int> after_;
  std::vector<Search> searches_;
  std::vector<std::array<int, 3>> triangles_;
};

// Returns the quality of the worse triangle; negative if their diagonal leaves the quad, which need not be convex.
double qualityOf(std::span<const glm::dvec3> quad, const std::array<std::array<int, 3>, 2>& triangles) {
  constexpr double smallest = std::numeric_limits<double>::min();  // corners may be one point
  const glm::dvec3 normal = newellVector(quad);
  const auto quality = [&](const std::array<int, 3>& t) {
    return glm::dot(normal, glm::cross(quad[t[1]] - quad[t[0]], quad[t[2]] - quad[t[0]])) /
           std::max(longestSquared(quad[t[0]], quad[t[1]], quad[t[2]]), smallest);
  };
  return std::min(quality(triangles[0]), quality(triangles[1])) / std::max(glm::length(normal), smallest);
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

std::vector<glm::dvec2> convexHull(std::vector<glm::dvec2> points) {
  std::ranges::sort(points,
                    [](const glm::dvec2& a, const glm::dvec2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  std::vector<glm::dvec2> hull;
  const auto add = [&](const glm::dvec2& p, size_t first) {
    while (hull.size() >= first + 2) {
      const glm::dvec2& start = hull[hull.size() - 2];
      if (cross(hull.back() - start, p - start) > 0.0) {
        break;
      }
      hull.pop_back();
    }
    hull.push_back(p);
  };
  for (const glm::dvec2& p : points) {
    add(p, 0);
  }
  const size_t lower = hull.empty() ? 0 : hull.size() - 1;
  for (auto p = points.rbegin(); p != points.rend(); ++p) {
    add(*p, lower);
  }
  return hull;
}

glm::dvec3 newellVector(std::span<const glm::dvec3> polygon) {
  glm::dvec3 sum(0.0);
  for (size_t i = 1; i + 1 < polygon.size(); ++i) {
    sum += glm::cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
  }
  return sum;
}

glm::dvec3 vertexMean(std::span<const glm::dvec3> polygon) {
  glm::dvec3 sum(0.0);
  for (const glm::dvec3& p : polygon) {
    sum += p - polygon[0];
  }
  return polygon[0] + sum / static_cast<double>(polygon.size());
}

double polygonArea(std::span<const glm::dvec3> polygon) {
  return 0.5 * glm::length(newellVector(polygon));
}

double farthestDistance(const glm::dvec3& from, std::span<const glm::dvec3> points) {
  double farthest = 0.0;
  for (const glm::dvec3& p : points) {
    farthest = std::max(farthest, glm::length(p - from));
  }
  return farthest;
}

std::optional<std::string> polygonDefect(std::span<const glm::dvec3> polygon) {
  if (polygon.size() < 3) {
    return "has fewer than 3 vertices";
  }
  for (const glm::dvec3& p : polygon) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      return "has a vertex that is not finite";
    }
  }
  const double scale = diameter(polygon);
  if (!(polygonArea(polygon) >= 1e-8 * scale * scale) || scale == 0.0) {
    return "has no area";
  }
  const Plane plane{polygon[0], glm::normalize(newellVector(polygon))};
  for (const glm::dvec3& p : polygon) {
    if (std::abs(plane.distance(p)) > 1e-4 * scale) {
      return "is not planar";
    }
  }
  if (!isConvex(flattened(polygon, plane.normal), plane.normal, 1e-5 * scale)) {
    return "is not convex";
  }
  return std::nullopt;
}

Polygon distinctVertices(std::span<const glm::dvec3> polygon, double least) {
  Polygon distinct;
  distinct.reserve(polygon.size());
  for (const glm::dvec3& p : polygon) {
    if (distinct.empty() || glm::length(p - distinct.back()) > least) {
      distinct.push_back(p);
    }
  }
  while (distinct.size() > 1 && glm::length(distinct.front() - distinct.back()) <= least) {
    distinct.pop_back();
  }
  return distinct;
}

std::vector<glm::dvec3> flattened(std::span<const glm::dvec3> polygon, const glm::dvec3& normal) {
  const Plane plane{polygon[0], normal};
  const double size = farthestDistance(polygon[0], polygon);
  std::vector<glm::dvec3> flat(polygon.begin(), polygon.end());
  for (glm::dvec3& vertex : flat) {
    const double distance = plane.distance(vertex);
    vertex -= std::abs(distance) > 1e-12 * size ? distance * normal : glm::dvec3(0.0);
  }
  const Polygon distinct = distinctVertices(flat, 1e-9 * size);
  return {distinct.begin(), distinct.end()};
}

Polygon clipPolygon(std::span<const glm::dvec3> polygon, const Plane& keep) {
  Polygon kept;
  kept.reserve(polygon.size() + 1);
  for (size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3& a = polygon[i];
    const glm::dvec3& b = polygon[(i + 1) % polygon.size()];
    const double da = keep.distance(a);
    const double db = keep.distance(b);
    if (da >= 0.0) {
      kept.push_back(a);
    }
    if ((da >= 0.0) != (db >= 0.0)) {
      kept.push_back(a + (b - a) * (da / (da - db)));
    }
  }
  return kept;
}

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
