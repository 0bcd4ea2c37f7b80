#include <cmath>
#include <ctime>
#include <numbers>

#include "geometry/convex_mesh.hpp"
#include "geometry/polygon.hpp"
#include "systems/triangles.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

std::vector<std::vector<glm::dvec3>> facesOf(const Triangles& triangles, size_t most = 32,
                                             size_t mostTriangles = 1000) {
  return convexFaces(triangles.positions, triangles.indices, most, mostTriangles);
}

Triangles slab() {
  Triangles t;
  t.box({-2, -1, -0.1}, {2, 1, 0.1});
  return t;
}

// Squares of one metre where `filled` is true.
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
  const auto faces = facesOf(slab());
  ASSERT_EQ(faces.size(), 6u);
  EXPECT_DOUBLE_EQ(polygonArea(faces[0]), 8.0);
  EXPECT_DOUBLE_EQ(polygonArea(faces[1]), 8.0);
  EXPECT_DOUBLE_EQ(totalArea(faces), 2 * 8.0 + 2 * 0.8 + 2 * 0.4);
  EXPECT_GT(newellVector(faces[0]).z * faces[0][0].z, 0.0) << "counter-clockwise from outside";
}

TEST(ConvexFace, LiesWithinItsSphereAndItsWidth) {
  for (const int corners : {3, 4, 7, 64, 200}) {
    for (const double flat : {1.0, 0.1, 0.01}) {
      std::vector<glm::dvec3> ellipse;
      for (int i = 0; i < corners; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / corners;
        ellipse.emplace_back(5.0, std::cos(angle), flat * std::sin(angle));
      }
      const ConvexFace face(ellipse);
      EXPECT_DOUBLE_EQ(farthestDistance(face.center, ellipse), face.radius);
      double least = INFINITY;
      for (int step = 0; step < 20000; ++step) {
        const double angle = std::numbers::pi * step / 20000;
        const glm::dvec3 across(0.0, std::cos(angle), std::sin(angle));
        const auto at = [&](const glm::dvec3& p) { return glm::dot(across, p); };
        std::vector<double> along;
        std::ranges::transform(ellipse, std::back_inserter(along), at);
        least = std::min(least, std::ranges::max(along) - std::ranges::min(along));
      }
      EXPECT_GT(face.width, 0.95 * least) << corners << ", " << flat;
      EXPECT_LT(face.width, 1.05 * least) << corners << ", " << flat;
    }
  }
}

TEST(ConvexFaces, SubdividedWallIsOneFace) {
  const auto faces = facesOf(tiles(5, [](int, int) { return true; }));
  ASSERT_EQ(faces.size(), 1u);
  EXPECT_NEAR(polygonArea(faces[0]), 25.0, 1e-12);
  EXPECT_FALSE(polygonDefect(faces[0]));
}

TEST(ConvexFaces, FacesLeaveAWindowOpen) {
  const auto faces = facesOf(tiles(5, [](int x, int y) { return x != 2 || y != 2; }));
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

TEST(ConvexFaces, BentAndOpposedFacesStayApart) {
  Triangles bent;
  bent.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  bent.quad({1, 0, 0}, {2, 0, 0.01}, {2, 1, 0.01}, {1, 1, 0});
  EXPECT_EQ(facesOf(bent).size(), 2u);
  Triangles folded;
  folded.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  folded.quad({0, 1, 0}, {1, 1, 0}, {1, 0, 0}, {0, 0, 0});
  EXPECT_EQ(facesOf(folded).size(), 2u);
}

TEST(ConvexFaces, CracksOfOneBitSeparateFaces) {
  Triangles t;
  t.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  const double next = std::nextafter(1.0, 2.0);
  t.quad({next, 0, 0}, {2, 0, 0}, {2, 1, 0}, {next, 1, 0});
  EXPECT_EQ(facesOf(t).size(), 2u);
}

TEST(ConvexFaces, LargeDiscsAreJoinedQuickly) {
  constexpr int sides = 16384;
  Triangles disc;
  for (int i = 0; i < sides; ++i) {
    const double angle = glm::radians(360.0) * i / sides;
    disc.positions.emplace_back(0.6 * std::cos(angle), std::sin(angle), 0.8 * std::cos(angle));
  }
  for (uint32_t i = 1; i + 1 < sides; ++i) {
    disc.indices.insert(disc.indices.end(), {0, i, i + 1});
  }
  const std::clock_t start = std::clock();
  const auto faces = facesOf(disc, 32, sides);
  EXPECT_LT(std::clock() - start, 1 * CLOCKS_PER_SEC) << "in quadratic time it takes several seconds";
  ASSERT_EQ(faces.size(), 1u);
  EXPECT_EQ(faces[0].size(), size_t{sides});
}

TEST(ConvexFaces, LimitsAreKept) {
  EXPECT_EQ(facesOf(slab(), 2).size(), 2u);
  EXPECT_TRUE(facesOf(slab(), 32, 11).empty());
  EXPECT_TRUE(facesOf({}).empty());
}

}  // namespace
}  // namespace speculum
