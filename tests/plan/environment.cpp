// Environment maps: which curved mirrors have one, what is in it, when it is rendered. Without a GPU.
#include "plan/cube_face.hpp"
#include "plan/effects.hpp"
#include "plan/fitted_plan.hpp"
#include "plan/support.hpp"
#include "plan/target_memory.hpp"
#include "plan/traced_effects.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

using testing_support::objectAt;

constexpr int width = 320;
constexpr int height = 180;

enum { ballObject, wallObject, boxObject };  // indices

// A curved mirror before the camera, a wall 4 m to its right whose near face is at x = 3.5, and a box behind the
// camera.
Scene ballRoom() {
  Scene scene = testing_support::sceneWith({});
  scene.meshes = {testing_support::cube(0.5, 0.9)};
  scene.objects = {objectAt({0, 0, -4}), objectAt({4, 0, -4}, {1, 8, 8}), objectAt({0, 0, 6})};
  scene.objects[ballObject].mirror.emplace();
  scene.objects[ballObject].name = "ball";
  scene.lights = {{.position = {0, 2, 0}, .glow = 0.0}};
  return scene;
}

class MapFrames : public testing_support::PlanSequence {
 public:
  explicit MapFrames(Scene s) : PlanSequence(std::move(s)) {
    settings.effects.curvedLookup = CurvedLookup::environment;
  }
  // Maps that the next frame renders.
  int rendered() {
    next();
    return static_cast<int>(std::ranges::count(plan.cubes, -1, &Cube::cacheIndex));
  }
};

TEST(EnvironmentMap, ExistsWhereACurvedMirrorIsDrawn) {
  MapFrames frames(ballRoom());
  ASSERT_EQ(frames.next().cubes.size(), 1u);
  EXPECT_EQ(frames.plan.cubes[0].name, "object 'ball'");
  EXPECT_EQ(frames.plan.cubes[0].object, ballObject);
  frames.settings.effects.curvedLookup = CurvedLookup::traced;
  EXPECT_TRUE(frames.next().cubes.empty());
  frames.settings.effects.curvedLookup = CurvedLookup::environment;
  frames.settings.effects.curved = false;
  EXPECT_TRUE(frames.next().cubes.empty());
  frames.settings.effects.curved = true;
  frames.scene.camera.target = {0, 0, 1};
  EXPECT_TRUE(frames.next().cubes.empty()) << "out of sight";
  frames.scene.mirrors = {testing_support::wall({0, 0, 3}, 180, {4, 4})};
  EXPECT_EQ(frames.next().cubes.size(), 1u) << "seen in a mirror";
}

TEST(EnvironmentMap, NeedsNoRays) {
  MapFrames frames(ballRoom());
  frames.next();
  const SceneState state = evaluate(frames.scene, 0.0);
  EXPECT_EQ(frames.plan.effects.curved, "object 'ball'");
  EXPECT_FALSE(frames.plan.effects.any());
  const FittedPlan fitted = planWithin({.budgetBytes = 1ull << 40, .largestSide = 4096, .whyNoRays = "no room"},
                                       {frames.scene, state, frames.settings, {width, height}});
  EXPECT_EQ(fitted.plan.cubes.size(), 1u) << "a device that cannot trace rays draws it";
  EXPECT_TRUE(fitted.message.empty());
  frames.settings.effects.curvedLookup = CurvedLookup::traced;
  const FittedPlan traced = planWithin({.budgetBytes = 1ull << 40, .largestSide = 4096, .whyNoRays = "no room"},
                                       {frames.scene, state, frames.settings, {width, height}});
  EXPECT_EQ(traced.plan.cubes.size(), 1u) << "a map in the place of rays";
}

// Every direction lies in a face that draws what stands there. No face draws the mirror itself.
TEST(EnvironmentMap, FacesCoverAllDirections) {
  MapFrames frames(ballRoom());
  for (int step = 0; step < 40; ++step) {
    const double angle = 2.399963 * step;  // the golden angle: evenly over the sphere
    const double y = 1.0 - 2.0 * (step + 0.5) / 40.0;
    const double r = std::sqrt(1.0 - y * y);
    frames.scene.objects[boxObject].position =
        frames.scene.objects[ballObject].position + 9.0 * glm::dvec3(r * std::cos(angle), y, r * std::sin(angle));
    const Cube& map = frames.next().cubes.at(0);
    const SceneState state = evaluate(frames.scene, 0.0);
    int seen = 0;
    for (size_t i = 0; i < map.faces.size(); ++i) {
      const Pass& face = testing_support::faceOf(frames.plan, map, i);
      EXPECT_EQ(face.id,
                (PassId{.kind = PassKind::environment, .instance = map.instance, .face = static_cast<int>(i)}));
      for (const int instance : face.instances) {
        EXPECT_NE(state.instances[static_cast<size_t>(instance)].object, ballObject);
        seen += state.instances[static_cast<size_t>(instance)].object == boxObject;
      }
    }
    EXPECT_GE(seen, 1) << "direction " << step;
  }
  // A face's edge lies a texel within its image.
  const Cube& map = frames.plan.cubes[0];
  const Pass& face = testing_support::faceOf(frames.plan, map, 0);
  const glm::dvec4 clip = face.projection.clip(face.view.worldToView * glm::dvec3(1, 1, 1));
  EXPECT_NEAR((0.5 + 0.5 * clip.x / clip.w) * map.size, map.size - environmentBorder, 1e-9);
  EXPECT_GT(clip.w, 0.0);
}

