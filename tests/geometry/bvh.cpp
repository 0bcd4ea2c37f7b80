#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>

#include "test_headers.hpp"

#else
#include <embree3/rtcore.h>
#endif
#include <gtest/gtest.h>

#include <numeric>

#include "geometry/triangle_mesh.hpp"
#include "random.hpp"
#include "reference/scenes.hpp"

namespace speculum {
namespace {

using testing_support::Random;

// Origins and directions are floats, so that both tracers follow the same rays.
Ray randomRay(Random& random) {
  const glm::dvec3 origin(glm::vec3(2.0 * random.direction()));
  const glm::dvec3 target = 0.9 * random.direction();
  return {origin, glm::dvec3(glm::vec3(target - origin))};
}

bool visitsAny(const TriangleMesh& mesh, const Ray& ray, int64_t skip = TriangleMesh::noTriangle) {
  bool found = false;
  mesh.visit(ray, skip, [&](const TriangleHit&) { return found = true; });
  return found;
}

class EmbreeMesh {
 public:
  explicit EmbreeMesh(const Mesh& mesh) : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                 3 * sizeof(float), mesh.vertices.size()));
    for (size_t i = 0; i < mesh.vertices.size() * 3; ++i) {
      vertices[i] = static_cast<float>(mesh.vertices[i / 3].position[static_cast<int>(i % 3)]);
    }
    auto* indices = static_cast<uint32_t*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                   3 * sizeof(uint32_t), mesh.indices.size() / 3));
    std::copy(mesh.indices.begin(), mesh.indices.end(), indices);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    rtcCommitScene(scene_);
  }
  ~EmbreeMesh() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  EmbreeMesh(const EmbreeMesh&) = delete;
  EmbreeMesh& operator=(const EmbreeMesh&) = delete;

  // -1: no hit
  int64_t closest(const Ray& ray) const {
    RTCRayHit query{};
    query.ray.org_x = static_cast<float>(ray.origin.x);
    query.ray.org_y = static_cast<float>(ray.origin.y);
    query.ray.org_z = static_cast<float>(ray.origin.z);
    query.ray.dir_x = static_cast<float>(ray.direction.x);
    query.ray.dir_y = static_cast<float>(ray.direction.y);
    query.ray.dir_z = static_cast<float>(ray.direction.z);
    query.ray.tfar = std::numeric_limits<float>::infinity();
    query.ray.mask = ~0u;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
    rtcIntersect1(scene_, &query);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene_, &context, &query);
#endif
    return query.hit.geomID == RTC_INVALID_GEOMETRY_ID ? -1 : int64_t{query.hit.primID};
  }

 private:
  RTCDevice device_;
  RTCScene scene_;
};

TEST(ReferenceBvh, MeetsTheSameTrianglesAsEmbree) {
  int rays = 0;
  int same = 0;
  int hits = 0;
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const Mesh mesh = testing::bumpyMesh(40 * static_cast<int>(seed), seed);
    const TriangleMesh ours(mesh);
    const EmbreeMesh theirs(mesh);
    Random random(seed);
    for (int i = 0; i < 50000; ++i, ++rays) {
      const Ray ray = randomRay(random);
      const auto hit = ours.closest(ray);
      const int64_t triangle = hit ? int64_t{hit->triangle} : -1;
      same += triangle == theirs.closest(ray);
      hits += triangle >= 0;
    }
  }
  EXPECT_GE(same, 0.9999 * rays);
  EXPECT_GT(hits, rays / 2);
}

TEST(ReferenceBvh, FindsWhatTestingEveryTriangleFinds) {
  const Mesh mesh = testing::bumpyMesh(12, 7);
  const TriangleMesh tree(mesh);
  std::vector<TriangleMesh> single;
  for (size_t i = 0; i < mesh.indices.size(); i += 3) {
    Mesh one = mesh;
    one.indices = {mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]};
    one.parts = {{0, 3, {}}};
    single.emplace_back(one);
  }
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const Ray ray = randomRay(random);
    double nearest = std::numeric_limits<double>::infinity();
    for (const TriangleMesh& triangle : single) {
      const auto hit = triangle.closest(ray);
      nearest = hit ? std::min(nearest, hit->t) : nearest;
    }
    const auto hit = tree.closest(ray);
    EXPECT_EQ(hit ? hit->t : std::numeric_limits<double>::infinity(), nearest);
    EXPECT_EQ(visitsAny(tree, ray), hit.has_value());
  }
}

