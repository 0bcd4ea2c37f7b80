#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "geometry/polygon.hpp"
#include "geometry/triangulate.hpp"
#include "scene_support.hpp"

namespace speculum {
namespace {

// Every triangle's area vector against the polygon's normal; their sum must be the polygon's.
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
  const std::vector<glm::dvec3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  EXPECT_EQ(triangulate(square), (std::vector<std::array<int, 3>>{{0, 1, 2}, {0, 2, 3}}));
  expectTiles(ring(300, [](int) { return 1.0; }));
}

TEST(Triangulate, ConcavePolygonsAreTiled) {
  expectTiles({{0, 0, 0}, {2, 0, 0}, {0.5, 0.5, 0}, {0, 2, 0}});
  expectTiles({{0.5, 0.5, 0}, {0, 2, 0}, {0, 0, 0}, {2, 0, 0}});
  expectTiles({{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {2, 3, 0}, {2, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}});
}

TEST(Triangulate, StarIsTiled) {
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

// The rule itself, without remembering anything from one ear to the next.
std::vector<std::array<int, 3>> earsByTheRule(const std::vector<glm::dvec3>& points) {
  const glm::dvec3 normal = newellVector(points);
  const auto turn = [&](int a, int b, int c) {
    return glm::dot(normal, glm::cross(points[b] - points[a], points[c] - points[b]));
  };
  std::vector<int> left(points.size());
  std::iota(left.begin(), left.end(), 0);
  const auto isEar = [&](int a, int b, int c) {
    return turn(a, b, c) > 0.0 && std::none_of(left.begin(), left.end(), [&](int p) {
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

TEST(Triangulate, FindsTheEarsOfTheRuleWhateverThePolygon) {
  std::mt19937 random(7);
  for (int count = 3; count < 60; ++count) {
    for (int kind = 0; kind < 4; ++kind) {
      std::vector<glm::dvec3> points;
      for (int i = 0; i < count; ++i) {
        const double angle = 2.0 * std::acos(-1.0) * i / count;
        const double radius = 1.0 + static_cast<double>(random() % 1000) / 300.0;
        // Simple ones, and ones that cross themselves, touch themselves and repeat vertices.
        points.push_back(kind == 0 ? radius * glm::dvec3(std::cos(angle), std::sin(angle), 0.1 * std::cos(angle))
                                   : glm::dvec3(random() % (2u << (3 * kind)), random() % (2u << (3 * kind)), 0));
      }
      ASSERT_EQ(triangulate(points), earsByTheRule(points)) << count << " vertices, kind " << kind;
    }
  }
}

class LoadObj : public testing::Test {
 protected:
  Mesh load(const std::string& text) { return loadObj(folder_.write("m.obj", text), textures_); }
  // The three corners of a triangle in model space.
  static std::array<glm::dvec3, 3> corners(const Mesh& mesh, size_t triangle) {
    std::array<glm::dvec3, 3> points;
    for (size_t i = 0; i < 3; ++i) {
      points[i] = mesh.center + mesh.vertices[mesh.indices[3 * triangle + i]].position;
    }
    return points;
  }

  TemporaryFolder folder_;
  std::vector<Texture> textures_;
  LogCapture log_;
};

TEST_F(LoadObj, TriangleWithoutNormalsIsFlat) {
  const Mesh mesh = load(kTriangleObj);
  EXPECT_EQ(mesh.indices, (std::vector<uint32_t>{0, 1, 2}));
  ASSERT_EQ(mesh.vertices.size(), 3u);
  for (const Vertex& vertex : mesh.vertices) {
    EXPECT_EQ(vertex.normal, glm::dvec3(0, 0, 1));
    EXPECT_EQ(vertex.uv, glm::dvec2(0.0));
  }
  EXPECT_EQ(mesh.source, folder_ / "m.obj");
  EXPECT_EQ(log_.text(), "");
}

TEST_F(LoadObj, IsRebasedToTheCentreOfItsBox) {
  const Mesh mesh = load("v 10000000.25 0 0\nv 10000001.25 0 0\nv 10000000.25 3 0\nf 1 2 3\n");
  EXPECT_EQ(mesh.center, glm::dvec3(10000000.75, 1.5, 0));
  EXPECT_EQ(mesh.halfExtent, glm::dvec3(0.5, 1.5, 0));
  EXPECT_NEAR(mesh.radius, std::sqrt(2.5), 1e-15);
  EXPECT_EQ(mesh.vertices[0].position, glm::dvec3(-0.5, -1.5, 0));
}

TEST_F(LoadObj, UnusedVerticesDoNotWidenTheBox) {
  const Mesh mesh = load(std::string("v 100 100 100\n") + "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 2 3 4\n");
  EXPECT_EQ(mesh.halfExtent, glm::dvec3(0.5, 0.5, 0));
}

TEST_F(LoadObj, NumbersAreTheNearestDoubles) {
  const Mesh mesh = load(
      "v 0.1234567890123456 0 0\nv -0.1234567890123456e0 0 0\nv +.5 1. -0\nvn 0 0 1\nvt 0.3 0.7\nf 1/1/1 2/1/1 "
      "3/1/1\n");
  EXPECT_EQ(corners(mesh, 0)[0].x, 0.1234567890123456);
  EXPECT_EQ(corners(mesh, 0)[1].x, -0.1234567890123456);
  EXPECT_EQ(corners(mesh, 0)[2].x, 0.5);
  EXPECT_EQ(mesh.vertices[0].uv, glm::dvec2(0.3, 0.7));
}

TEST_F(LoadObj, CornersAreSharedByIndexTriple) {
  const Mesh mesh = load(
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 2\n"
      "f 1/1/1 2/2/1 3/3/1 4/4/1\nf 1/2/1 2/2/1 3/3/1\n");
  EXPECT_EQ(mesh.indices.size(), 9u);
  EXPECT_EQ(mesh.vertices.size(), 5u) << "only the first corner of the second face differs";
  EXPECT_EQ(mesh.vertices[2].uv, glm::dvec2(1, 1));
  EXPECT_EQ(mesh.vertices[2].normal, glm::dvec3(0, 0, 1));
}

TEST_F(LoadObj, RelativeIndicesCountBackwards) {
  const Mesh mesh = load("v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvn 1 0 0\nvn 0 1 0\nf -3//-1 -2//-1 -1//-2\nv 5 5 5\n");
  EXPECT_EQ(corners(mesh, 0)[0], glm::dvec3(0, 0, 0));
  EXPECT_EQ(corners(mesh, 0)[2], glm::dvec3(0, 1, 0));
  EXPECT_EQ(mesh.vertices[0].normal, glm::dvec3(0, 1, 0));
  EXPECT_EQ(mesh.vertices[2].normal, glm::dvec3(1, 0, 0));
}

TEST_F(LoadObj, ConcavePolygonKeepsItsArea) {
  const Mesh mesh = load("v 0 0 0\nv 2 0 0\nv 0.5 0.5 0\nv 0 2 0\nf 1 2 3 4\n");
  ASSERT_EQ(mesh.indices.size(), 6u);
  EXPECT_NEAR(polygonArea(corners(mesh, 0)) + polygonArea(corners(mesh, 1)), 1.0, 1e-12);
}

TEST_F(LoadObj, LongPolygonsAreRead) {
  std::string text;
  std::string face = "f";
  for (int i = 0; i < 400; ++i) {
    const double angle = 2.0 * std::acos(-1.0) * i / 400;
    text += "v " + std::to_string(std::cos(angle)) + " " + std::to_string(std::sin(angle)) + " 0\n";
    face += " " + std::to_string(i + 1);
  }
  EXPECT_EQ(load(text + face + "\n").indices.size(), 3u * 398u);
}

TEST_F(LoadObj, BadNormalsAreReplacedByTheFacesOwn) {
  const Mesh mesh = load(
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 0\nvn nan 1 0\nvn 0 -1e-200 0\n"
      "f 1//1 2//2 3//3\n");
  EXPECT_EQ(mesh.vertices[0].normal, glm::dvec3(0, 0, 1));
  EXPECT_EQ(mesh.vertices[1].normal, glm::dvec3(0, 0, 1));
  EXPECT_EQ(mesh.vertices[2].normal, glm::dvec3(0, -1, 0)) << "short is not zero";
}

TEST_F(LoadObj, FacesWithNonFiniteVerticesAreDropped) {
  const Mesh mesh = load(
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv nan 0 0\nv 0 inf 0\nv 0 0 1e999\nvt nan 0\n"
      "f 1 2 3\nf 1 2 4\nf 1 2 5\nf 1 2 6 3\nf 1/1 2/1 3/1\n");
  EXPECT_EQ(mesh.indices.size(), 3u);
  EXPECT_EQ(log_.text(),
            "warning: " + (folder_ / "m.obj").string() + ": dropped 4 faces with vertices that are not finite\n");
}

TEST_F(LoadObj, UnderflowIsZeroNotAnError) {
  EXPECT_EQ(load("v 1e-999 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").indices.size(), 3u);
  EXPECT_EQ(log_.text(), "");
}

TEST_F(LoadObj, DegenerateTrianglesAreDropped) {
  const Mesh mesh = load("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nv 0.5 0.9e-10 0\nf 1 2 3\nf 1 2 4\nf 1 1 2\nf 1 2 5\n");
  EXPECT_EQ(mesh.indices.size(), 3u);
  EXPECT_EQ(log_.text(), "warning: " + (folder_ / "m.obj").string() + ": dropped 3 degenerate triangles\n");
}

TEST_F(LoadObj, SliversAreKeptWithAWarning) {
  const Mesh mesh =
      load("v 0 0 0\nv 1 0 0\nv 0.5 1.1e-10 0\nv 0.5 0.9e-5 0\nv 0.5 1.1e-5 0\nf 1 2 3\nf 1 2 4\nf 1 2 5\n");
  EXPECT_EQ(mesh.indices.size(), 9u);
  EXPECT_NE(log_.text().find("2 triangles are slivers"), std::string::npos) << log_.text();
}

TEST_F(LoadObj, QualityDoesNotDependOnSize) {
  for (const char* unit : {"1e-170", "1e-20", "1e13", "1e170"}) {
    const std::string u(unit);
    const Mesh mesh = load("v 0 0 0\nv " + u + " 0 0\nv 0 " + u + " 0\nf 1 2 3\n");
    EXPECT_EQ(mesh.indices.size(), 3u) << unit;
    EXPECT_EQ(mesh.vertices[0].normal, glm::dvec3(0, 0, 1)) << unit;
  }
  EXPECT_EQ(log_.text(), "");
}

}  // namespace
}  // namespace speculum