TEST(EnvironmentMap, BoxReachesTheNearestFacesAround) {
  MapFrames frames(ballRoom());
  const Cube& map = frames.next().cubes.at(0);
  EXPECT_NEAR(map.high.x, 3.5, 1e-12) << "the wall's near face";
  EXPECT_NEAR(map.high.z, 5.5, 1e-12) << "the box's";
  EXPECT_NEAR(map.low.x, -0.5, 1e-12) << "nothing there: the end of all there is";
  EXPECT_NEAR(map.low.z, -8.0, 1e-12) << "the wall's end";
  frames.scene.objects.push_back(objectAt({0, 0, 0}, {30, 20, 40}));
  EXPECT_EQ(frames.next().cubes.at(0).low, glm::dvec3(-15, -10, -20)) << "a room around everything";
  EXPECT_EQ(frames.plan.cubes.at(0).high, glm::dvec3(15, 10, 20));
}

TEST(EnvironmentMap, IsRenderedWhenItsContentChanged) {
  MapFrames frames(ballRoom());
  EXPECT_EQ(frames.rendered(), 1);
  EXPECT_EQ(frames.rendered(), 0);
  const uint64_t serial = frames.plan.cubes[0].serial;
  frames.scene.camera.position.x += 0.1;
  frames.scene.camera.target.x += 0.1;
  EXPECT_EQ(frames.rendered(), 0) << "a map does not depend on who looks";
  frames.settings.view.scale = 0.5;
  EXPECT_EQ(frames.rendered(), 0) << "nor on the resolution of the picture";
  EXPECT_EQ(frames.plan.cubes[0].serial, serial);
  frames.scene.objects[boxObject].color = glm::dvec3(0.5);
  EXPECT_EQ(frames.rendered(), 1);
  EXPECT_GT(frames.plan.cubes[0].serial, serial);
  frames.scene.objects[ballObject].position.y += 0.1;
  EXPECT_EQ(frames.rendered(), 1);
  frames.scene.objects[ballObject].mirror->reflectance *= 0.5;
  EXPECT_EQ(frames.rendered(), 0) << "its own color is not in it";
  frames.settings.effects.environmentSize = 64;
  EXPECT_EQ(frames.rendered(), 1);
  EXPECT_EQ(frames.plan.cubes[0].size, 64);
  frames.settings.reflection.skipUnchanged = false;
  EXPECT_EQ(frames.rendered(), 1);
  EXPECT_EQ(frames.rendered(), 1);
}

TEST(EnvironmentMap, TakesTurnsWithAnInterval) {
  Scene scene = ballRoom();
  scene.objects[ballObject].copies = {.count = 4, .step = {0, 0.6, 0}};
  MapFrames frames(scene);
  frames.settings.effects.environmentInterval = 4;
  for (const int size : {64, 32}) {
    frames.settings.effects.environmentSize = size;
    EXPECT_EQ(frames.rendered(), 4);
    for (int frame = 0; frame < 8; ++frame) {
      frames.scene.lights[0].position.x += 0.1;
      EXPECT_EQ(frames.rendered(), 1) << "frame " << frame;
    }
  }
}

// An image that shows a map is as old as the map.
TEST(EnvironmentMap, ImagesThatShowItAreRenderedToo) {
  Scene scene = ballRoom();
  scene.mirrors = {testing_support::wall({0, -2, -4}, 0, {6, 6})};
  scene.mirrors[0].rotation = {-90, 0, 0};
  MapFrames frames(scene);
  frames.settings.effects.environmentInterval = 3;
  frames.next();
  ASSERT_EQ(frames.plan.drawnMirrors().size(), 1u);
  for (int frame = 0; frame < 6; ++frame) {
    frames.scene.objects[boxObject].position.y += frame == 0 ? 0.1 : 0.0;
    const uint64_t serial = frames.plan.cubes[0].serial;
    frames.next();
    const bool mapIsNew = frames.plan.cubes[0].serial != serial;
    EXPECT_EQ(frames.plan.drawnMirrors().size(), frame == 0 || mapIsNew ? 1u : 0u) << "frame " << frame;
  }
}

TEST(EnvironmentMap, OnlyTheWidestMirrorsHaveOne) {
  Scene scene = ballRoom();
  scene.objects[ballObject].copies = {.count = 50, .step = {0, 0, -0.3}};
  MapFrames frames(scene);
  ASSERT_EQ(frames.next().cubes.size(), mostEnvironmentMaps);
  for (const Cube& map : frames.plan.cubes) {
    EXPECT_LT(map.copy, static_cast<int>(mostEnvironmentMaps)) << "the nearest";
  }
  EXPECT_TRUE(frames.plan.effects.curved->ends_with("; 32 have environment maps, 18 more show the background"));
}

TEST(EnvironmentMap, MemoryIncludesItAndLowersIt) {
  MapFrames frames(ballRoom());
  frames.next();
  FramePlan without = frames.plan;
  without.cubes.clear();
  const uint64_t bytes = 6ull * 256 * 256 * (8 + 4);
  EXPECT_EQ(environmentBytes(frames.plan), bytes);
  EXPECT_EQ(targetBytes(frames.plan, frames.settings), targetBytes(without, frames.settings) + bytes);
  const FittedPlan fitted = planWithin({.budgetBytes = 1'500'000, .largestSide = 4096},
                                       {frames.scene, evaluate(frames.scene, 0.0), frames.settings, {width, height}});
  EXPECT_LT(fitted.settings.effects.environmentSize, 256);
  EXPECT_LE(targetBytes(fitted.plan, fitted.settings), 1'500'000u);
  EXPECT_TRUE(contains(fitted.message, "effects.environment_size to 128"));
}

}  // namespace
}  // namespace speculum