// Rays aimed exactly at vertices and edges from inside a closed mesh must not leave it.
TEST(ReferenceBvh, IsWatertightAtEdgesAndVertices) {
  const Mesh mesh = testing::bumpyMesh(24, 5);
  const TriangleMesh tree(mesh);
  const glm::dvec3 inside(0.013, -0.021, 0.008);
  for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const glm::dvec3& a = mesh.vertices[mesh.indices[i]].position;
    const glm::dvec3& b = mesh.vertices[mesh.indices[i + 1]].position;
    for (int k = 0; k <= 8; ++k) {
      const glm::dvec3 target = glm::mix(a, b, k / 8.0);
      EXPECT_TRUE(tree.closest({inside, target - inside})) << "triangle " << i / 3 << ", point " << k;
    }
  }
}

TEST(ReferenceBvh, SkipsTheStartingTriangle) {
  const Mesh mesh = testing::polygonMesh({{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}});
  const TriangleMesh tree(mesh);
  const Ray ray{{0, 0, 1}, {0, 0, -1}};
  ASSERT_TRUE(tree.closest(ray));
  EXPECT_DOUBLE_EQ(tree.closest(ray)->t, 1.0);
  EXPECT_FALSE(tree.closest(ray, 0));
  EXPECT_FALSE(visitsAny(tree, ray, 0));
}

// A model may list a face twice, once for each side: the twin lies at the point that a ray leaves.
TEST(ReferenceBvh, SkipsTrianglesWithTheSameCorners) {
  Mesh mesh = testing::polygonMesh({{-1, -1, 0}, {1, -1, 0.3}, {0, 1, 0.1}});
  mesh.indices.insert(mesh.indices.end(), {mesh.indices[1], mesh.indices[0], mesh.indices[2]});
  mesh.parts[0].indexCount = 6;
  const TriangleMesh tree(mesh);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const auto corner = [&](size_t i) { return mesh.vertices[mesh.indices[i]].position; };
  for (int i = 0; i < 1000; ++i) {
    const double u = unit(random);
    const double v = (1.0 - u) * unit(random);
    const glm::dvec3 point = u * corner(0) + v * corner(1) + (1.0 - u - v) * corner(2);
    const Ray ray{point, {unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5}};
    for (const int64_t triangle : {0, 1}) {
      ASSERT_FALSE(tree.closest(ray, triangle));
      ASSERT_FALSE(visitsAny(tree, ray, triangle));
    }
  }
}

TEST(ReferenceBvh, RaysWithinBoxFacesAreKept) {
  const Mesh mesh = testing::polygonMesh({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}});
  const TriangleMesh tree(mesh);
  EXPECT_TRUE(tree.closest({{0, 1, 1}, {0, 0, -1}}));
  EXPECT_TRUE(tree.closest({{2, 2, 1}, {0, 0, -1}}));
  EXPECT_FALSE(tree.closest({{-1e-12, 1, 1}, {0, 0, -1}}));
}

TEST(ReferenceBvh, ManyIdenticalBoxesStillMakeATree) {
  const std::vector<Bounds> same(1000, Bounds{glm::dvec3(0.0), glm::dvec3(1.0)});
  const Bvh tree(same);
  int visited = 0;
  tree.traverse({{0.5, 0.5, 2.0}, {0, 0, -1}}, [&](uint32_t, uint32_t count, double&) {
    visited += static_cast<int>(count);
    return false;
  });
  EXPECT_EQ(visited, 1000);
}

// The boxes of runs of random points add up to much less than those of unsorted runs, also if points coincide.
TEST(SortIntoRuns, PointsOfARunLieCloseTogether) {
  Random random(5);
  for (const size_t count : {1, 16, 17, 100, 256, 1000}) {
    std::vector<glm::dvec3> points(count);
    for (size_t i = 0; i < count; ++i) {
      points[i] = i % 7 == 6 ? points[i - 1] : 10.0 * random.direction();
    }
    std::vector<int> order(count);
    std::iota(order.begin(), order.end(), 0);
    const auto area = [&] {
      double sum = 0.0;
      for (size_t first = 0; first < count; first += 16) {
        Bounds box;
        std::ranges::for_each(std::span(order).subspan(first, std::min<size_t>(16, count - first)),
                              [&](int i) { box.add(points[i]); });
        sum += box.halfArea();
      }
      return sum;
    };
    const double unsorted = area();
    sortIntoRuns(order, points, 16);
    EXPECT_LE(area(), count > 64 ? 0.4 * unsorted : unsorted) << count;
    std::ranges::sort(order);
    for (size_t i = 0; i < count; ++i) {
      ASSERT_EQ(order[i], static_cast<int>(i));
    }
  }
}

}  // namespace
}  // namespace speculum
