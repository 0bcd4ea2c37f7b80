// Animation after an hour's pause, with a clock that goes backwards, after 1e6 s: every transform finite and exact.
#include "geometry/affine.hpp"
#include "plan/scene_changes.hpp"
#include "test_headers.hpp"
#include "transform_support.hpp"

namespace speculum {
namespace {

using namespace hard_cases;

// One of everything that moves. Speeds are no divisors of a turn.
Scene movingScene() {
  Scene scene;
  scene.camera = {.position = {3, 2, 4}, .target = {0, 1, 0}, .orbitSpeed = 7.3};
  scene.meshes.push_back(pointCloud(10, 5));
  scene.objects.push_back({.mesh = 0, .position = {1, 2, 3}, .rotation = {10, 20, 30}, .spin = {1.1, -23.7, 47.3}});
  scene.lights.push_back({.position = {2, 3, 1}, .orbit = Orbit{{0.5, 2, 0}, {0.3, 1, 0.2}, -31.9}});
  scene.mirrors.push_back({.position = {0, 1, -2}, .rotation = {5, 0, 0}, .spin = {0, 12.7, -3.3}, .size = {2, 1}});
  return scene;
}

long double turned(double start, double speed, long double time) {
  return std::fmod(start + static_cast<long double>(speed) * time, 360.0L);
}

LongMat3 longTurn(LongVec3 axis, long double degrees) {
  axis = glm::normalize(axis);
  const long double a = degrees * std::numbers::pi_v<long double> / 180;
  const long double c = std::cos(a);
  const LongMat3 cross(0, axis.z, -axis.y, -axis.z, 0, axis.x, axis.y, -axis.x, 0);
  return c * LongMat3(1) + std::sin(a) * cross + (1 - c) * glm::outerProduct(axis, axis);
}

LongMat3 longRotationAt(const glm::dvec3& rotation, const glm::dvec3& spin, long double time) {
  const LongMat3 x = longTurn({1, 0, 0}, turned(rotation.x, spin.x, time));
  const LongMat3 y = longTurn({0, 1, 0}, turned(rotation.y, spin.y, time));
  return y * x * longTurn({0, 0, 1}, turned(rotation.z, spin.z, time));
}

double difference(const glm::dmat3& actual, const LongMat3& expected) {
  double largest = 0.0;
  for (int c = 0; c < 3; ++c) {
    largest = std::max(largest, glm::length(actual[c] - glm::dvec3(expected[c])));
  }
  return std::isfinite(largest) ? largest : 1e300;
}

// Largest error of a direction or, in metres, of a position.
double errorAt(double time) {
  const Scene scene = movingScene();
  const SceneState state = evaluate(scene, time);
  const Object& object = scene.objects[0];
  double error =
      difference(state.instances[0].worldFromMesh.linear, longRotationAt(object.rotation, object.spin, time));
  const Mirror& mirror = scene.mirrors[0];
  const LongMat3 frame = longRotationAt(mirror.rotation, mirror.spin, time);
  error = std::max(error, difference({state.mirrors[0].axisX, state.mirrors[0].axisY, state.mirrors[0].normal}, frame));
  const Orbit& orbit = *scene.lights[0].orbit;
  const LongVec3 arm = LongVec3(scene.lights[0].position) - LongVec3(orbit.center);
  const LongVec3 light = LongVec3(orbit.center) + longTurn(orbit.axis, turned(0.0, orbit.speed, time)) * arm;
  error = std::max(error, glm::length(state.lights[0].position - glm::dvec3(light)));
  const CameraSpec& camera = scene.camera;
  const LongVec3 eye = LongVec3(camera.target) + longTurn(camera.up, turned(0.0, camera.orbitSpeed, time)) *
                                                     (LongVec3(camera.position) - LongVec3(camera.target));
  error = std::max(error, glm::length(state.camera.eye - glm::dvec3(eye)));
  return std::isfinite(error) ? error : 1e300;
}

// A product of speed and time of 5e7 degrees is known to half of 7e-9 degrees.
TEST(TimeSteps, TransformsAreExactAfterAnyTime) {
  for (const double time : {0.0, 1.0 / 60.0, 3600.0, -3600.0, 86400.0 * 365.0, 1e6, -1e6, 1e6 + 1.0 / 60.0}) {
    const double bound = 1e-14 + 1e-16 * std::abs(time) * 50.0;
    EXPECT_LE(errorAt(time), bound) << time << " s";
  }
  EXPECT_LE(errorAt(1e6), 1e-9);
  std::printf("after 1e6 s: %.1e, after an hour: %.1e\n", errorAt(1e6), errorAt(3600.0));
}

TEST(TimeSteps, RotationsStayRotations) {
  for (const double time : {3600.0, -1e6, 1e6, 1e9, 1e15, 1e300}) {
    const SceneState state = evaluate(movingScene(), time);
    const glm::dmat3& r = state.instances[0].worldFromMesh.linear;
    EXPECT_LE(difference(r * glm::transpose(r), LongMat3(1)), 1e-15) << time;
    EXPECT_NEAR(glm::length(state.mirrors[0].normal), 1.0, 1e-15) << time;
    EXPECT_TRUE(std::isfinite(glm::length(state.lights[0].position + state.camera.eye))) << time;
  }
}

// Turns and ripples after days and after millions of years, against whole numbers: speeds in steps of 2^-20.
TEST(LongTimes, ProductsKeepTheirRemainder) {
  std::mt19937_64 random(11);
  for (const double longest : {1e5, 1e7, 1e9, 1e12, 1e15}) {
    double worst = 0.0;
    for (int i = 0; i < 2000; ++i) {
      const auto time = static_cast<int64_t>(random() % static_cast<uint64_t>(longest));
      const auto steps = static_cast<int64_t>(random() % (int64_t{1} << 40)) - (int64_t{1} << 39);
      constexpr int64_t circle = int64_t{360} << 20;
      const auto rest = static_cast<int64_t>(__int128{steps} * time % circle);
      const double expected = static_cast<double>(rest) / (1 << 20);
      const double actual = productModulo(static_cast<double>(steps) / (1 << 20), static_cast<double>(time), 360.0);
      worst = std::max(worst, std::abs(std::remainder(actual - expected, 360.0)));
    }
    EXPECT_LE(worst, 1e-9) << "after up to " << longest << " s";
  }
}

// An image that nothing changes counts its frames: 2^31 of them in a month at a thousand a second.
TEST(LongTimes, CountersPassTwoToThe31Frames) {
  const Scene scene = movingScene();
  const SceneState state = evaluate(scene, 0.0);
  const auto plan = [&](const FrameCache& cache) { return planFrame({scene, state, Settings(), {64, 36}, cache}); };
  SceneChanges changes;
  changes.update(scene, state);
  FramePlan last = plan({.changes = &changes});
  ASSERT_FALSE(last.cached.empty());
  last.cached[0].unchangedFor = std::numeric_limits<int>::max() - 2;
  for (int frame = 0; frame < 4; ++frame) {
    const RecycledVector<CachedImage> before = last.cached;
    last = plan({.images = before, .changes = &changes});
    ASSERT_FALSE(last.cached.empty());
    EXPECT_GT(last.cached[0].unchangedFor, 0);
  }
}

}  // namespace
}  // namespace speculum
