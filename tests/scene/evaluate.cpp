#include <numbers>

#include "geometry/affine.hpp"
#include "geometry/polygon.hpp"
#include "random.hpp"
#include "scene/scene_state.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

using testing_support::Random;

void expectNear(const glm::dvec3& value, const glm::dvec3& expected, double tolerance) {
  EXPECT_NEAR(value.x, expected.x, tolerance);
  EXPECT_NEAR(value.y, expected.y, tolerance);
  EXPECT_NEAR(value.z, expected.z, tolerance);
}

Mesh boxMesh(const glm::dvec3& center, const glm::dvec3& halfExtent) {
  Mesh mesh{.center = center, .halfExtent = halfExtent, .radius = glm::length(halfExtent)};
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 sign((i & 1) * 2 - 1, (i & 2) - 1, (i & 4) / 2 - 1);
    mesh.vertices.push_back({.position = sign * halfExtent});
  }
  return mesh;
}

Scene sceneWithCamera() {
  Scene scene;
  scene.camera.position = {0, 0, 4};
  return scene;
}

Scene sceneWithObject(const Object& object) {
  Scene scene = sceneWithCamera();
  scene.meshes.push_back(boxMesh({10, 20, 30}, {1, 2, 3}));
  scene.objects.push_back(object);
  scene.objects[0].mesh = 0;
  return scene;
}

TEST(Evaluate, ObjectIsScaledThenTurnedThenMoved) {
  const Scene scene = sceneWithObject({.position = {100, 0, 0}, .rotation = {0, 90, 0}, .scale = {1, 2, -3}});
  const InstanceState instance = evaluate(scene, 0.0).instances.at(0);
  // Model space (11, 22, 33) -> scaled (11, 44, -99) -> turned about Y by 90 degrees: x' = z, z' = -x.
  expectNear(instance.worldFromMesh.point({1, 2, 3}), {100 - 99, 44, -11}, 1e-12);
  expectNear(instance.center, instance.worldFromMesh.point(glm::dvec3(0.0)), 0.0);
}

TEST(Evaluate, ModelsWithZUpAreTurnedBeforeTheyAreScaled) {
  const Scene scene =
      sceneWithObject({.position = {100, 0, 0}, .rotation = {0, 90, 0}, .scale = {1, 2, -3}, .up = UpAxis::z});
  // Model space (11, 22, 33) -> turned about X by -90 degrees (11, 33, -22) -> scaled (11, 66, 66) -> turned about Y.
  expectNear(evaluate(scene, 0.0).instances.at(0).worldFromMesh.point({1, 2, 3}), {100 + 66, 66, -11}, 1e-12);
}

TEST(Evaluate, RotationOrderIsYawPitchRoll) {
  Scene scene = sceneWithObject({.rotation = {90, 90, 90}});
  scene.meshes[0].center = glm::dvec3(0.0);
  // Roll takes X to Y, pitch Y to Z, yaw Z to X.
  expectNear(evaluate(scene, 0.0).instances[0].worldFromMesh.vector({1, 0, 0}), {1, 0, 0}, 1e-15);
  // Roll takes Y to -X, pitch leaves it, yaw takes -X to Z.
  expectNear(evaluate(scene, 0.0).instances[0].worldFromMesh.vector({0, 1, 0}), {0, 0, 1}, 1e-15);
}

TEST(Evaluate, CopiesMoveInWorldSpace) {
  const Scene scene = sceneWithObject({.position = {1, 2, 3},
                                       .rotation = {0, 90, 0},
                                       .scale = glm::dvec3(5.0),
                                       .copies = {.count = 3, .step = {0.5, 0, -1}}});
  const SceneState state = evaluate(scene, 0.0);
  ASSERT_EQ(state.instances.size(), 3u);
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(state.instances[k].copy, k);
    expectNear(state.instances[k].center - state.instances[0].center, glm::dvec3(0.5 * k, 0, -1.0 * k), 1e-12);
  }
}

