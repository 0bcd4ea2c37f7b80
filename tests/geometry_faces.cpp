#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <numeric>

#include "geometry/convex_faces.hpp"
#include "geometry/polygon.hpp"

namespace speculum {
namespace {

struct Triangles {
  std::vector<glm::dvec3> positions;
  std::vector<uint32_t> indices;

  void quad(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
    const auto first = static_cast<uint32_t>(positions.size());
    positions.insert(positions.end(), {a, b, c, d});
    for (const uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) {
      indices.push_back(first + i);
    }
  }
  std::vector<std::vector<glm::dvec3>> faces(size_t most = 32, size_t mostTriangles = 1000) const {
    return convexFaces(positions, indices, most, mostTriangles);
  }
};

Triangles box() {
  const auto p = [](int i) { return glm::dvec3(i & 1 ? 2 : -2, i & 2 ? 1 : -1, i & 4 ? 0.1 : -0.1); };
  Triangles t;
  t.quad(p(4), p(5), p(7), p(6));
  t.quad(p(1), p(0), p(2), p(3));
  t.quad(p(0), p(4), p(6), p(2));
  t.quad(p(5), p(1), p(3), p(7));
  t.quad(p(6), p(7), p(3), p(2));
  t.quad(p(0), p(1), p(5), p(4));
  return t;
}

// Squares of one metre where `filled` says so.
template <typename Filled>
Triangles tiles(int side, const Filled& filled) {
  Triangles t;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      if (filled(x, y)) {
        t.quad({x, y, 0}, {x + 1, y, 0}, {x + 1, y + 1, 0}, {x, y + 1, 0});
      }
    }
  }
  return t;
}

double totalArea(const std::vector<std::vector<glm::dvec3>>& faces) {
  return std::accumulate(faces.begin(), faces.end(), 0.0,
                         [](double sum, const auto& face) { return sum + polygonArea(face); });
}

TEST(ConvexFaces, BoxHasSixTheLargestFirst) {
  const auto faces = box().faces();
  ASSERT_EQ(faces.size(), 6u);
  EXPECT_DOUBLE_EQ(polygonArea(faces[0]), 8.0);
  EXPECT_DOUBLE_EQ(polygonArea(faces[1]), 8.0);
  EXPECT_DOUBLE_EQ(totalArea(faces), 2 * 8.0 + 2 * 0.8 + 2 * 0.4);
  EXPECT_GT(newellVector(faces[0]).z * faces[0][0].z, 0.0) << "counter-clockwise from outside";
}

TEST(ConvexFaces, SubdividedWallIsOneFace) {
  const auto faces = tiles(5, [](int, int) { return true; }).faces();
  ASSERT_EQ(faces.size(), 1u);
  EXPECT_NEAR(polygonArea(faces[0]), 25.0, 1e-12);
  EXPECT_FALSE(polygonDefect(faces[0]));
}

TEST(ConvexFaces, WallWithAWindowFallsIntoPartsThatLeaveItOpen) {
  const auto faces = tiles(5, [](int x, int y) { return x != 2 || y != 2; }).faces();
  EXPECT_GT(faces.size(), 1u);
  EXPECT_NEAR(totalArea(faces), 24.0, 1e-12);
  for (const auto& face : faces) {
    EXPECT_FALSE(polygonDefect(face));
    bool holdsWindow = true;
    for (size_t i = 0; i < face.size(); ++i) {
      const glm::dvec3 edge = face[(i + 1) % face.size()] - face[i];
      holdsWindow = holdsWindow && glm::cross(edge, glm::dvec3(2.5, 2.5, 0) - face[i]).z > 0.0;
    }
    EXPECT_FALSE(holdsWindow);
  }
}

TEST(ConvexFaces, BentAndBackToBackAreNotJoined) {
  Triangles bent;
  bent.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  bent.quad({1, 0, 0}, {2, 0, 0.01}, {2, 1, 0.01}, {1, 1, 0});
  EXPECT_EQ(bent.faces().size(), 2u);
  Triangles folded;
  folded.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  folded.quad({0, 1, 0}, {1, 1, 0}, {1, 0, 0}, {0, 0, 0});
  EXPECT_EQ(folded.faces().size(), 2u);
}

TEST(ConvexFaces, ACrackOfOneBitKeepsFacesApart) {
  Triangles t;
  t.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  const double next = std::nextafter(1.0, 2.0);
  t.quad({next, 0, 0}, {2, 0, 0}, {2, 1, 0}, {next, 1, 0});
  EXPECT_EQ(t.faces().size(), 2u);
}

TEST(ConvexFaces, LargeDiscsAreJoinedQuickly) {
  constexpr int sides = 2048;
  Triangles disc;
  for (int i = 0; i < sides; ++i) {
    const double angle = glm::radians(360.0) * i / sides;
    disc.positions.emplace_back(0.6 * std::cos(angle), std::sin(angle), 0.8 * std::cos(angle));
  }
  for (uint32_t i = 1; i + 1 < sides; ++i) {
    disc.indices.insert(disc.indices.end(), {0, i, i + 1});
  }
  const auto start = std::chrono::steady_clock::now();
  const auto faces = disc.faces(32, 4096);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(1)) << "in cubic time it takes ten";
  ASSERT_EQ(faces.size(), 1u);
  EXPECT_EQ(faces[0].size(), size_t{sides});
}

TEST(ConvexFaces, LimitsAreKept) {
  EXPECT_EQ(box().faces(2).size(), 2u);
  EXPECT_TRUE(box().faces(32, 11).empty());
  EXPECT_TRUE(Triangles().faces().empty());
}

}  // namespace
}  // namespace speculum
