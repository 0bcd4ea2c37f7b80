// reflection.mesh_error and view.mesh_error: which objects are drawn with how many triangles, by the planner alone.
#include "frame/mesh_level.hpp"
#include "frame_support.hpp"
#include "geometry/mesh_clusters.hpp"
#include "random.hpp"
#include "reference_scenes.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

using testing_support::Random;
using testing_support::wall;

// A mirror 10 m before the camera, and balls behind it at these distances from the mirror.
Scene sceneOf(const std::vector<double>& distances, double scale = 0.5) {
  Scene scene = testing_support::sceneWith({wall({0, 0, -10}, 0, {8, 8})});
  scene.meshes = {testing::sphereMesh(24)};
  for (const double distance : distances) {
    scene.objects.push_back(testing_support::objectAt({0, 0, distance - 10.0}, glm::dvec3(scale)));
  }
  scene.lights = {{.position = {0, 5, 0}, .glow = 0.0}};
  return scene;
}

FramePlan levelPlan(const Scene& scene, double meshError, std::vector<std::pair<std::string, std::string>> more = {}) {
  Settings settings = settingsOf(scene);
  settings.reflection.meshError = meshError;
  for (const auto& [key, value] : more) {
    EXPECT_EQ(setSetting(settings, key, value), std::nullopt);
  }
  return planFrame(scene, evaluate(scene, 0.0), settings, 640, 360);
}

TEST(MeshError, ZeroDrawsAllTriangles) {
  const FramePlan plan = levelPlan(sceneOf({12, 60}), 0.0);
  ASSERT_EQ(plan.drawnMirrors().size(), 1u);
  EXPECT_EQ(plan.drawnMirrors()[0].instances.size(), 2u);
  EXPECT_TRUE(plan.drawnMirrors()[0].simplified.empty());
  EXPECT_TRUE(meshesWithLevels(plan, evaluate(sceneOf({12, 60}), 0.0)).empty());
}

TEST(MeshError, LevelsGrowWithDistanceAndError) {
  const Scene scene = sceneOf({12, 25, 50, 100, 200});
  std::vector<int> before(5, -1);
  for (const double error : {0.125, 0.25, 0.5, 1.0, 2.0, 4.0}) {
    const FramePlan plan = levelPlan(scene, error);
    ASSERT_EQ(plan.drawnMirrors().size(), 1u);
    EXPECT_TRUE(plan.main().simplified.empty()) << "what is seen directly is exact";
    for (int i = 0; i < 5; ++i) {
      const int level = levelOf(plan.drawnMirrors()[0], i);
      EXPECT_GE(level, before[i]);
      EXPECT_GE(level, i == 0 ? -1 : levelOf(plan.drawnMirrors()[0], i - 1));
      before[i] = level;
    }
    if (error == 0.5) {
      EXPECT_GT(before[4], before[2]);
      EXPECT_GT(before[2], before[0]);
    }
  }
  EXPECT_EQ(meshesWithLevels(levelPlan(scene, 4.0), evaluate(scene, 0.0)), std::vector<int>{0});
}

TEST(MeshError, MainViewHasItsOwn) {
  Scene scene = sceneOf({12, 25, 50, 100, 200});
  EXPECT_TRUE(levelPlan(scene, 0.0, {{"view.mesh_error", "1"}}).drawnMirrors()[0].simplified.empty());
  scene.camera.target = {0, 0, 10};
  const FramePlan plan = levelPlan(scene, 0.0, {{"view.mesh_error", "1"}});
  EXPECT_FALSE(plan.main().simplified.empty());
  EXPECT_EQ(meshesWithLevels(plan, evaluate(scene, 0.0)), std::vector<int>{0});
  EXPECT_TRUE(levelPlan(scene, 0.0, {{"view.mesh_error", "1"}, {"reflection.clip", "none"}}).main().simplified.empty());
}

TEST(MeshError, EveryLevelKeepsTheBound) {
  const Scene scene = sceneOf({12, 25, 50, 100, 200});
  const SceneState state = evaluate(scene, 0.0);
  int simplified = 0;
  for (const double error : {0.25, 1.0, 4.0}) {
    const FramePlan plan = levelPlan(scene, error);
    const Pass& pass = plan.drawnMirrors()[0];
    for (const SimplifiedInstance& s : pass.simplified) {
      const MeshLevel& level = levelsOf(scene.meshes[0]).levels[s.level];
      EXPECT_LE(level.error,
                largestError(pass.view, plan.projection, state.instances[s.instance], scene.meshes[0], error));
      ++simplified;
    }
  }
  EXPECT_GT(simplified, 5);
}