TEST(Evaluate, InstancesAreSorted) {
  Scene scene = sceneWithCamera();
  scene.meshes = {boxMesh(glm::dvec3(0.0), glm::dvec3(1.0)), boxMesh(glm::dvec3(0.0), glm::dvec3(1.0))};
  scene.objects = {{.mesh = 1, .copies = {.count = 2}}, {.mesh = 0}, {.mesh = 1}, {.mesh = 0, .copies = {.count = 2}}};
  std::vector<std::array<int, 3>> order;
  for (const InstanceState& instance : evaluate(scene, 0.0).instances) {
    order.push_back({instance.mesh, instance.object, instance.copy});
  }
  EXPECT_EQ(order.size(), 6u);
  EXPECT_TRUE(std::ranges::is_sorted(order));
}

TEST(Evaluate, BoundingSphereHoldsEveryVertex) {
  Random random(7);
  for (int i = 0; i < 200; ++i) {
    const Scene scene = sceneWithObject({.position = random.inBox(3.0),
                                         .rotation = random.inBox(300.0),
                                         .scale = random.inBox(3.0),
                                         .spin = random.inBox(3.0)});
    const InstanceState instance = evaluate(scene, random.uniform(-3.0, 3.0)).instances[0];
    for (const Vertex& vertex : scene.meshes[0].vertices) {
      EXPECT_LE(glm::distance(instance.worldFromMesh.point(vertex.position), instance.center), instance.radius);
    }
  }
}

TEST(Evaluate, LightOrbitsByTheRightHandRule) {
  Scene scene = sceneWithCamera();
  scene.lights.push_back({.position = {3, 5, 0}, .orbit = Orbit{.center = {1, 2, 0}, .axis = {0, 7, 0}, .speed = 30}});
  scene.lights.push_back({.position = {1, 2, 3}});
  expectNear(evaluate(scene, 0.0).lights[0].position, {3, 5, 0}, 1e-15);
  expectNear(evaluate(scene, 3.0).lights[0].position, {1, 5, -2}, 1e-14);
  expectNear(evaluate(scene, -3.0).lights[0].position, {1, 5, 2}, 1e-14);
  // 3e7 degrees are 83333 turns and 120 degrees.
  expectNear(evaluate(scene, 1e6).lights[0].position, {1 - 1, 5, -std::sqrt(3.0)}, 1e-12);
  EXPECT_EQ(evaluate(scene, 5.0).lights[1].position, glm::dvec3(1, 2, 3));
}

TEST(Evaluate, CameraOrbitsAboutUpThroughTarget) {
  Scene scene = sceneWithCamera();
  scene.camera = {.position = {2, 3, 4}, .target = {2, 1, 1}, .up = {0, 2, 0}, .orbitSpeed = 90};
  expectNear(evaluate(scene, 0.0).camera.eye, {2, 3, 4}, 1e-15);
  // +Z turns to +X about +Y.
  expectNear(evaluate(scene, 1.0).camera.eye, {5, 3, 1}, 1e-14);
  expectNear(evaluate(scene, -1.0).camera.eye, {-1, 3, 1}, 1e-14);
  expectNear(evaluate(scene, 1e6).camera.eye, {2, 3, 4}, 1e-12);
}

TEST(Evaluate, UnrotatedMirrorFacesPlusZ) {
  Scene scene = sceneWithCamera();
  scene.mirrors.push_back({.position = {1, 2, 3}, .size = {4, 2}});
  const MirrorState mirror = evaluate(scene, 0.0).mirrors.at(0);
  EXPECT_EQ(mirror.origin, glm::dvec3(1, 2, 3));
  EXPECT_EQ(mirror.normal, glm::dvec3(0, 0, 1));
  EXPECT_EQ(mirror.axisX, glm::dvec3(1, 0, 0));
  EXPECT_EQ(mirror.axisY, glm::dvec3(0, 1, 0));
  ASSERT_EQ(mirror.polygon.size(), 4u);
  expectNear(newellVector(mirror.polygon), {0, 0, 16}, 1e-12);
  for (const glm::dvec3& corner : mirror.polygon) {
    EXPECT_EQ(glm::abs(corner - mirror.origin), glm::dvec3(2, 1, 0));
  }
}

