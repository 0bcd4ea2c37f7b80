#include <set>
#include <thread>

#include "geometry/mesh_levels.hpp"
#include "geometry/surface_distance.hpp"
#include "random.hpp"
#include "scene/obj_loader.hpp"
#include "test_headers.hpp"
#include "test_paths.hpp"
#include "triangles.hpp"

namespace speculum {
namespace {

using testing_support::Random;
using Corners = std::array<glm::dvec3, 3>;

Mesh model(const std::string& name) {
  std::vector<Texture> textures;
  return loadObj(sourceDir() / "models" / (name + ".obj"), textures);
}

glm::dvec3 randomPoint(Random& random, const Corners& triangle) {
  const double a = std::sqrt(random.uniform(0.0, 1.0));
  const double b = random.uniform(0.0, 1.0);
  return (1.0 - a) * triangle[0] + a * ((1.0 - b) * triangle[1] + b * triangle[2]);
}

std::vector<glm::dvec3> cornersOf(const std::vector<Vertex>& vertices, const std::vector<uint32_t>& indices,
                                  uint32_t first, uint32_t count) {
  std::vector<glm::dvec3> corners;
  for (uint32_t i = first; i < first + count; ++i) {
    corners.push_back(vertices.at(indices.at(i)).position);
  }
  return corners;
}

TEST(SurfaceDistance, ToOneTriangle) {
  const SurfaceDistance surface({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}});
  EXPECT_DOUBLE_EQ(surface.to({0.5, 0.5, -3}), 3.0) << "above it";
  EXPECT_DOUBLE_EQ(surface.to({1, -2, 0}), 2.0) << "beside an edge";
  EXPECT_DOUBLE_EQ(surface.to({2, 2, 0}), std::sqrt(2.0)) << "beside the slanted edge";
  EXPECT_DOUBLE_EQ(surface.to({-3, -4, 0}), 5.0) << "beyond a corner";
  EXPECT_EQ(surface.to({1, 0, 0}), 0.0);
  EXPECT_TRUE(surface.within({1, -2, 0}, 2.0));
  EXPECT_FALSE(surface.within({1, -2, 0}, 1.999));
  const SurfaceDistance line({{0, 0, 0}, {1, 0, 0}, {3, 0, 0}});
  EXPECT_DOUBLE_EQ(line.to({2, 0, 1}), 1.0) << "a triangle without area";
  EXPECT_EQ(SurfaceDistance({}).to({1, 2, 3}), std::numeric_limits<double>::infinity());
}

TEST(SurfaceDistance, IsTheLeastOverAllTriangles) {
  Random random(7);
  for (const int count : {1, 4, 5, 63, 500}) {
    std::vector<glm::dvec3> corners;
    for (int i = 0; i < count; ++i) {
      const glm::dvec3 center = random.inBox(1.0);
      for (int k = 0; k < 3; ++k) {
        corners.push_back(center + random.inBox(0.2));
      }
    }
    const SurfaceDistance all(corners);
    for (int i = 0; i < 100; ++i) {
      const glm::dvec3 point = random.inBox(2.0);
      double least = std::numeric_limits<double>::infinity();
      for (size_t t = 0; t < corners.size(); t += 3) {
        least = std::min(least, SurfaceDistance({corners[t], corners[t + 1], corners[t + 2]}).to(point));
      }
      ASSERT_EQ(all.to(point), least);
      ASSERT_TRUE(all.within(point, 1.0001 * least));
      ASSERT_FALSE(all.within(point, 0.9999 * least));
    }
  }
}

class Levels : public testing::TestWithParam<const char*> {};

TEST_P(Levels, HaveFewerTrianglesInEachPart) {
  const Mesh mesh = model(GetParam());
  const MeshLevels levels = simplified(mesh);
  ASSERT_FALSE(levels.levels.empty());
  uint32_t last = static_cast<uint32_t>(mesh.indices.size());
  uint32_t next = 0;
  double error = 0.0;
  for (const MeshLevel& level : levels.levels) {
    EXPECT_EQ(level.all.first, next);
    EXPECT_EQ(level.all.count % 3, 0u);
    EXPECT_LE(level.all.count, 0.85 * last);
    EXPECT_GE(level.error, error);
    ASSERT_EQ(level.parts.size(), mesh.parts.size());
    for (const IndexRange& part : level.parts) {
      EXPECT_EQ(part.first, next);
      next += part.count;
    }
    EXPECT_EQ(next, level.all.first + level.all.count);
    last = level.all.count;
    error = level.error;
  }
  EXPECT_EQ(next, levels.indices.size());
}

TEST_P(Levels, HaveVerticesOfTheirOwn) {
  const MeshLevels levels = simplified(model(GetParam()));
  uint32_t first = 0;
  for (const MeshLevel& level : levels.levels) {
    uint32_t end = first;
    for (uint32_t k = level.all.first; k < level.all.first + level.all.count; ++k) {
      ASSERT_GE(levels.indices[k], first);
      ASSERT_LE(levels.indices[k], end) << "a vertex is left out before it";
      end = std::max(end, levels.indices[k] + 1);
    }
    first = end;
  }
  EXPECT_EQ(first, levels.vertices.size());
}

// Measures in both directions at random points between those that the error was measured at.
TEST_P(Levels, ErrorBoundsTheDistance) {
  constexpr double between = 1.25;
  const Mesh mesh = model(GetParam());
  const MeshLevels levels = simplified(mesh);
  Random random(3);
  double worst = 0.0;
  for (const MeshLevel& level : levels.levels) {
    for (size_t p = 0; p < mesh.parts.size(); ++p) {
      const auto exact = cornersOf(mesh.vertices, mesh.indices, mesh.parts[p].firstIndex, mesh.parts[p].indexCount);
      const auto fewer = cornersOf(levels.vertices, levels.indices, level.parts[p].first, level.parts[p].count);
      for (const auto& [from, to] : {std::pair(exact, SurfaceDistance(fewer)), {fewer, SurfaceDistance(exact)}}) {
        for (int i = 0; i < 3000; ++i) {
          const size_t t = 3 * random.index(from.size() / 3);
          worst = std::max(worst, to.to(randomPoint(random, {from[t], from[t + 1], from[t + 2]})) / level.error);
        }
      }
    }
  }
  EXPECT_LE(worst, between);
  EXPECT_GT(worst, 0.3) << "the error is far too pessimistic";
}

INSTANTIATE_TEST_SUITE_P(Models, Levels, testing::Values("torus_knot", "queen", "teapot", "room", "coffers", "arch"),
                         [](const auto& info) { return std::string(info.param); });

double volume(const std::vector<glm::dvec3>& corners) {
  double sum = 0.0;
  for (size_t i = 0; i < corners.size(); i += 3) {
    sum += glm::dot(corners[i], glm::cross(corners[i + 1], corners[i + 2])) / 6.0;
  }
  return sum;
}

TEST(MeshLevels, KeepWindingAndVolume) {
  const Mesh mesh = model("sphere");
  const MeshLevels levels = simplified(mesh);
  const double whole = volume(cornersOf(mesh.vertices, mesh.indices, 0, static_cast<uint32_t>(mesh.indices.size())));
  ASSERT_GT(whole, 0.0);
  for (const MeshLevel& level : levels.levels) {
    const double part = volume(cornersOf(levels.vertices, levels.indices, level.all.first, level.all.count));
    EXPECT_GT(part, whole * (1.0 - 3.0 * level.error / mesh.radius));
    EXPECT_LE(part, whole);
  }
}

// A wavy sheet of 40 x 40 squares in two materials that meet along a line.
Mesh twoParts() {
  Mesh mesh = sheetOf(
      40, [](uint32_t x, uint32_t y) { return glm::dvec3(x - 20.0, y - 20.0, std::sin(0.3 * x) * std::cos(0.2 * y)); });
  mesh.halfExtent = {20, 20, 1};
  mesh.radius = 29.0;
  const auto half = static_cast<uint32_t>(mesh.indices.size() / 2);
  mesh.parts = {{0, half, {}}, {half, half, {}}};
  return mesh;
}

TEST(MeshLevels, PartsStayJoined) {
  const Mesh mesh = twoParts();
  const MeshLevels levels = simplified(mesh);
  ASSERT_GT(levels.levels.size(), 1u);
  for (const MeshLevel& level : levels.levels) {
    for (const IndexRange& part : level.parts) {
      std::set<double> seam;
      for (const glm::dvec3& p : cornersOf(levels.vertices, levels.indices, part.first, part.count)) {
        if (p.y == 0.0) {
          seam.insert(p.x);
        }
      }
      EXPECT_EQ(seam.size(), 41u) << "every vertex of the seam is in both parts";
    }
  }
}

// A mesh like that of a file without normals: each triangle has vertices of its own.
TEST(MeshLevels, FacetsOfASmoothBodyAreJoined) {
  const Mesh smooth = model("sphere");
  Mesh mesh{.halfExtent = smooth.halfExtent, .radius = smooth.radius};
  for (size_t i = 0; i < smooth.indices.size(); i += 3) {
    Corners corners;
    for (size_t k = 0; k < 3; ++k) {
      corners[k] = smooth.vertices[smooth.indices[i + k]].position;
    }
    const glm::dvec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    for (const glm::dvec3& corner : corners) {
      mesh.indices.push_back(static_cast<uint32_t>(mesh.vertices.size()));
      mesh.vertices.push_back({corner, normal, {}});
    }
  }
  mesh.parts = {{0, static_cast<uint32_t>(mesh.indices.size()), {}}};
  const MeshLevels levels = simplified(mesh);
  ASSERT_GT(levels.levels.size(), 4u);
  EXPECT_LT(levels.levels[3].all.count, mesh.indices.size() / 3);
  EXPECT_LT(levels.levels[3].error, 0.1 * mesh.radius);
}

TEST(MeshLevels, CornersOfHardEdgesStay) {
  const Mesh mesh = model("frame");
  const MeshLevels levels = simplified(mesh);
  ASSERT_FALSE(levels.levels.empty());
  for (const MeshLevel& level : levels.levels) {
    glm::dvec3 low(1e9);
    glm::dvec3 high(-1e9);
    for (const glm::dvec3& p : cornersOf(levels.vertices, levels.indices, level.all.first, level.all.count)) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(high[i], mesh.halfExtent[i], 1e-12);
      EXPECT_NEAR(low[i], -mesh.halfExtent[i], 1e-12);
    }
  }
}

