// Clusters: objects that are seen in part are drawn in part, but never less than is seen.
#include <ctime>
#include <glm/gtx/component_wise.hpp>
#include <numbers>
#include <numeric>
#include <random>

#include "geometry/mesh.hpp"
#include "plan/support.hpp"
#include "random.hpp"
#include "systems/triangles.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

using testing_support::planOf;

// A sheet of 32 x 32 squares of 1/16 m in the plane z = 0, row by row.
Mesh sheet() {
  Mesh mesh = sheetOf(32, [](uint32_t x, uint32_t y) { return glm::dvec3(x / 16.0 - 1.0, y / 16.0 - 1.0, 0.0); });
  mesh.halfExtent = {1, 1, 0};
  mesh.radius = std::sqrt(2.0);
  const uint32_t half = static_cast<uint32_t>(mesh.indices.size()) / 2;
  mesh.parts = {{0, half - 300, {}}, {half - 300, half + 300, {}}};
  mesh.clusters = clustersOf(mesh);
  return mesh;
}

Scene sceneOf(const Object& object, const std::vector<Mirror>& mirrors = {}) {
  Scene scene = testing_support::sceneWith(mirrors);
  scene.objects = {object};
  scene.objects[0].mesh = 0;
  scene.meshes = {sheet()};
  return scene;
}

TEST(Clusters, CoverEveryPartInItsOrder) {
  const Mesh mesh = sheet();
  uint32_t next = 0;
  size_t part = 0;
  for (const MeshCluster& cluster : mesh.clusters) {
    ASSERT_EQ(cluster.firstIndex, next);
    next += cluster.indexCount;
    ASSERT_EQ(cluster.indexCount % 3, 0u);
    if (cluster.firstIndex >= mesh.parts[part].firstIndex + mesh.parts[part].indexCount) {
      ++part;
    }
    EXPECT_LE(next, mesh.parts[part].firstIndex + mesh.parts[part].indexCount) << "a cluster is of one part";
    for (uint32_t i = cluster.firstIndex; i < next; ++i) {
      const glm::dvec3 off = glm::abs(mesh.vertices[mesh.indices[i]].position - cluster.center);
      EXPECT_TRUE(glm::all(glm::lessThanEqual(off, cluster.halfExtent + 1e-12)));
    }
  }
  EXPECT_EQ(next, mesh.indices.size());
}

using Corners = std::array<std::array<double, 8>, 3>;

// Returns the corners of the triangles of one part with all their attributes, triangles in any order.
std::vector<Corners> trianglesOf(const Mesh& mesh, const MeshPart& part) {
  std::vector<Corners> triangles;
  for (uint32_t i = part.firstIndex; i < part.firstIndex + part.indexCount; i += 3) {
    Corners corners;
    for (uint32_t k = 0; k < 3; ++k) {
      const Vertex& v = mesh.vertices[mesh.indices[i + k]];
      corners[k] = {v.position.x, v.position.y, v.position.z, v.normal.x, v.normal.y, v.normal.z, v.uv.x, v.uv.y};
    }
    std::rotate(corners.begin(), std::ranges::min_element(corners), corners.end());
    triangles.push_back(corners);
  }
  std::ranges::sort(triangles);
  return triangles;
}

double meanDiagonal(const Mesh& mesh) {
  double sum = 0.0;
  for (const MeshCluster& cluster : mesh.clusters) {
    sum += 2.0 * glm::length(cluster.halfExtent);
  }
  return sum / static_cast<double>(mesh.clusters.size());
}

TEST(Clusters, SortingKeepsAllTrianglesAndTheirWinding) {
  const Mesh before = sheet();
  Mesh sorted = before;
  sortIntoClusters(sorted);
  EXPECT_NE(sorted.indices, before.indices);
  ASSERT_EQ(sorted.parts.size(), 2u);
  EXPECT_EQ(sorted.vertices.size(), before.vertices.size());
  for (size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(trianglesOf(sorted, sorted.parts[i]), trianglesOf(before, before.parts[i])) << i;
  }
}

TEST(Clusters, SortingDropsVerticesWithoutUse) {
  const Mesh before = sheet();
  Mesh mixed = before;
  mixed.vertices.clear();
  std::vector<uint32_t> places(before.vertices.size());
  std::iota(places.begin(), places.end(), 0u);
  std::ranges::shuffle(places, std::mt19937(1));
  std::vector<uint32_t> numbers(places.size());
  for (const uint32_t place : places) {
    numbers[place] = static_cast<uint32_t>(mixed.vertices.size());
    mixed.vertices.push_back(before.vertices[place]);
    mixed.vertices.push_back({.position = {1e3 + place, 0, 0}});
  }
  for (uint32_t& index : mixed.indices) {
    index = numbers[index];
  }
  sortIntoClusters(mixed);
  EXPECT_EQ(mixed.vertices.size(), before.vertices.size());
  for (size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(trianglesOf(mixed, mixed.parts[i]), trianglesOf(before, before.parts[i])) << i;
  }
}