TEST(Evaluate, PolygonMirrorFrameIsItsFirstEdge) {
  Scene scene = sceneWithCamera();
  // In the plane x = 5, the last vertex 1e-5 off it.
  scene.mirrors.push_back({.polygon = {{5, 1, 0}, {5, 3, 0}, {5, 3, 2}, {5 + 1e-5, 1, 2}}});
  const MirrorState mirror = evaluate(scene, 7.0).mirrors[0];
  ASSERT_EQ(mirror.polygon.size(), 4u);
  for (size_t i = 0; i < 4; ++i) {
    expectNear(mirror.polygon[i], scene.mirrors[0].polygon[i], 1e-5);
    EXPECT_NEAR(glm::dot(mirror.normal, mirror.polygon[i] - mirror.origin), 0.0, 1e-15) << "in the plane";
  }
  EXPECT_EQ(mirror.origin, glm::dvec3(5, 1, 0));
  expectNear(mirror.normal, {1, 0, 0}, 1e-5);
  expectNear(mirror.axisX, {0, 1, 0}, 1e-5);
  expectNear(mirror.axisY, {0, 0, 1}, 1e-5);
  EXPECT_NEAR(glm::dot(mirror.axisX, mirror.normal), 0.0, 1e-16);
  EXPECT_NEAR(glm::length(mirror.axisX), 1.0, 1e-15);
  EXPECT_NEAR(glm::length(mirror.axisY), 1.0, 1e-15);
}

TEST(Evaluate, RepeatedVerticesLeaveTheFrameWhole) {
  Scene scene = sceneWithCamera();
  scene.mirrors.push_back({.polygon = {{0, 0, 0}, {0, 0, 0}, {2, 0, 0}, {0, 2, 0}}});
  const MirrorState mirror = evaluate(scene, 0.0).mirrors[0];
  EXPECT_EQ(mirror.normal, glm::dvec3(0, 0, 1));
  EXPECT_EQ(mirror.axisX, glm::dvec3(1, 0, 0));
  EXPECT_EQ(mirror.axisY, glm::dvec3(0, 1, 0));
}

// Vertices of a mirror may lie a little off its plane, and close to each other. Seen from any eye, the line of each
// edge leaves the mirror on one side.
TEST(Evaluate, NearVerticesOffThePlaneCutNothing) {
  Random random(6);
  for (int round = 0; round < 300; ++round) {
    Mirror mirror;
    const int corners = 3 + round % 6;
    const glm::dmat3 turn = rotationFromDegrees(random.inBox(180.0));
    for (int i = 0; i < corners; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / corners;
      const glm::dvec3 corner(std::cos(angle), std::sin(angle), 0.0);
      for (int copies = random.chance(0.5) ? 1 : 3; copies > 0; --copies) {
        mirror.polygon.push_back(turn * (corner + glm::dvec3(0, 0, std::pow(10.0, random.uniform(-17, -5)))));
      }
    }
    Scene scene = sceneWithCamera();
    ASSERT_EQ(polygonDefect(mirror.polygon).value_or(""), "") << round;
    scene.mirrors = {mirror};
    const std::vector<glm::dvec3> polygon = evaluate(scene, 0.0).mirrors[0].polygon;
    const glm::dvec3 eye = turn * glm::dvec3(random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(0.1, 2));
    for (size_t i = 0; i < polygon.size(); ++i) {
      const glm::dvec3 outward = glm::cross(polygon[i] - eye, polygon[(i + 1) % polygon.size()] - eye);
      for (const glm::dvec3& p : polygon) {
        EXPECT_LT(glm::dot(outward, p - eye), 1e-2 * glm::length(outward)) << round << ", edge " << i;
      }
    }
  }
}

TEST(Evaluate, FarFromTheOriginIsExact) {
  const glm::dvec3 far(1e7, -2e7, 3e7);
  Scene scene = sceneWithObject({.position = far});
  scene.meshes[0].center = glm::dvec3(0.0);
  scene.mirrors.push_back({.position = far, .rotation = {10, 20, 30}, .size = {1, 1}});
  scene.camera.position = far + glm::dvec3(0, 0, 4);
  scene.camera.target = far;
  const SceneState state = evaluate(scene, 1.0);
  EXPECT_EQ(state.instances[0].center, far);
  EXPECT_EQ(state.camera.eye, scene.camera.position);
  Scene near = sceneWithCamera();
  near.mirrors.push_back({.rotation = {10, 20, 30}, .size = {1, 1}});
  EXPECT_EQ(state.mirrors[0].normal, evaluate(near, 1.0).mirrors[0].normal);
}