TEST(MeshError, FinerImagesShowMore) {
  const Scene scene = sceneOf({40});
  const auto level = [&](const char* scale) {
    return levelOf(levelPlan(scene, 0.5, {{"reflection.scale", scale}}).drawnMirrors()[0], 0);
  };
  EXPECT_GT(level("0.25"), level("1"));
  EXPECT_GT(level("1"), level("4"));
}

TEST(MeshError, TracedRaysKeepAllTriangles) {
  Scene scene = sceneOf({30, 60});
  EXPECT_FALSE(levelPlan(scene, 2.0).drawnMirrors()[0].simplified.empty());
  scene.lights[0].castsShadow = true;
  EXPECT_TRUE(levelPlan(scene, 2.0).drawnMirrors()[0].simplified.empty());
  EXPECT_FALSE(levelPlan(scene, 2.0, {{"effects.shadows", "false"}}).drawnMirrors()[0].simplified.empty());
  scene.lights[0].castsShadow = false;
  scene.objects[0].mirror.emplace();
  EXPECT_TRUE(levelPlan(scene, 2.0).drawnMirrors()[0].simplified.empty()) << "rays of a curved mirror";
  const FramePlan mapped = levelPlan(scene, 2.0, {{"effects.curved_lookup", "environment"}});
  ASSERT_EQ(mapped.drawnMirrors()[0].simplified.size(), 1u) << "a curved mirror itself stays exact";
  EXPECT_EQ(mapped.drawnMirrors()[0].simplified[0].instance, 1);
}

TEST(MeshError, FacesOfEnvironmentMapsShareLevels) {
  Scene scene = sceneOf({30});
  scene.objects[0].mirror.emplace();
  const glm::dvec3 center = scene.objects[0].position;
  scene.objects.push_back(testing_support::objectAt(center + glm::dvec3(20, 0, 20), glm::dvec3(2.0)));
  const SceneState state = evaluate(scene, 0.0);
  for (const double meshError : {0.0, 2.0}) {
    const FramePlan plan = levelPlan(scene, meshError, {{"effects.curved_lookup", "environment"}});
    ASSERT_EQ(plan.cubes.size(), 1u);
    std::optional<int> shared;
    int faces = 0;
    for (const Pass& face : plan.passes) {
      if (!face.isFace()) {
        continue;
      }
      faces += static_cast<int>(face.instances.size());
      for (const int i : face.instances) {
        const int level = levelOf(face, i);
        EXPECT_EQ(shared.value_or(level), level);
        shared = level;
        if (level >= 0) {
          EXPECT_LE(levelsOf(scene.meshes[0]).levels[static_cast<size_t>(level)].error,
                    largestError(face.view, face.projection, state.instances[static_cast<size_t>(i)], scene.meshes[0],
                                 meshError));
        }
      }
    }
    EXPECT_EQ(faces, 2) << "that show the ball";
    EXPECT_EQ(shared.value_or(-1) >= 0, meshError > 0.0);
  }
}

// An object would stand in the shadow of a level of its own that differs.
TEST(MeshError, OneLevelInPassesAndShadowMaps) {
  Scene scene = sceneOf({5, 20, 60});
  scene.objects.push_back(testing_support::objectAt({3, 0, -8}, glm::dvec3(0.5)));  // in the main view too
  scene.lights[0].castsShadow = true;
  const SceneState state = evaluate(scene, 0.0);
  for (const double viewError : {0.0, 1.0}) {
    const FramePlan plan = levelPlan(scene, 4.0,
                                     {{"effects.shadow_lookup", "map"},
                                      {"effects.shadow_map_size", "64"},
                                      {"view.mesh_error", viewError > 0.0 ? "1" : "0"}});
    std::vector<std::optional<int>> levels(scene.objects.size());
    const auto check = [&](const Pass& pass, const Projection& projection, double texels) {
      for (const int i : pass.instances) {
        const InstanceState& instance = state.instances[static_cast<size_t>(i)];
        const int level = levelOf(pass, i);
        EXPECT_EQ(levels[static_cast<size_t>(i)].value_or(level), level);
        levels[static_cast<size_t>(i)] = level;
        if (level >= 0) {
          EXPECT_LE(levelsOf(scene.meshes[0]).levels[static_cast<size_t>(level)].error,
                    largestError(pass.view, projection, instance, scene.meshes[0], texels));
        }
      }
    };
    check(plan.main(), plan.projection, viewError);
    ASSERT_FALSE(plan.drawnMirrors().empty());
    for (const Pass& pass : plan.drawnMirrors()) {
      check(pass, plan.projection, 4.0);
    }
    ASSERT_EQ(plan.cubes.size(), 1u);
    for (const Pass& face : plan.passes) {
      if (face.isFace() && face.drawn()) {
        check(face, face.projection, viewError > 0.0 ? 2.0 : 0.0);
      }
    }
    EXPECT_EQ(levels[2] >= 0, viewError > 0.0) << "its shadow may fall into the main view";
    EXPECT_EQ(levels[3] >= 0, viewError > 0.0);
  }
}

