#include "geometry/convex_mesh.hpp"
#include "systems/triangles.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

std::vector<glm::dvec3> pointsOf(const Triangles& body, size_t mostTriangles = 1000) {
  return convexMesh(body.positions, body.indices, mostTriangles).points;
}

Triangles box(const glm::dvec3& low = glm::dvec3(-1.0), const glm::dvec3& high = glm::dvec3(1.0)) {
  Triangles body;
  body.box(low, high);
  return body;
}

// A body of revolution about y with a vertex at either end; `radius` at a height.
Triangles turned(int rings, int sides, double (*radius)(double)) {
  const auto p = [&](int ring, int side) {
    const double y = -1.0 + 2.0 * ring / rings;
    const double angle = 2.0 * std::acos(-1.0) * (side % sides) / sides;
    const double r = ring == 0 || ring == rings ? 0.0 : radius(y);
    return glm::dvec3(r * std::cos(angle), y, r * std::sin(angle));
  };
  Triangles body;
  for (int ring = 0; ring < rings; ++ring) {
    for (int side = 0; side < sides; ++side) {
      if (ring + 1 < rings) {
        body.triangle(p(ring, side), p(ring + 1, side), p(ring + 1, side + 1));
      }
      if (ring > 0) {
        body.triangle(p(ring, side), p(ring + 1, side + 1), p(ring, side + 1));
      }
    }
  }
  return body;
}

TEST(ConvexMesh, BoxesAndBallsGiveEachPointOnce) {
  EXPECT_EQ(pointsOf(box({-1, -2, -3}, {4, 5, 6})).size(), 8u);
  EXPECT_EQ(pointsOf(turned(8, 12, [](double y) { return std::sqrt(1.0 - y * y); })).size(), 2u + 7u * 12u);
}

TEST(ConvexMesh, WindingDoesNotMatter) {
  Triangles body = box();
  for (size_t i = 0; i < body.indices.size(); i += 6) {
    std::swap(body.indices[i], body.indices[i + 1]);
  }
  EXPECT_EQ(pointsOf(body).size(), 8u);
}

TEST(ConvexMesh, RefusesHollowsOpeningsAndSecondBodies) {
  EXPECT_TRUE(pointsOf(turned(8, 12, [](double y) { return 0.3 + y * y; })).empty()) << "a waist";
  Triangles open = box();
  open.indices.resize(open.indices.size() - 6);
  EXPECT_TRUE(pointsOf(open).empty()) << "a box without a side";
  Triangles tube = box();
  tube.indices.erase(tube.indices.begin(), tube.indices.begin() + 12);
  EXPECT_TRUE(pointsOf(tube).empty()) << "open at both ends";
  Triangles two = box();
  two.box({3, -1, -1}, {4, 1, 1});
  EXPECT_TRUE(pointsOf(two).empty()) << "two boxes";
}

// A sheet cut along one diagonal in front and along the other behind, so that each edge has two triangles.
void addSheet(Triangles& body, double z) {
  body.quad({-1, -1, z}, {1, -1, z}, {1, 1, z}, {-1, 1, z});
  body.quad({-1, 1, z}, {1, 1, z}, {1, -1, z}, {-1, -1, z});
  std::rotate(body.positions.end() - 4, body.positions.end() - 3, body.positions.end());
}

TEST(ConvexMesh, SheetsWithTwoSidesEncloseNothing) {
  Triangles sheet;
  addSheet(sheet, 0.0);
  EXPECT_TRUE(pointsOf(sheet).empty());
}

TEST(ConvexMesh, BodiesOfAnySizeAreJudgedAlike) {
  for (const double size : {1e-100, 1e-85, 1.0, 1e100, 1e200}) {
    Triangles waist = turned(8, 12, [](double y) { return 0.3 + y * y; });
    Triangles block = box();
    for (Triangles* body : {&waist, &block}) {
      for (glm::dvec3& p : body->positions) {
        p *= size;
      }
    }
    EXPECT_TRUE(pointsOf(waist).empty()) << size;
    EXPECT_EQ(pointsOf(block).size(), 8u) << size;
  }
}

TEST(ConvexMesh, DentsPassWithinTheTolerance) {
  for (const double part : {0.5, 2.0}) {
    // The middle of one side of a box, pushed in.
    Triangles body = box();
    body.indices.erase(body.indices.begin(), body.indices.begin() + 6);
    const auto middle = static_cast<uint32_t>(body.positions.size());
    body.positions.emplace_back(0, 0, 1.0 - part * convexTolerance * 2.0);
    for (uint32_t i = 0; i < 4; ++i) {
      body.indices.insert(body.indices.end(), {i, (i + 1) % 4, middle});
    }
    EXPECT_EQ(pointsOf(body).empty(), part > 1.0) << part;
  }
}

TEST(ConvexMesh, RefusesNothingAndTooManyTriangles) {
  EXPECT_TRUE(pointsOf({}).empty());
  EXPECT_TRUE(pointsOf(box(), 11).empty());
  EXPECT_FALSE(pointsOf(box(), 12).empty());
}

}  // namespace
}  // namespace speculum