TEST(LookAt, RowsAreRightUpBack) {
  const CameraPose pose = lookAt({0, 0, 4}, {0, 0, 0}, {0, 5, 5}, 90.0, 0.5);
  EXPECT_EQ(pose.eye, glm::dvec3(0, 0, 4));
  EXPECT_NEAR(pose.verticalFov, std::acos(0.0), 1e-15);
  EXPECT_EQ(pose.near, 0.5);
  expectNear(pose.worldToView * glm::dvec3(1, 0, 0), {1, 0, 0}, 1e-15);
  expectNear(pose.worldToView * glm::dvec3(0, 1, 0), {0, 1, 0}, 1e-15);
  expectNear(pose.worldToView * glm::dvec3(0, 0, -1), {0, 0, -1}, 1e-15);
}

TEST(LookAt, RefusesMissingDirections) {
  EXPECT_THROW(lookAt({1, 2, 3}, {1, 2, 3}, {0, 1, 0}, 60, 0.1), std::invalid_argument);
  EXPECT_THROW(lookAt({0, 0, 0}, {0, -3, 0}, {0, 1, 0}, 60, 0.1), std::invalid_argument);
  EXPECT_THROW(lookAt({0, 0, 0}, {0, 0, 1}, {0, 0, 0}, 60, 0.1), std::invalid_argument);
}

// Three planes through a light. Between the most acute ones the point is nearer, so that it stays beside the light.
TEST(BesideMirrors, IsAsFarFromEachPlane) {
  Random random(5);
  int compared = 0;
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec3 light = random.inBox(2.0);
    std::vector<MirrorState> mirrors(3);
    for (int k = 0; k < 3; ++k) {
      mirrors[k].normal = random.direction();
      mirrors[k].origin = light + glm::cross(mirrors[k].normal, glm::dvec3(random.uniform(-2.0, 2.0), 1.0, 0.5));
      mirrors[k].slack = 1e-9 * (k + 1);
      mirrors[k].plane = k;
    }
    const glm::dvec3 edge = glm::cross(mirrors[0].normal, mirrors[1].normal);
    const glm::dvec3 point = besideMirrors(light, mirrors);
    EXPECT_LT(glm::distance(point, light), 200.0 * 3e-9);
    if (glm::length(edge) < 0.2 || std::abs(glm::dot(edge, mirrors[2].normal)) < 0.2 * glm::length(edge)) {
      continue;
    }
    ++compared;
    for (const MirrorState& mirror : mirrors) {
      EXPECT_NEAR(glm::dot(mirror.normal, point - mirror.origin), 3e-9, 1e-13);
    }
  }
  EXPECT_GT(compared, 1400);
}

// Two mirrors of one plane get layers in their order, those that show their backs last, unless nothing overlaps.
TEST(Layers, AreThoseOfALookAtEveryPair) {
  Random random(17);
  int deepest = 0;
  for (int round = 0; round < 60; ++round) {
    Scene scene = sceneWithCamera();
    const int count = static_cast<int>(random.uniform(2, 120));
    for (int i = 0; i < count; ++i) {
      scene.mirrors.push_back({.position = {random.uniform(-9, 9), random.uniform(-9, 9), -5},
                               .size = {random.uniform(0.2, 4), random.uniform(0.2, 4)},
                               .twoSided = random.chance(0.5)});
    }
    const std::vector<MirrorState> states = evaluate(scene, 0.0).mirrors;
    const auto overlap = [&](int a, int b) {
      const glm::dvec3 gap = glm::abs(scene.mirrors[a].position - scene.mirrors[b].position);
      const glm::dvec2 reach = 0.5 * (scene.mirrors[a].size + scene.mirrors[b].size);
      return gap.x < reach.x && gap.y < reach.y;
    };
    std::vector<int> order(scene.mirrors.size());
    std::iota(order.begin(), order.end(), 0);
    for (const auto side : {&MirrorState::frontLayer, &MirrorState::backLayer}) {
      for (auto i = order.begin(); i != order.end(); ++i) {
        int layer = 0;
        for (auto j = order.begin(); j != i; ++j) {
          layer = overlap(*i, *j) ? std::max(layer, states[*j].*side + 1) : layer;
        }
        ASSERT_EQ(states[*i].*side, layer) << "round " << round << ", mirror " << *i;
        deepest = std::max(deepest, layer);
      }
      std::ranges::stable_sort(order, {}, [&](int i) { return !scene.mirrors[i].twoSided; });
    }
  }
  EXPECT_GT(deepest, 5);
}

