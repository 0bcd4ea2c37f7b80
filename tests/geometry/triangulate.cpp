
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

// Quality of the worst triangle, 2 area / longest edge^2.
double worstQuality(const std::vector<glm::dvec3>& polygon) {
  double worst = 1.0;
  for (const auto& [a, b, c] : triangulate(polygon)) {
    const std::array<glm::dvec3, 3> t{polygon[a], polygon[b], polygon[c]};
    const double longest = std::max({glm::distance(t[0], t[1]), glm::distance(t[1], t[2]), glm::distance(t[2], t[0])});
    worst = std::min(worst, 2.0 * polygonArea(t) / (longest * longest));
  }
  return worst;
}

// Corners of random triangles and quads with more vertices on their edges, rounded to six digits, from each vertex on.
TEST(Triangulate, VerticesOnStraightEdgesMakeNoSlivers) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> part(0.2, 0.8);
  for (int i = 0; i < 300; ++i) {
    const std::vector<glm::dvec3> corners =
        i % 2 == 0 ? std::vector<glm::dvec3>{{0, 0, 0}, {1, part(random), 0}, {part(random) - 0.5, 1, part(random)}}
                   : std::vector<glm::dvec3>{{0, 0, 0}, {1, 0, 0.5}, {1, part(random) + 0.5, 0.5}, {0, 1, 0}};
    std::vector<glm::dvec3> polygon;
    for (size_t k = 0; k < corners.size(); ++k) {
      polygon.push_back(corners[k]);
      const glm::dvec3 next = corners[(k + 1) % corners.size()];
      const auto more = random() % 3;
      for (unsigned j = 1; j <= more; ++j) {
        polygon.push_back(glm::mix(corners[k], next, j / (more + 1.0)));
      }
    }
    if (polygon.size() == corners.size()) {
      polygon.insert(polygon.begin() + 1, glm::mix(corners[0], corners[1], 0.5));
    }
    std::rotate(polygon.begin(), polygon.begin() + i % static_cast<int>(polygon.size()), polygon.end());
    for (const double digits : {1e6, 1e15}) {
      std::vector<glm::dvec3> rounded;
      std::ranges::transform(polygon, std::back_inserter(rounded),
                             [&](const glm::dvec3& p) { return glm::round(p * digits) / digits; });
      EXPECT_GT(worstQuality(rounded), 1e-3) << i;
    }
  }
}

// Clips ears without keeping anything from one ear to the next. Slivers count only once there is no other ear.
std::vector<std::array<int, 3>> earsByTheRule(const std::vector<glm::dvec3>& points) {
  const glm::dvec3 normal = newellVector(points);
  const auto turn = [&](int a, int b, int c) {
    return glm::dot(normal, glm::cross(points[b] - points[a], points[c] - points[b]));
  };
  std::vector<int> left(points.size());
  std::iota(left.begin(), left.end(), 0);
  const auto squared = [&](int a, int b) { return glm::dot(points[b] - points[a], points[b] - points[a]); };
  double sliver = 1e-5 * glm::length(normal);
  const auto isEar = [&](int a, int b, int c) {
    const double least = sliver * std::max({squared(a, b), squared(b, c), squared(c, a)});
    return turn(a, b, c) > 0.0 && turn(a, b, c) >= least && std::ranges::none_of(left, [&](int p) {
             return points[p] != points[a] && points[p] != points[b] && points[p] != points[c] &&
                    turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= -sliver * squared(c, a);
           });
  };
  std::vector<std::array<int, 3>> triangles;
  while (left.size() >= 3) {
    const size_t n = left.size();
    std::optional<size_t> found;
    for (size_t k = n; k-- > 0;) {
      const size_t i = (k + 1) % n;
      found = isEar(left[(i + n - 1) % n], left[i], left[(i + 1) % n]) ? i : found;
    }
    if (!found && sliver > 0.0) {
      sliver = 0.0;
      continue;
    }
    const size_t ear = found.value_or(1);
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
