#include "geometry/triangulate.hpp"

#include "geometry/polygon.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

// Expects triangles that are wound like the polygon and whose areas add up to the polygon's.
void expectTiles(const std::vector<glm::dvec3>& polygon) {
  const auto triangles = triangulate(polygon);
  ASSERT_EQ(triangles.size(), polygon.size() - 2);
  const glm::dvec3 whole = newellVector(polygon);
  double sum = 0.0;
  for (const auto& [a, b, c] : triangles) {
    const std::array<glm::dvec3, 3> corners{polygon[a], polygon[b], polygon[c]};
    const double part = glm::dot(newellVector(corners), whole) / glm::dot(whole, whole);
    EXPECT_GE(part, -1e-12) << "turned over";
    sum += part;
  }
  EXPECT_NEAR(sum, 1.0, 1e-12);
}

std::vector<glm::dvec3> ring(int count, double (*radius)(int)) {
  std::vector<glm::dvec3> points;
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * std::acos(-1.0) * i / count;
    // In a slanted plane far from the origin.
    points.push_back(glm::dvec3(1e6) +
                     radius(i) * (std::cos(angle) * glm::dvec3(0.6, 0.8, 0.0) + std::sin(angle) * glm::dvec3(0, 0, 1)));
  }
  return points;
}

TEST(Triangulate, ConvexPolygonsAreFans) {
  const std::vector<glm::dvec3> house{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0.5, 1.5, 0}, {0, 1, 0}};
  EXPECT_EQ(triangulate(house), (std::vector<std::array<int, 3>>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
  expectTiles(ring(300, [](int) { return 1.0; }));
}

TEST(Triangulate, ConcavePolygonsAreTiled) {
  expectTiles({{0, 0, 0}, {2, 0, 0}, {0.5, 0.5, 0}, {0, 2, 0}});
  expectTiles({{0.5, 0.5, 0}, {0, 2, 0}, {0, 0, 0}, {2, 0, 0}});
  expectTiles({{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {2, 3, 0}, {2, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}});
  expectTiles(ring(40, [](int i) { return i % 2 == 0 ? 1.0 : 0.3; }));
}

TEST(Triangulate, PointsOnEdgesAreNoEars) {
  const std::vector<glm::dvec3> polygon{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
  expectTiles(polygon);
  for (const auto& [a, b, c] : triangulate(polygon)) {
    EXPECT_GT(polygonArea(std::array<glm::dvec3, 3>{polygon[a], polygon[b], polygon[c]}), 0.1);
  }
}

TEST(Triangulate, DegeneratePolygonsStillEnd) {
  EXPECT_EQ(triangulate(std::vector<glm::dvec3>(5, glm::dvec3(1.0))).size(), 3u);
  EXPECT_EQ(triangulate(std::vector<glm::dvec3>{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}).size(), 2u);
}

TEST(Triangulate, QuadsThatAreNotConvexAreTiled) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> part(0.05, 0.95);
  for (int i = 0; i < 1000; ++i) {
    // The fourth vertex lies within the triangle of the others.
    const double a = part(random);
    const double b = (1.0 - a) * part(random);
    std::vector<glm::dvec3> dart{{0, 0, 0}, {1, 0.2, 0.3}, {0.3, 1, -0.5}};
    dart.push_back((1.0 - a - b) * dart[0] + a * dart[1] + b * dart[2]);
    std::rotate(dart.begin(), dart.begin() + i % 4, dart.end());
    expectTiles(dart);
  }
}

// Clips ears without keeping anything from one ear to the next.
std::vector<std::array<int, 3>> earsByTheRule(const std::vector<glm::dvec3>& points) {
  const glm::dvec3 normal = newellVector(points);
  const auto turn = [&](int a, int b, int c) {
    return glm::dot(normal, glm::cross(points[b] - points[a], points[c] - points[b]));
  };
  std::vector<int> left(points.size());
  std::iota(left.begin(), left.end(), 0);
  const auto isEar = [&](int a, int b, int c) {
    return turn(a, b, c) > 0.0 && std::ranges::none_of(left, [&](int p) {
             return points[p] != points[a] && points[p] != points[b] && points[p] != points[c] &&
                    turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0;
           });
  };
  std::vector<std::array<int, 3>> triangles;
  while (left.size() >= 3) {
    const size_t n = left.size();
    size_t ear = 1;
    for (size_t k = n; k-- > 0;) {
      const size_t i = (k + 1) % n;
      ear = isEar(left[(i + n - 1) % n], left[i], left[(i + 1) % n]) ? i : ear;
    }
    triangles.push_back({left[(ear + n - 1) % n], left[ear], left[(ear + 1) % n]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  return triangles;
}

TEST(Triangulate, FindsTheEarsOfTheRule) {
  std::mt19937 random(7);
  for (int count = 5; count < 60; ++count) {
    for (int kind = 0; kind < 4; ++kind) {
      std::vector<glm::dvec3> points;
      for (int i = 0; i < count; ++i) {
        const double angle = 2.0 * std::acos(-1.0) * i / count;
        const double radius = 1.0 + static_cast<double>(random() % 1000) / 300.0;
        // Simple polygons, and ones that cross themselves, touch themselves and repeat vertices.
        points.push_back(kind == 0 ? radius * glm::dvec3(std::cos(angle), std::sin(angle), 0.1 * std::cos(angle))
                                   : glm::dvec3(random() % (2u << (3 * kind)), random() % (2u << (3 * kind)), 0));
      }
      ASSERT_EQ(triangulate(points), earsByTheRule(points)) << count << " vertices, kind " << kind;
    }
  }
}

}  // namespace
}  // namespace speculum