// Mirrors on both sides of some planes, most of them small and turned by less than their plane's slack shows.
TEST(MirrorPlanes, AreThoseOfALookAtEveryPair) {
  Random random(29);
  int shared = 0;
  for (int round = 0; round < 40; ++round) {
    Scene scene = sceneWithCamera();
    const glm::dvec3 far = random.inBox(round % 2 * 1e4);
    for (int i = 0; i < 120; ++i) {
      const glm::dvec3 turned(30.0 * static_cast<int>(random.uniform(0, 3)), 0, 0);
      const glm::dmat3 axes = rotationFromDegrees(turned);
      const double offset = 0.01 * static_cast<int>(random.uniform(0, 4));
      const glm::dvec3 turn(random.uniform(-2.5e-3, 2.5e-3), random.chance(0.5) ? 180 : 0, 0);
      scene.mirrors.push_back(
          {.position = far + axes * glm::dvec3(random.uniform(-50, 50), random.uniform(-50, 50), offset),
           .rotation = random.chance(0.2) ? turned : turned + turn,
           .size = glm::dvec2(random.chance(0.2) ? 100.0 : 1e-4)});
    }
    const std::vector<MirrorState> states = evaluate(scene, 0.0).mirrors;
    for (int i = 0; i < static_cast<int>(states.size()); ++i) {
      const auto holds = [&](const MirrorState& first) {
        const double slack = std::max(first.slack, states[i].slack);
        return std::abs(glm::dot(first.normal, states[i].normal)) > 1.0 - 1e-9 &&
               std::ranges::all_of(states[i].polygon, [&](const glm::dvec3& p) {
                 return std::abs(glm::dot(first.normal, p - first.polygon[0])) <= slack;
               });
      };
      int plane = 0;
      while (plane < i && !(states[plane].plane == plane && holds(states[plane]))) {
        ++plane;
      }
      ASSERT_EQ(states[i].plane, plane) << "round " << round << ", mirror " << i;
      shared += plane < i;
    }
  }
  EXPECT_GT(shared, 700);
}

TEST(Environment, BackgroundWithoutSky) {
  const Environment environment{.background = {1, 2, 3}};
  EXPECT_EQ(environment.radiance({0, 1, 0}), glm::dvec3(1, 2, 3));
}

TEST(Environment, SkyIsBlendedByHeight) {
  const Environment environment{.background = {9, 9, 9}, .sky = Sky{{0, 0, 1}, {1, 1, 1}, {0.5, 0, 0}}};
  EXPECT_EQ(environment.radiance({0, 1, 0}), glm::dvec3(0, 0, 1));
  EXPECT_EQ(environment.radiance({1, 0, 0}), glm::dvec3(1, 1, 1));
  // sqrt(0.25) = 0.5 up; 8 * 0.0625 = 0.5 down.
  expectNear(environment.radiance({std::sqrt(1 - 0.0625), 0.25, 0}), {0.5, 0.5, 1}, 1e-15);
  expectNear(environment.radiance({std::sqrt(1 - 0.0625 * 0.0625), -0.0625, 0}), {0.75, 0.5, 0.5}, 1e-15);
  EXPECT_EQ(environment.radiance({0, -0.125, 0}), glm::dvec3(0.5, 0, 0));
  EXPECT_EQ(environment.radiance({0, -1, 0}), glm::dvec3(0.5, 0, 0));
}

}  // namespace
}  // namespace speculum