TEST(MeshLevels, SmallMeshesHaveNone) {
  EXPECT_TRUE(simplified(model("box")).levels.empty());
  EXPECT_TRUE(simplified(Mesh{}).levels.empty());
}

TEST(MeshLevels, AreMadeOnceForAllThreads) {
  const Mesh mesh = model("pawn");
  EXPECT_EQ(mesh.levels, nullptr) << "loading makes none";
  std::array<const MeshLevels*, 4> found{};
  {
    std::vector<std::jthread> threads;
    for (const MeshLevels*& f : found) {
      threads.emplace_back([&] { f = &levelsOf(mesh); });
    }
  }
  for (const MeshLevels* f : found) {
    EXPECT_EQ(f, &levelsOf(mesh));
  }
}

TEST(Models, OnlyConvexModelsHideAsAWhole) {
  for (const char* name : {"sphere", "gem", "box", "block", "tile"}) {
    EXPECT_GE(model(name).convex.points.size(), 8u) << name;
  }
  for (const char* name : {"torus_knot", "queen", "post", "frame", "room", "moebius"}) {
    EXPECT_TRUE(model(name).convex.points.empty()) << name;
  }
}

// Sheets that are seen from both sides are not, and the ammonite's turns cross.
TEST(Models, ShippedBodiesAreSolid) {
  const std::set<std::string> others{"ammonite", "arcade_bay", "chequer_inlay", "coffers", "room", "teapot"};
  std::set<std::string> found;
  for (const auto& entry : std::filesystem::directory_iterator(sourceDir() / "models")) {
    const std::string name = entry.path().stem().string();
    if (entry.path().extension() == ".obj" && !model(name).solid) {
      found.insert(name);
    }
  }
  EXPECT_EQ(found, others);
}

TEST(Models, LevelsOfSolidsMayBeSolid) {
  for (const char* name : {"sphere", "pawn", "moebius", "torus_knot"}) {
    const std::vector<MeshLevel> levels = simplified(model(name)).levels;
    EXPECT_GT(std::ranges::count(levels, true, &MeshLevel::solid), 0) << name;
  }
  const std::vector<MeshLevel> levels = simplified(model("teapot")).levels;
  EXPECT_EQ(std::ranges::count(levels, true, &MeshLevel::solid), 0);
}

}  // namespace
}  // namespace speculum
