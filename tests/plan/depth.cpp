#include "plan/depth_readout.hpp"
#include "plan/support.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

// The camera looks along -z at a mirror 2 m away, which shows what is behind it.
Scene mirrorScene() {
  return testing_support::sceneWith({testing_support::wall({0, 0, -2}, 0)});
}

void addBody(Scene& scene, SceneState& state, const glm::dvec3& center, double radius) {
  InstanceState instance{.object = static_cast<int>(scene.objects.size()),
                         .mesh = static_cast<int>(scene.meshes.size()),
                         .center = center,
                         .radius = radius};
  instance.worldFromMesh.translation = center;
  scene.meshes.push_back({.halfExtent = glm::dvec3(radius), .radius = radius});
  scene.objects.emplace_back().mesh = instance.mesh;
  state.instances.push_back(instance);
}

FramePlan depthPlan(const Scene& scene, const SceneState& state) {
  return planFrame({scene, state, Settings(), {640, 360}});
}

std::optional<DepthReadout> readoutOf(const Scene& scene, const SceneState& state) {
  const FramePlan plan = depthPlan(scene, state);
  return depthReadout(plan.drawnMirrors()[0], plan.projection, scene, state);
}

TEST(DepthReadout, NothingFiniteIsSeen) {
  const Scene scene = mirrorScene();
  EXPECT_FALSE(readoutOf(scene, evaluate(scene, 0.0)));
}

TEST(DepthReadout, DistanceIsThatOfTheReflectedPath) {
  Scene scene = mirrorScene();
  SceneState state = evaluate(scene, 0.0);
  addBody(scene, state, {0, 0, 3}, 0.5);
  addBody(scene, state, {0, 0, 10}, 0.25);
  const auto readout = readoutOf(scene, state);
  ASSERT_TRUE(readout);
  EXPECT_NEAR(readout->distance, 2 + 2 + 10 + 0.25, 1e-9);
}

TEST(DepthReadout, BodiesCountWhereTheyReachTheView) {
  Scene scene = mirrorScene();
  SceneState state = evaluate(scene, 0.0);
  addBody(scene, state, {40, 0, 10}, 35.0);
  const FramePlan plan = depthPlan(scene, state);
  ASSERT_EQ(plan.drawnMirrors()[0].instances.size(), 1u);
  const auto farthest = farthestVisible(plan.drawnMirrors()[0], plan.projection, scene, state);
  ASSERT_TRUE(farthest);
  // The farthest of many points of the sphere that the view sees.
  const View& view = plan.drawnMirrors()[0].view;
  double seen = 0.0;
  for (int i = 0; i < 200000; ++i) {
    const double z = 1.0 - 2.0 * (i + 0.5) / 200000;
    const double turn = 2.399963229728653 * i;
    const glm::dvec3 on(std::sqrt(1 - z * z) * std::cos(turn), std::sqrt(1 - z * z) * std::sin(turn), z);
    const glm::dvec3 p = glm::dvec3(40, 0, 10) + 35.0 * on;
    if (sphereVisible(view, p, 0.0)) {
      seen = std::max(seen, glm::length(p - view.eye));
    }
  }
  EXPECT_GT(seen, 20.0);
  EXPECT_GE(glm::length(farthest->point), seen);
  EXPECT_LT(glm::length(farthest->point), 1.3 * seen) << "the farthest point of the sphere itself is 80 m away";
}

TEST(DepthReadout, MirrorsAndGlyphsCount) {
  Scene scene = mirrorScene();
  scene.mirrors.push_back(scene.mirrors[0]);
  scene.mirrors[1].position = {0, 0, 5};
  scene.mirrors[1].rotation = {0, 180, 0};
  const SceneState state = evaluate(scene, 0.0);
  const FramePlan plan = depthPlan(scene, state);
  const auto direct =
      std::ranges::find(plan.drawnMirrors(), 0, [](const Pass& pass) { return depthOf(pass.view.path); });
  const auto readout = depthReadout(*direct, plan.projection, scene, state);
  ASSERT_TRUE(readout);
  EXPECT_GE(readout->distance, 9.0);
  EXPECT_LT(readout->distance, 9.3);

  Scene lit = mirrorScene();
  lit.lights = {{.position = {0, 0, 6}, .radius = 0.1}};
  EXPECT_NEAR(readoutOf(lit, evaluate(lit, 0.0))->distance, 10.1, 1e-9);
}

// Returns the readout for a large mirror `h` metres before an eye that looks at it at `degrees` from the normal, and a
// body where the line of sight leads. At 0 degrees an oblique near plane is an ordinary one.
std::optional<DepthReadout> nearMirrorReadout(double h, double degrees) {
  Scene scene = mirrorScene();
  scene.mirrors[0].position = {0, 0, -h};
  scene.mirrors[0].size = {1e3, 1e3};
  const double a = glm::radians(degrees);
  scene.camera.target = {std::sin(a), 0, -std::cos(a)};
  SceneState state = evaluate(scene, 0.0);
  addBody(scene, state, glm::dvec3(0, 0, -2 * h) + 50.0 * glm::dvec3(std::sin(a), 0, std::cos(a)), 0.25);
  return readoutOf(scene, state);
}

TEST(DepthReadout, ObliqueDegradesWithTheEyesDistance) {
  double before = 0.0;
  for (const double h : {2.0, 0.2, 0.02}) {
    const auto readout = nearMirrorReadout(h, 45.0);
    ASSERT_TRUE(readout && readout->oblique && readout->plain);
    EXPECT_NEAR(readout->distance, 50.25, 1e-9);
    EXPECT_GT(*readout->oblique, 4.0 * *readout->plain);
    EXPECT_GT(*readout->oblique, 8.0 * before);
    EXPECT_EQ(gapWith(*readout, ClipMethod::clipDistance), readout->plain);
    EXPECT_EQ(gapWith(*readout, ClipMethod::oblique), readout->oblique);
    EXPECT_EQ(gapWith(*readout, ClipMethod::none), readout->plain);
    before = *readout->oblique;
  }
  EXPECT_FALSE(nearMirrorReadout(1e-6, 45.0)->oblique);
  EXPECT_TRUE(nearMirrorReadout(1e-6, 45.0)->plain);
  const auto straight = nearMirrorReadout(1e-3, 0.0);
  EXPECT_NEAR(*straight->oblique, *straight->plain, 0.1 * *straight->plain);
}

}  // namespace
}  // namespace speculum
