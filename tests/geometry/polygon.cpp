#include "geometry/polygon.hpp"
#include "geometry/affine.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

const Polygon unitSquare = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

TEST(Polygon, NewellVectorIsTwiceTheArea) {
  EXPECT_EQ(newellVector(unitSquare), glm::dvec3(0, 0, 2));
  EXPECT_DOUBLE_EQ(polygonArea(unitSquare), 1.0);
}

TEST(Polygon, NewellVectorIsExactFarOut) {
  Polygon moved = unitSquare;
  for (glm::dvec3& p : moved) {
    p += glm::dvec3(1e7, -1e7, 1e7);
  }
  EXPECT_EQ(newellVector(moved), glm::dvec3(0, 0, 2));
}

TEST(Polygon, DefectsAreNamed) {
  EXPECT_FALSE(polygonDefect(unitSquare));
  EXPECT_EQ(polygonDefect(Polygon{{0, 0, 0}, {1, 0, 0}}), "has fewer than 3 vertices");
  EXPECT_EQ(polygonDefect(Polygon{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}), "has no area");
  EXPECT_EQ(polygonDefect(Polygon{{0, 0, 0}, {1, 0, 0}, {2, 1e-9, 0}}), "has no area");
  EXPECT_EQ(polygonDefect(Polygon{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}), "has no area");
  EXPECT_EQ(polygonDefect(Polygon{{0, 0, 0}, {1, 0, 0}, {1, 1, 0.01}, {0, 1, 0}}), "is not planar");
  EXPECT_EQ(polygonDefect(Polygon{{0, 0, 0}, {2, 0, 0}, {0.5, 0.5, 0}, {0, 2, 0}}), "is not convex");
  EXPECT_EQ(polygonDefect(Polygon{{0, 0, 0}, {NAN, 0, 0}, {1, 1, 0}}), "has a vertex that is not finite");
}

TEST(Polygon, PentagramIsNotConvex) {
  Polygon star;
  for (int i = 0; i < 5; ++i) {
    const double angle = 4.0 * 3.14159265358979 * i / 5.0;
    star.emplace_back(std::cos(angle), std::sin(angle), 0.0);
  }
  EXPECT_EQ(polygonDefect(star), "is not convex");
}

// A square whose upper side is an arc of `edges` edges that bulges by `height` in its middle.
Polygon squareWithArc(int edges, double height) {
  const double r = height == 0.0 ? 0.0 : (0.25 + height * height) / (2.0 * height);
  Polygon polygon{{0, 0, 0}, {1, 0, 0}};
  for (int i = 0; i <= edges; ++i) {
    const double x = 0.5 - static_cast<double>(i) / edges;
    const double y =
        r == 0.0 ? 0.0 : height - x * x / (std::abs(r) + std::sqrt(r * r - x * x)) * (r < 0.0 ? -1.0 : 1.0);
    polygon.emplace_back(0.5 + x, 1.0 + y, 0.0);
  }
  const glm::dmat3 turn = rotationFromDegrees({10, 20, 30});
  for (glm::dvec3& p : polygon) {
    p = turn * p + glm::dvec3(100, 200, 300);
  }
  return polygon;
}

TEST(Polygon, HollowsAreFoundHoweverFinelyCut) {
  for (const int edges : {2, 10, 100, 400, 998}) {
    for (const double depth : {1e-4, 1e-3, 0.01, 0.1, 0.4}) {
      EXPECT_EQ(polygonDefect(squareWithArc(edges, -depth)), "is not convex") << edges << " edges, " << depth;
      EXPECT_FALSE(polygonDefect(squareWithArc(edges, depth))) << edges << " edges, " << depth;
    }
    EXPECT_FALSE(polygonDefect(squareWithArc(edges, 0.0))) << edges << " edges, straight";
  }
}

TEST(Polygon, ClippingKeepsThePositiveSide) {
  EXPECT_NEAR(polygonArea(clipPolygon(unitSquare, Plane{{0.25, 0, 0}, {1, 0, 0}})), 0.75, 1e-15);
  EXPECT_TRUE(clipPolygon(unitSquare, Plane{{2, 0, 0}, {1, 0, 0}}).empty());
  EXPECT_EQ(clipPolygon(unitSquare, Plane{{-1, 0, 0}, {1, 0, 0}}), unitSquare);
}

TEST(Affine, NormalMatrixKeepsTheOutsideUnderMirroring) {
  const glm::dmat3 mirrored(-1, 0, 0, 0, 1, 0, 0, 0, 1);
  EXPECT_GT((normalMatrix(mirrored) * glm::dvec3(0, 1, 0)).y, 0.0);
  EXPECT_LT((normalMatrix(mirrored) * glm::dvec3(1, 0, 0)).x, 0.0);
}

TEST(Affine, WholeTurnsAreExact) {
  EXPECT_EQ(rotationFromDegrees({0, 360.0 * 1e9, 0}), rotationFromDegrees({0, 0, 0}));
}

}  // namespace
}  // namespace speculum