TEST(Clusters, SortingMakesThemSmallInVertexOrder) {
  const Mesh before = sheet();  // rows of 64 triangles, 2 m long
  Mesh sorted = before;
  sortIntoClusters(sorted);
  sorted.clusters = clustersOf(sorted);
  EXPECT_EQ(sorted.clusters.size(), before.clusters.size());
  EXPECT_GT(meanDiagonal(before), 1.5);
  EXPECT_LT(meanDiagonal(sorted), 0.85);
  uint32_t next = 0;
  for (const uint32_t index : sorted.indices) {
    EXPECT_LE(index, next);
    next = std::max(next, index + 1);
  }
}

// Returns a cone of `sides`, or one of its triangles as often.
Mesh cone(uint32_t sides, bool same) {
  Mesh mesh{.radius = 1.0, .vertices = {{{0, 0.3, 0}, {0, 1, 0}, {}}}};
  for (uint32_t i = 0; i < sides; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / sides;
    mesh.vertices.push_back({{std::cos(angle), 0.0, std::sin(angle)}, {0, 1, 0}, {}});
    mesh.indices.insert(mesh.indices.end(), {0, same ? 1 : 1 + (i + 1) % sides, same ? 2 : 1 + i});
  }
  mesh.parts = {{0, 3 * sides, {}}};
  return mesh;
}