// Two small balls in opposite corners of their box, of which a view may see an empty part.
Mesh ballsInCorners() {
  Mesh mesh;
  for (const double side : {-1.0, 1.0}) {
    const Mesh ball = testing::sphereMesh(24);
    const auto first = static_cast<uint32_t>(mesh.vertices.size());
    for (const Vertex& v : ball.vertices) {
      mesh.vertices.push_back({0.2 * v.position + glm::dvec3(0.8 * side), v.normal, v.uv});
    }
    for (const uint32_t index : ball.indices) {
      mesh.indices.push_back(first + index);
    }
  }
  mesh.parts = {{.indexCount = static_cast<uint32_t>(mesh.indices.size())}};
  mesh.halfExtent = glm::dvec3(1.0);
  mesh.radius = std::sqrt(3.0);
  sortIntoClusters(mesh);
  mesh.clusters = clustersOf(mesh);
  return mesh;
}

// Clusters that are left out change no level of what is drawn, so that pictures without culling are the same.
TEST(MeshError, LevelsDoNotDependOnCulling) {
  Random random(17);
  Scene empty = sceneOf(std::vector<double>{});
  empty.meshes = {ballsInCorners()};
  levelsOf(empty.meshes[0]);  // copies of the mesh share them
  int levels = 0;
  int partial = 0;
  int leftOut = 0;
  for (int round = 0; round < 300; ++round) {
    Scene scene = empty;
    scene.mirrors.push_back(wall({random.uniform(-3, 3), 0, -4}, random.uniform(-60, 60), {1, 1}));
    for (int i = 0; i < 12; ++i) {
      Object object = testing_support::objectAt(random.inBox(12.0), glm::dvec3(random.uniform(0.2, 6)));
      object.rotation = random.inBox(180.0);
      object.scale.y *= random.uniform(0.1, 1);
      scene.objects.push_back(object);
    }
    scene.lights[0].position = random.inBox(6.0);
    scene.lights[0].castsShadow = round % 2 == 0;
    const auto planWith = [&](const char* culls) {
      return levelPlan(scene, 2.0,
                       {{"view.mesh_error", "1"}, {"effects.shadow_lookup", "map"}, {"debug.cull_clusters", culls}});
    };
    const FramePlan culled = planWith("true");
    const FramePlan whole = planWith("false");
    const auto compare = [&](const Pass& some, const Pass& all) {
      EXPECT_TRUE(all.partial.empty());
      EXPECT_TRUE(std::ranges::includes(all.instances, some.instances));
      partial += static_cast<int>(some.partial.size());
      leftOut += static_cast<int>(all.instances.size() - some.instances.size());
      for (const int i : some.instances) {
        EXPECT_EQ(levelOf(some, i), levelOf(all, i)) << "object " << i << " in round " << round;
        levels += levelOf(some, i) >= 0 ? 1 : 0;
      }
    };
    ASSERT_EQ(culled.passes.size(), whole.passes.size());
    for (size_t i = 0; i < culled.passes.size(); ++i) {
      if (culled.passes[i].drawn()) {
        EXPECT_TRUE(whole.passes[i].drawn());
        compare(culled.passes[i], whole.passes[i]);
      }
    }
  }
  EXPECT_GT(levels, 1000);
  EXPECT_GT(partial, 1000);
  EXPECT_GT(leftOut, 200);
}

