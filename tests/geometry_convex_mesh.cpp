#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/convex_mesh.hpp"

namespace speculum {
namespace {

struct Body {
  std::vector<glm::dvec3> positions;
  std::vector<uint32_t> indices;

  std::vector<glm::dvec3> vertices(size_t mostTriangles = 1000) const {
    return convexMesh(positions, indices, mostTriangles).points;
  }
  // Two triangles of four vertices of their own.
  void quad(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
    const auto first = static_cast<uint32_t>(positions.size());
    positions.insert(positions.end(), {a, b, c, d});
    for (const uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) {
      indices.push_back(first + i);
    }
  }
};

Body box(const glm::dvec3& low, const glm::dvec3& high) {
  const auto p = [&](int i) {
    return glm::dvec3(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
  };
  Body body;
  body.quad(p(4), p(5), p(7), p(6));
  body.quad(p(1), p(0), p(2), p(3));
  body.quad(p(0), p(4), p(6), p(2));
  body.quad(p(5), p(1), p(3), p(7));
  body.quad(p(6), p(7), p(3), p(2));
  body.quad(p(0), p(1), p(5), p(4));
  return body;
}

// Of revolution about y; `radius` of ring i, with a vertex at either end.
Body turned(int rings, int sides, double (*radius)(double)) {
  const auto p = [&](int ring, int side) {
    const double y = -1.0 + 2.0 * ring / rings;
    const double angle = 2.0 * std::acos(-1.0) * (side % sides) / sides;
    const double r = ring == 0 || ring == rings ? 0.0 : radius(y);
    return glm::dvec3(r * std::cos(angle), y, r * std::sin(angle));
  };
  Body body;
  for (int ring = 0; ring < rings; ++ring) {
    for (int side = 0; side < sides; ++side) {
      const auto first = static_cast<uint32_t>(body.positions.size());
      body.positions.insert(body.positions.end(),
                            {p(ring, side), p(ring + 1, side), p(ring + 1, side + 1), p(ring, side + 1)});
      if (ring + 1 < rings) {
        body.indices.insert(body.indices.end(), {first, first + 1, first + 2});
      }
      if (ring > 0) {
        body.indices.insert(body.indices.end(), {first, first + 2, first + 3});
      }
    }
  }
  return body;
}

TEST(ConvexMesh, BoxesAndBallsAreItsVerticesEachOnce) {
  EXPECT_EQ(box({-1, -2, -3}, {4, 5, 6}).vertices().size(), 8u);
  EXPECT_EQ(turned(8, 12, [](double y) { return std::sqrt(1.0 - y * y); }).vertices().size(), 2u + 7u * 12u);
}

TEST(ConvexMesh, TheWindingDoesNotMatter) {
  Body body = box({-1, -1, -1}, {1, 1, 1});
  for (size_t i = 0; i < body.indices.size(); i += 6) {
    std::swap(body.indices[i], body.indices[i + 1]);
  }
  EXPECT_EQ(body.vertices().size(), 8u);
}

TEST(ConvexMesh, HollowsOpeningsAndSecondBodiesMakeItNone) {
  EXPECT_TRUE(turned(8, 12, [](double y) { return 0.3 + y * y; }).vertices().empty()) << "a waist";
  Body open = box({-1, -1, -1}, {1, 1, 1});
  open.indices.resize(open.indices.size() - 6);
  EXPECT_TRUE(open.vertices().empty()) << "a box without a side";
  Body tube = box({-1, -1, -1}, {1, 1, 1});
  tube.indices.erase(tube.indices.begin(), tube.indices.begin() + 12);
  EXPECT_TRUE(tube.vertices().empty()) << "open at both ends";
  Body two = box({-1, -1, -1}, {1, 1, 1});
  const Body other = box({3, -1, -1}, {4, 1, 1});
  for (const uint32_t i : other.indices) {
    two.indices.push_back(i + static_cast<uint32_t>(two.positions.size()));
  }
  two.positions.insert(two.positions.end(), other.positions.begin(), other.positions.end());
  EXPECT_TRUE(two.vertices().empty()) << "two boxes";
}

// Cut along one diagonal in front and along the other behind, so that each edge has two triangles.
void addSheet(Body& body, double z) {
  body.quad({-1, -1, z}, {1, -1, z}, {1, 1, z}, {-1, 1, z});
  body.quad({-1, 1, z}, {1, 1, z}, {1, -1, z}, {-1, -1, z});
  std::rotate(body.positions.end() - 4, body.positions.end() - 3, body.positions.end());
}

TEST(ConvexMesh, SheetsWithTwoSidesEncloseNothing) {
  Body sheet;
  addSheet(sheet, 0.0);
  EXPECT_TRUE(sheet.vertices().empty());
}

TEST(ConvexMesh, NeitherTinyNorHugeBodiesAreTakenForOthers) {
  for (const double size : {1e-100, 1e-85, 1.0, 1e100, 1e200}) {
    Body waist = turned(8, 12, [](double y) { return 0.3 + y * y; });
    Body block = box({-1, -1, -1}, {1, 1, 1});
    for (Body* body : {&waist, &block}) {
      for (glm::dvec3& p : body->positions) {
        p *= size;
      }
    }
    EXPECT_TRUE(waist.vertices().empty()) << size;
    EXPECT_EQ(block.vertices().size(), 8u) << size;
  }
}

TEST(ConvexMesh, ADentThatTheToleranceAllowsPassesAndALargerOneDoesNot) {
  for (const double part : {0.5, 2.0}) {
    // The middle of one side of a box, pushed in.
    Body body = box({-1, -1, -1}, {1, 1, 1});
    body.indices.erase(body.indices.begin(), body.indices.begin() + 6);
    const auto middle = static_cast<uint32_t>(body.positions.size());
    body.positions.emplace_back(0, 0, 1.0 - part * convexTolerance * 2.0);
    for (uint32_t i = 0; i < 4; ++i) {
      body.indices.insert(body.indices.end(), {i, (i + 1) % 4, middle});
    }
    EXPECT_EQ(body.vertices().empty(), part > 1.0) << part;
  }
}

TEST(ConvexMesh, OfNothingOrTooManyTrianglesThereIsNone) {
  EXPECT_TRUE(Body{}.vertices().empty());
  EXPECT_TRUE(box({-1, -1, -1}, {1, 1, 1}).vertices(11).empty());
  EXPECT_FALSE(box({-1, -1, -1}, {1, 1, 1}).vertices(12).empty());
}

}  // namespace
}  // namespace speculum