// A cone shares one vertex among all its triangles; of many parts, each has few of the vertices.
TEST(Clusters, MeshesOfAnyFormAreSortedQuickly) {
  Mesh parts{.radius = 1.0, .vertices = std::vector<Vertex>(600'000)};
  for (uint32_t i = 0; i < 6000; ++i) {
    parts.parts.push_back({3 * i, 3, {}});
    parts.indices.insert(parts.indices.end(), {100 * i, 100 * i + 1, 100 * i + 2});
  }
  for (size_t i = 0; i < parts.vertices.size(); ++i) {
    parts.vertices[i].position = {1e-6 * static_cast<double>(i), 0.0, 0.0};
  }
  for (const Mesh& before : {cone(60'000, false), cone(60'000, true), parts}) {
    Mesh sorted = before;
    const std::clock_t start = std::clock();
    sortIntoClusters(sorted);
    EXPECT_LT(std::clock() - start, 2 * CLOCKS_PER_SEC) << before.parts.size() << " parts";
    for (const size_t part : {size_t{0}, before.parts.size() - 1}) {
      EXPECT_TRUE(trianglesOf(sorted, sorted.parts[part]) == trianglesOf(before, before.parts[part]));
    }
  }
}

TEST(Clusters, SmallMeshesAreNotSorted) {
  Mesh mesh = sheet();
  mesh.indices.resize(size_t{3} * 500);
  mesh.parts = {{0, 3 * 500, {}}};
  const std::vector<uint32_t> before = mesh.indices;
  sortIntoClusters(mesh);
  EXPECT_EQ(mesh.indices, before);
}

TEST(Clusters, SmallMeshesHaveNone) {
  Mesh mesh = sheet();
  mesh.indices.resize(300);
  mesh.parts = {{0, 300, {}}};
  EXPECT_TRUE(clustersOf(mesh).empty());
}

TEST(Clusters, ObjectsInsideThePictureAreDrawnWhole) {
  const FramePlan plan = planOf(sceneOf({.position = {0, 0, -5}}));
  EXPECT_EQ(plan.main().instances, RecycledVector<int>{0});
  EXPECT_TRUE(plan.main().partial.empty());
}

TEST(Clusters, ObjectsCutByThePictureArePartial) {
  // The picture ends 0.87 m above the middle there.
  const Scene scene = sceneOf({.position = {0, 1.2, -1.5}});
  Settings settings;
  const FramePlan plan = planOf(scene, settings);
  ASSERT_EQ(plan.main().partial.size(), 1u);
  const auto& ranges = plan.main().partial[0].ranges;
  ASSERT_EQ(ranges.size(), 1u);
  EXPECT_EQ(ranges[0].first, 0u);
  // The view sees the lowest 0.67 m of 2 m. The last cluster of that part reaches beyond it.
  EXPECT_GE(ranges[0].count, 6u * 32u * 10u);
  EXPECT_LE(ranges[0].count, 6u * 32u * 13u);
  settings.debug.cullClusters = false;
  EXPECT_TRUE(planOf(scene, settings).main().partial.empty());
}

TEST(Clusters, ObjectsSeenByBoxOnlyAreDropped) {
  // The view sees a corner of the mesh's box that has no clusters.
  Scene scene = sceneOf({});
  Mesh& mesh = scene.meshes[0];
  std::erase_if(mesh.clusters, [](const MeshCluster& c) { return c.center.y > -0.5; });
  scene.objects[0].position = {0, -1.2, -1.5};
  EXPECT_TRUE(planOf(scene).main().instances.empty());
}

// Checks every triangle by itself, from random places, in mirrors too.
TEST(Clusters, NeverLeaveOutVisibleTriangles) {
  testing_support::Random random(7);
  const auto uniform = [&](double low, double high) { return random.uniform(low, high); };
  const Mesh mesh = sheet();
  uint64_t drawn = 0;
  uint64_t seen = 0;
  uint64_t whole = 0;
  int partial = 0;
  for (int round = 0; round < 400; ++round) {
    const Object object{.position = {uniform(-1.5, 1.5), uniform(-1.5, 1.5), uniform(-4, 1)},
                        .rotation = {uniform(-180, 180), uniform(-180, 180), uniform(-180, 180)},
                        .scale = {uniform(0.2, 3), uniform(0.2, 3), uniform(0.2, 3)}};
    const Mirror mirror{.position = {uniform(-1, 1), uniform(-1, 1), -3},
                        .rotation = {uniform(-30, 30), uniform(-30, 30), 0},
                        .size = {uniform(0.1, 2), uniform(0.1, 2)}};
    const Scene scene = sceneOf(object, {mirror});
    const SceneState state = evaluate(scene, 0.0);
    const FramePlan plan = planFrame({scene, state, {}, {640, 360}});
    std::vector<const Pass*> passes{&plan.main()};
    for (const Pass& pass : plan.drawnMirrors()) {
      passes.push_back(&pass);
    }
    for (const Pass* pass : passes) {
      const InstanceState& instance = state.instances[0];
      auto ranges = RecycledVector<IndexRange>(pass->instances.empty() ? 0 : 1, allOf(mesh));
      if (!pass->partial.empty()) {
        ranges = pass->partial[0].ranges;
        ++partial;
      }
      drawn += indexCount(ranges);
      whole += pass->instances.empty() ? 0 : mesh.indices.size();
      for (uint32_t i = 0; i < mesh.indices.size(); i += 3) {
        std::array<glm::dvec3, 3> triangle;
        for (int k = 0; k < 3; ++k) {
          triangle[k] = instance.worldFromMesh.point(mesh.vertices[mesh.indices[i + k]].position);
        }
        if (visiblePart(pass->view, triangle).empty()) {
          continue;
        }
        seen += 3;
        EXPECT_TRUE(std::ranges::any_of(
            ranges, [&](const IndexRange& range) { return i >= range.first && i + 3 <= range.first + range.count; }))
            << "round " << round << ", triangle " << i / 3;
      }
    }
  }
  EXPECT_GT(partial, 200);
  EXPECT_LT(4 * (drawn - seen), 3 * (whole - seen)) << "of what is not seen at least a quarter is left out";
}

// A random box, sheared and maybe mirrored, and an eye at a point of the box's own space.
TEST(Solids, ShowOnlyFrontsToEyesOutsideTheirBox) {
  testing_support::Random random(5);
  for (int i = 0; i < 2000; ++i) {
    InstanceState instance;
    for (int column = 0; column < 3; ++column) {
      instance.worldFromMesh.linear[column] = random.inBox(1.0);
    }
    if (std::abs(glm::determinant(instance.worldFromMesh.linear)) < 0.01) {
      continue;
    }
    instance.worldFromMesh.translation = random.inBox(10.0);
    const glm::dvec3 halfExtent = random.inBox(1.0) + 1.1;
    const glm::dvec3 eye = 2.0 * random.inBox(1.0) * halfExtent;
    const double nearest = glm::compMax(glm::abs(eye) / halfExtent);
    View view;
    view.eye = instance.worldFromMesh.point(eye);
    if (nearest < 1.0 || nearest > 1.1) {
      EXPECT_EQ(seesOnlyFronts(view, instance, halfExtent), nearest > 1.0) << i;
    }
  }
}

TEST(Solids, ThinOnesAreSeenFromFartherThanRounding) {
  InstanceState instance;
  View view;
  const auto above = [&](double height) {
    view.eye = {0, 0.001 + height, 0};
    return seesOnlyFronts(view, instance, {10, 0.001, 10});
  };
  EXPECT_TRUE(above(1e-3));
  EXPECT_FALSE(above(1e-5));
}

TEST(Solids, ShowBacksWhereAClipPlaneCutsThem) {
  InstanceState instance;
  View view;
  view.eye = {0, -5, 0};
  const auto at = [&](double height) {
    instance.worldFromMesh.translation = {3, height, 0};
    view.clip = Plane{{0, 0, 0}, {0, 1, 0}};
    return seesOnlyFronts(view, instance, {1, 2, 1});
  };
  EXPECT_TRUE(at(2.5));
  EXPECT_FALSE(at(2.0)) << "float rounding may cut its base";
  EXPECT_FALSE(at(1.99));
  EXPECT_FALSE(at(-3.0));
}

}  // namespace
}  // namespace speculum