TEST(MeshError, ObjectsAtTheEyeAreExact) {
  Scene scene = sceneOf({11}, 30.0);
  EXPECT_TRUE(levelPlan(scene, 0.5).drawnMirrors()[0].simplified.empty());
}

TEST(MeshError, PartlySeenBallsAreDrawnInPart) {
  Scene scene = sceneOf({30}, 6.0);
  scene.mirrors[0].size = {0.5, 0.5};
  const FramePlan plan = levelPlan(scene, 1.0);
  const Pass& pass = plan.drawnMirrors()[0];
  ASSERT_EQ(pass.simplified.size(), 1u);
  const MeshLevels& levels = levelsOf(scene.meshes[0]);
  const MeshLevel& level = levels.levels[pass.simplified[0].level];
  ASSERT_FALSE(level.clusters.empty());
  ASSERT_EQ(pass.partial.size(), 1u);
  EXPECT_LT(indexCount(pass.partial[0].ranges), level.all.count);
  for (const PartialInstance& partial : pass.partial) {
    for (const IndexRange& range : partial.ranges) {
      EXPECT_GE(range.first, level.all.first);
      EXPECT_LE(range.first + range.count, level.all.first + level.all.count);
    }
  }
}

// Two points of an instance, as far apart as the largest error allows, are seen no more than the set texels apart: in
// the only mirror of random scenes, or in the main view of those without.
void expectBoundHolds(Scene (*randomScene)(Random&)) {
  Random random(11);
  double tightest = 0.0;
  int compared = 0;
  for (int round = 0; round < 2000; ++round) {
    const Scene scene = randomScene(random);
    const SceneState state = evaluate(scene, 0.0);
    const FramePlan plan = planFrame(scene, state, {}, 640, 360);
    const Pass& pass = plan.drawnMirrors().empty() ? plan.main() : plan.drawnMirrors()[0];
    const double bound = random.uniform(0.1, 16.0);
    if (pass.instances.empty() || plan.drawnMirrors().size() != scene.mirrors.size()) {
      continue;
    }
    const double error = largestError(pass.view, plan.projection, state.instances[0], scene.meshes[0], bound);
    for (int pair = 0; pair < 50 && error > 0.0; ++pair) {
      const glm::dvec3 p = random.inBox(1.0);
      const glm::dvec3 q = glm::clamp(p + error * random.direction(), glm::dvec3(-1), glm::dvec3(1));
      const std::array<glm::dvec3, 2> points{state.instances[0].worldFromMesh.point(p),
                                             state.instances[0].worldFromMesh.point(q)};
      if (!sphereVisible(pass.view, points[0], 0.0)) {
        continue;
      }
      const auto clip = toClip(pass.view, plan.projection, points);
      const glm::dvec2 apart = glm::dvec2(clip[0]) / clip[0].w - glm::dvec2(clip[1]) / clip[1].w;
      const double texels = glm::length(apart * 0.5 * pass.view.pictureSize);
      ASSERT_LE(texels, bound * (1.0 + 1e-9));
      tightest = std::max(tightest, texels / bound);
      ++compared;
    }
  }
  EXPECT_GT(compared, 1000);
  EXPECT_GT(tightest, 0.7) << "far too careful";
}

TEST(MeshError, BoundHoldsForAnyTwoPoints) {
  expectBoundHolds([](Random& random) {
    Scene scene = sceneOf({random.uniform(0.2, 10)});
    scene.objects[0].position += random.inBox(4.0);
    scene.objects[0].rotation = random.inBox(180.0);
    scene.objects[0].scale = {random.uniform(0.2, 2), random.uniform(0.2, 2), random.uniform(0.2, 2)};
    scene.mirrors[0].position += random.inBox(3.0);
    scene.mirrors[0].rotation = random.inBox(30.0);
    return scene;
  });
}

// A floor or ceiling reaches behind the eye, but its visible part does not.
TEST(MeshError, BoundHoldsBesideTheEye) {
  expectBoundHolds([](Random& random) {
    Scene scene = sceneOf({0.0});
    scene.mirrors.clear();
    scene.objects[0].position = scene.camera.position + random.inBox(3.0);
    scene.objects[0].rotation = random.inBox(random.chance(0.5) ? 180.0 : 10.0);
    scene.objects[0].scale = {random.uniform(0.01, 5), random.uniform(0.01, 1), random.uniform(0.01, 5)};
    return scene;
  });
}

}  // namespace
}  // namespace speculum
