
#include "geometry/polygon.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

// Expects triangles that are wound like the polygon and whose areas add up to the polygon's. Where each edge of a
// triangle is one of the outline or runs against one of another triangle, this says too that none overlap: as many
// triangles lie over a point as the outline goes around it.
void expectTiles(const std::vector<glm::dvec3>& polygon, double tolerance = 1e-12) {
  const auto triangles = triangulate(polygon);
  ASSERT_EQ(triangles.size(), polygon.size() - 2);
  std::map<std::pair<int, int>, int> open;
  const auto add = [&](int from, int to, int sign) { open[std::minmax(from, to)] += from < to ? sign : -sign; };
  for (int i = 0; i < static_cast<int>(polygon.size()); ++i) {
    add(i, (i + 1) % static_cast<int>(polygon.size()), -1);
  }
  const glm::dvec3 whole = newellVector(polygon);
  double sum = 0.0;
  for (const auto& [a, b, c] : triangles) {
    const std::array<glm::dvec3, 3> corners{polygon[a], polygon[b], polygon[c]};
    const double part = glm::dot(newellVector(corners), whole) / glm::dot(whole, whole);
    EXPECT_GE(part, -tolerance) << "turned over";
    sum += part;
    add(a, b, 1);
    add(b, c, 1);
    add(c, a, 1);
  }
  EXPECT_NEAR(sum, 1.0, 1e-12);
  EXPECT_TRUE(std::ranges::all_of(open, [](const auto& edge) { return edge.second == 0; })) << "edges left open";
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

// Clips ears without keeping anything from one ear to the next. Spikes go first. Slivers count only once there is no
// other ear.
std::vector<std::array<int, 3>> earsByTheRule(const std::vector<glm::dvec3>& points) {
  const glm::dvec3 normal = newellVector(points);
  const auto area = [&](const glm::dvec3& u, const glm::dvec3& v) { return glm::dot(normal, glm::cross(u, v)); };
  const auto turn = [&](int a, int b, int c) { return area(points[b] - points[a], points[c] - points[b]); };
  std::vector<int> left(points.size());
  std::iota(left.begin(), left.end(), 0);
  const auto squared = [&](int a, int b) { return glm::dot(points[b] - points[a], points[b] - points[a]); };
  const auto longest = [&](int a, int b, int c) { return std::max({squared(a, b), squared(b, c), squared(c, a)}); };
  double sliver = 1e-5 * glm::length(normal);
  const auto at = [&](size_t i) { return left[i % left.size()]; };
  const auto isEar = [&](int a, int b, int c) {
    const double least = sliver * longest(a, b, c);
    const auto entersAt = [&](int p, int neighbor, int from, int corner, int to) {
      const glm::dvec3 edge = points[neighbor] - points[p];
      const double narrow = sliver * std::max(squared(corner, to), glm::dot(edge, edge));
      const double narrowToo = sliver * std::max(squared(corner, from), glm::dot(edge, edge));
      return points[p] == points[corner] && area(points[to] - points[corner], edge) > narrow &&
             area(edge, points[from] - points[corner]) > narrowToo;
    };
    for (size_t i = 0; i < left.size(); ++i) {
      const int p = left[i];
      if (p == a || p == b || p == c) {
        continue;
      }
      if (points[p] == points[a] || points[p] == points[b] || points[p] == points[c]) {
        for (const int q : {at(i + left.size() - 1), at(i + 1)}) {
          if (entersAt(p, q, c, a, b) || entersAt(p, q, a, b, c) || entersAt(p, q, b, c, a)) {
            return false;
          }
        }
      } else if (turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= -sliver * squared(c, a)) {
        return false;
      }
    }
    return turn(a, b, c) > 0.0 && turn(a, b, c) >= least;
  };
  const auto isSpike = [&](int a, int b, int c) {
    return points[b] == points[c] || (glm::dot(points[b] - points[a], points[c] - points[b]) < 0.0 &&
                                      std::abs(turn(a, b, c)) <= 1e-5 * glm::length(normal) * longest(a, b, c));
  };
  const auto find = [&](size_t first, const auto& test) {
    for (size_t k = 0; k < left.size(); ++k) {
      const size_t i = (first + k) % left.size();
      if (test(at(i + left.size() - 1), left[i], at(i + 1))) {
        return std::optional(i);
      }
    }
    return std::optional<size_t>();
  };
  std::vector<std::array<int, 3>> triangles;
  while (left.size() >= 3) {
    std::optional<size_t> ear = find(0, isSpike);
    ear = ear ? ear : find(1, isEar);
    if (!ear && sliver > 0.0) {
      sliver = 0.0;
      continue;
    }
    ear = ear ? ear : 1;
    triangles.push_back({at(*ear + left.size() - 1), left[*ear], at(*ear + 1)});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(*ear));
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

using Outline = std::vector<glm::dvec2>;

// Returns the outline with the hole in it, by a bridge to and from the corners that are nearest to each other.
Outline withHole(const Outline& outline, const Outline& hole) {
  size_t from = 0;
  size_t to = 0;
  for (size_t i = 0; i < outline.size(); ++i) {
    for (size_t j = 0; j < hole.size(); ++j) {
      if (glm::distance(outline[i], hole[j]) < glm::distance(outline[from], hole[to])) {
        from = i;
        to = j;
      }
    }
  }
  Outline joined(outline.begin(), outline.begin() + static_cast<std::ptrdiff_t>(from) + 1);
  for (size_t j = 0; j <= hole.size(); ++j) {
    joined.push_back(hole[(to + j) % hole.size()]);
  }
  joined.insert(joined.end(), outline.begin() + static_cast<std::ptrdiff_t>(from), outline.end());
  return joined;
}

// Returns a diamond, clockwise.
Outline diamond(const glm::dvec2& center, double radius) {
  return {center + radius * glm::dvec2(-1, 0), center + radius * glm::dvec2(0, 1), center + radius * glm::dvec2(1, 0),
          center + radius * glm::dvec2(0, -1)};
}

enum class OutlineKind { comb, spikes, petals, keyholes, aligned, spiral };

// Returns an outline that nowhere crosses itself, counterclockwise: it touches itself, repeats corners, or runs back
// along its own edges.
Outline generatedOutline(OutlineKind kind, std::mt19937& random) {
  std::uniform_real_distribution<double> part(0.1, 0.9);
  const int count = 2 + static_cast<int>(random() % 4);
  const auto at = [](double radius, double angle) { return radius * glm::dvec2(std::cos(angle), std::sin(angle)); };
  Outline outline{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  switch (kind) {
    case OutlineKind::comb:
      outline = {{0, 0}, {count, 0}};
      for (int i = count; i > 0; --i) {
        const double height = i % 2 == 0 ? 2.0 + part(random) : part(random);
        outline.emplace_back(i, height);
        outline.emplace_back(i - 1, height);
      }
      for (int i = static_cast<int>(outline.size()); i-- > 0;) {
        outline.insert(outline.begin() + i, random() % 3, outline[i]);
      }
      break;
    case OutlineKind::spikes:
      for (int i = 4; i-- > 0;) {
        const glm::dvec2 base = glm::mix(outline[i], outline[(i + 1) % 4], part(random));
        const glm::dvec2 tip = base * (random() % 2 == 0 ? 1.5 : 0.4);
        const std::vector<glm::dvec2> there{base, glm::mix(base, tip, 0.5), tip, base};
        outline.insert(outline.begin() + i + 1, there.begin(), there.end());
      }
      break;
    case OutlineKind::petals:
      outline.clear();
      for (int i = 0; i <= count; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / (count + 1);
        const double width = std::numbers::pi / (count + 1) * part(random);
        outline.insert(outline.end(), {{0, 0}, at(1, angle - width), at(0.8, angle), at(part(random), angle + width)});
      }
      break;
    case OutlineKind::keyholes:
      for (int i = 0; i < count && i < 4; ++i) {
        outline = withHole(outline, diamond({i % 2 - 0.5, i / 2 - 0.5}, 0.45 * part(random)));
      }
      break;
    case OutlineKind::aligned:  // the bridges lie on a line, from hole to hole
      outline.insert(outline.begin() + 4, {-1, 0});
      for (int i = 0; i < count; ++i) {
        outline = withHole(outline, diamond({-1.0 + (2.0 * i + 1.0) / count, 0}, 0.5 / count));
      }
      break;
    case OutlineKind::spiral:
      outline.clear();
      for (int i = 0; i <= 4 * count; ++i) {
        outline.push_back(at(0.9 * (0.2 + i / (4.0 * count)), 0.7 * i));
        outline.insert(outline.begin(), at(0.2 + i / (4.0 * count), 0.7 * i));
      }
      std::ranges::reverse(outline);
      break;
  }
  return outline;
}

// In two planes, rounded as files round or not, from each corner on, both ways around.
TEST(Triangulate, OutlinesThatTouchThemselvesAreTiled) {
  using enum OutlineKind;
  std::mt19937 random(5);
  for (const OutlineKind kind : {comb, spikes, petals, keyholes, aligned, spiral}) {
    for (int member = 0; member < 40; ++member) {
      const Outline outline = generatedOutline(kind, random);
      std::vector<glm::dvec3> polygon;
      for (const glm::dvec2& p : outline) {
        const glm::dvec3 slanted = p.x * glm::dvec3(0.6, 0.8, 0.0) + p.y * glm::dvec3(-0.48, 0.36, 0.8);
        polygon.push_back(member % 4 == 0   ? glm::dvec3(p, 0.0)
                          : member % 4 == 1 ? slanted
                                            : glm::round(slanted * 1e6) / 1e6);
      }
      if (member % 2 == 1) {
        std::ranges::reverse(polygon);
      }
      for (size_t first = 0; first < polygon.size() && !::testing::Test::HasFailure(); ++first) {
        SCOPED_TRACE(testing::Message() << "kind " << static_cast<int>(kind) << ", member " << member << ", first "
                                        << first);
        std::rotate(polygon.begin(), polygon.begin() + 1, polygon.end());
        expectTiles(polygon, 1e-5);
      }
    }
  }
}

}  // namespace
}  // namespace speculum
