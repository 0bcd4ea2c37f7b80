#include "geometry/polygon.hpp"
#include "reference/ray_tracer.hpp"
#include "reference/scenes.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

using std::numbers::pi;
using testing::mirrorOf;

const std::vector<glm::dvec3> wallFacingZ = {{-5, -5, 0}, {5, -5, 0}, {5, 5, 0}, {-5, 5, 0}};
const std::vector<glm::dvec3> wallFacingMinusZ = {{5, -5, 2}, {-5, -5, 2}, {-5, 5, 2}, {5, 5, 2}};

Scene emptyScene(const glm::dvec3& background) {
  Scene scene;
  scene.environment.background = background;
  scene.camera = testing::cameraAt({0, 0, 1}, {0, 0, 0});
  return scene;
}

glm::dvec3 look(const Scene& scene, const glm::dvec3& origin, const glm::dvec3& direction,
                const TraceOptions& options = {}) {
  const SceneState state = evaluate(scene, 0.0);
  return RayTracer(scene, state).radiance(options, origin, direction);
}

void expectNear(const glm::dvec3& a, const glm::dvec3& b, double tolerance) {
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(a[c], b[c], tolerance) << "channel " << c;
  }
}

// A glowing sphere of 1 cm is seen exactly where its image in the two mirrors lies.
TEST(ReferenceMirrors, TwoMirrorsShowAPointsImages) {
  const double angle = 50.0 * pi / 180.0;
  const glm::dvec3 inPlane(std::cos(angle), 0.0, std::sin(angle));
  Scene scene = emptyScene({0, 0, 0});
  scene.mirrors.push_back(mirrorOf({{0, -4, 0}, {8, -4, 0}, {8, 4, 0}, {0, 4, 0}}));
  const glm::dvec3 up(0, 4, 0);
  const std::vector<glm::dvec3> second = {-up, up, 8.0 * inPlane + up, 8.0 * inPlane - up};
  scene.mirrors.push_back(mirrorOf(second));
  scene.camera = testing::cameraAt({3, 0.2, 1.8}, {0, 0, 0});
  scene.lights.push_back({.position = {2.0, 0.3, 0.7}, .radius = 0.01, .glow = 1.0});
  const SceneState state = evaluate(scene, 0.0);
  ASSERT_GT(glm::dot(state.mirrors[0].normal, scene.lights[0].position), 0.0);
  for (MirrorState const& m : state.mirrors) {
    ASSERT_GT(glm::dot(m.normal, scene.camera.position - m.origin), 0.0) << "both mirrors face the camera";
  }
  const auto reflect = [&](const glm::dvec3& p, int i) {
    return reflectPoint(p, {state.mirrors[i].origin, state.mirrors[i].normal});
  };
  const RayTracer tracer(scene, state);
  const glm::dvec3 eye = scene.camera.position;
  const std::vector<glm::dvec3> images = {reflect(scene.lights[0].position, 0), reflect(scene.lights[0].position, 1),
                                          reflect(reflect(scene.lights[0].position, 0), 1),
                                          reflect(reflect(scene.lights[0].position, 1), 0)};
  int seen = 0;
  for (const glm::dvec3& image : images) {
    const glm::dvec3 direction = glm::normalize(image - eye);
    const glm::dvec3 side = glm::normalize(glm::cross(direction, {0, 1, 0}));
    if (tracer.radiance({}, eye, direction) == glm::dvec3(1.0)) {
      ++seen;
      expectNear(tracer.radiance({}, eye, image + 0.0099 * side - eye), glm::dvec3(1.0), 1e-12);
      expectNear(tracer.radiance({}, eye, image + 0.0101 * side - eye), glm::dvec3(0.0), 1e-12);
    }
  }
  EXPECT_GE(seen, 3) << "both first images and at least one second image are in view";
}

TEST(ReferenceMirrors, CutRecursionAtMaxDepth) {
  Scene scene = emptyScene({1, 1, 1});
  scene.mirrors = {mirrorOf(wallFacingZ, 0.5), mirrorOf(wallFacingMinusZ, 0.5)};
  for (int depth = 0; depth <= 8; ++depth) {
    const glm::dvec3 seen = look(scene, {0, 0, 1}, {0, 0.01, -1}, {.maxDepth = depth, .minThroughput = 0.0});
    // Mirrors of depth 0 .. depth - 1 reflect, the one of depth `depth` shows F * background.
    expectNear(seen, glm::dvec3(std::pow(0.5, depth + 1)), 1e-15);
  }
}

TEST(ReferenceMirrors, CutRecursionByThroughput) {
  Scene scene = emptyScene({1, 1, 1});
  scene.environment.sky = Sky{{2, 2, 2}, {3, 3, 3}, {4, 4, 4}};
  scene.mirrors = {mirrorOf(wallFacingZ, 0.5), mirrorOf(wallFacingMinusZ, 0.5)};
  const glm::dvec3 clear(1.0);
  // 0.5^3 = 0.125 is the first throughput below 0.2, so the third mirror shows the background.
  const TraceOptions options{.maxDepth = 64, .minThroughput = 0.2, .clearColor = clear};
  expectNear(look(scene, {0, 0, 1}, {0, 0.01, -1}, options), glm::dvec3(0.125), 1e-15);
  // Exactly at the limit is not below it.
  const TraceOptions exact{.maxDepth = 64, .minThroughput = 0.25, .clearColor = clear};
  expectNear(look(scene, {0, 0, 1}, {0, 0.01, -1}, exact), glm::dvec3(0.125), 1e-15);
}

TEST(ReferenceMirrors, CutMirrorsShowTheReflectedSky) {
  Scene scene = emptyScene({9, 9, 9});
  scene.environment.sky = Sky{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  scene.mirrors = {mirrorOf(wallFacingZ, 0.5)};
  const glm::dvec3 direction = glm::normalize(glm::dvec3(0, 0.25, -1));
  const double s = std::sqrt(direction.y);
  expectNear(look(scene, {0, 0, 1}, direction, {.maxDepth = 0}), 0.5 * glm::dvec3(s, 1.0 - s, 0.0), 1e-14);
}

TEST(ReferenceMirrors, BackSidesAreSurfacesUnlessTwoSided) {
  Scene scene = emptyScene({1, 1, 1});
  scene.environment.ambient = glm::dvec3(0.5);
  scene.mirrors = {mirrorOf(wallFacingZ, 0.25)};
  scene.mirrors[0].backColor = {0.2, 0.4, 0.6};
  expectNear(look(scene, {0, 0, -1}, {0, 0, 1}), {0.1, 0.2, 0.3}, 1e-15);
  scene.mirrors[0].twoSided = true;
  expectNear(look(scene, {0, 0, -1}, {0, 0, 1}), glm::dvec3(0.25), 1e-15);
}

TEST(ReferenceMirrors, LayerUnderneathGetsTheRest) {
  Scene scene = emptyScene({1, 1, 1});
  scene.environment.ambient = glm::dvec3(0.5);
  scene.mirrors = {mirrorOf(wallFacingZ, 0.25)};
  scene.mirrors[0].baseColor = {1.0, 0.5, 0.0};
  expectNear(look(scene, {0, 0, 1}, {0, 0, -1}), 0.25 + 0.75 * 0.5 * glm::dvec3(1.0, 0.5, 0.0), 1e-15);
}

TEST(ReferenceMirrors, SchlickAtNormalAndGrazing) {
  Scene scene = emptyScene({1, 1, 1});
  scene.mirrors = {mirrorOf({{-1e4, -1e4, 0}, {1e4, -1e4, 0}, {1e4, 1e4, 0}, {-1e4, 1e4, 0}}, 0.04)};
  scene.mirrors[0].fresnel = Fresnel::schlick;
  expectNear(look(scene, {0, 0, 1}, {0, 0, -1}), glm::dvec3(0.04), 1e-15);
  const double cosine = 0.5;
  const glm::dvec3 oblique(std::sqrt(1.0 - cosine * cosine), 0.0, -cosine);
  expectNear(look(scene, {0, 0, 1}, oblique), glm::dvec3(0.04 + 0.96 * std::pow(0.5, 5.0)), 1e-14);
  EXPECT_GT(look(scene, {0, 0, 1}, {1, 0, -1e-3}).r, 0.99);
}

TEST(ReferenceMirrors, HideObjectsBehindThem) {
  Scene scene = emptyScene({0, 0, 0});
  scene.mirrors = {mirrorOf(wallFacingZ)};
  const Material red{.diffuse = glm::dvec3(0.0), .emission = {1, 0, 0}};
  testing::addObject(scene, testing::sphereMesh(16, red), {0, 0, -2});
  expectNear(look(scene, {0, 0, 1}, {0, 0, -1}), glm::dvec3(0.0), 1e-15);
  scene.objects[0].position = {0, 0, 4};
  expectNear(look(scene, {0, 0, 1}, {0, 0, -1}), {1, 0, 0}, 1e-15);
}

TEST(ReferenceMirrors, MirrorsReflectLight) {
  Scene scene = emptyScene({0, 0, 0});
  scene.mirrors = {mirrorOf({{-9, 0, -9}, {-9, 0, 9}, {9, 0, 9}, {9, 0, -9}}, 0.5)};
  scene.lights.push_back({.position = {0, 1, 0}, .intensity = 10.0, .radius = 0.01, .glow = 0.0, .castsShadow = true});
  // A ceiling at y = 2, seen from below: lit by the light (1 m) and by its image (3 m).
  Material white;
  white.diffuse = glm::dvec3(1.0);
  testing::addObject(scene, testing::polygonMesh({{-1, 2, -1}, {1, 2, -1}, {1, 2, 1}, {-1, 2, 1}}, white));
  const glm::dvec3 eye(0.3, 0.5, 0.0);
  const glm::dvec3 towards = glm::dvec3(0.0, 2.0, 0.0) - eye;
  expectNear(look(scene, eye, towards), glm::dvec3(10.0 / pi), 1e-12);
  scene.mirrors[0].castsLight = true;
  expectNear(look(scene, eye, towards), glm::dvec3(10.0 / pi * (1.0 + 0.5 / 9.0)), 1e-12);
  // A screen between the mirror and the light blocks the second leg only.
  testing::addObject(scene, testing::polygonMesh({{-.2, .6, -.2}, {.2, .6, -.2}, {.2, .6, .2}, {-.2, .6, .2}}));
  expectNear(look(scene, eye, towards), glm::dvec3(10.0 / pi), 1e-12);
  scene.lights[0].castsShadow = false;
  expectNear(look(scene, eye, towards), glm::dvec3(10.0 / pi * (1.0 + 0.5 / 9.0)), 1e-12);
}

// The mean over GGX normals of a sky that is linear in the direction is known: alpha = r^2 -> the mean of m about n.
TEST(ReferenceMirrors, SlightRoughnessConvergesToSmooth) {
  Scene scene = emptyScene({0, 0, 0});
  scene.environment.sky = Sky{{1, 1, 1}, {0, 0, 0}, {0, 0, 0}};
  scene.mirrors = {mirrorOf({{-9, 0, -9}, {-9, 0, 9}, {9, 0, 9}, {9, 0, -9}})};
  const glm::dvec3 down(0.3, -1.0, 0.0);
  const double smooth = look(scene, {0, 1, 0}, down).r;
  EXPECT_NEAR(smooth, std::sqrt(glm::normalize(down).y * -1.0), 1e-14);
  scene.mirrors[0].roughness = 0.02;
  EXPECT_NEAR(look(scene, {0, 1, 0}, down, {.roughSamples = 4096}).r, smooth, 1e-3);
}

// Along the normal, the reflection of a sky of radiance sqrt(y) is the mean of sqrt(2 c^2 - 1) over GGX normals with
// cosine c that reflect upwards. The density of c^2 is integrated numerically.
TEST(ReferenceMirrors, RoughReflectionsFollowGgx) {
  Scene scene = emptyScene({0, 0, 0});
  scene.environment.sky = Sky{{1, 1, 1}, {0, 0, 0}, {0, 0, 0}};
  scene.mirrors = {mirrorOf({{-9, 0, -9}, {-9, 0, 9}, {9, 0, 9}, {9, 0, -9}})};
  scene.mirrors[0].roughness = 0.6;
  const double alpha2 = std::pow(0.6, 4.0);
  double sum = 0.0;
  double weight = 0.0;
  for (int i = 0; i < 200000; ++i) {
    const double cosine = (i + 0.5) / 200000;
    const double q = cosine * cosine * (alpha2 - 1.0) + 1.0;
    const double density = alpha2 / (pi * q * q) * cosine;
    const double up = 2.0 * cosine * cosine - 1.0;
    if (up > 0.0) {
      sum += density * std::sqrt(up);
      weight += density;
    }
  }
  EXPECT_NEAR(look(scene, {0, 1, 0}, {0, -1, 0}, {.roughSamples = 20000}).r, sum / weight, 1e-3);
}

TEST(ReferenceMirrors, RipplesTurnTheReflection) {
  Scene scene = emptyScene({0, 0, 0});
  scene.environment.sky = Sky{{1, 1, 1}, {0, 0, 0}, {0, 0, 0}};
  // Local axes of the polygon: X = +z, Y = n x X = +x, about its first vertex.
  scene.mirrors = {mirrorOf({{0, 0, 0}, {0, 0, 9}, {9, 0, 9}, {9, 0, 0}})};
  scene.mirrors[0].ripple = Ripple{0.01, 0.7, 0.2};
  const double k = 2.0 * pi / 0.7;
  const double x = 2.3;
  const double y = 3.1;
  const double time = 1.5;
  const double a = 0.01 * k * std::cos(k * (x + 0.2 * time));
  const double b = 0.01 * k * std::cos(k * (0.6 * x + 0.8 * y - 0.2 * time));
  const glm::dvec3 n = glm::normalize(glm::dvec3(-0.8 * b, 1.0, -a - 0.6 * b));
  const SceneState state = evaluate(scene, time);
  const double seen = RayTracer(scene, state).radiance({}, {y, 1, x}, {0, -1, 0}).r;
  EXPECT_NEAR(seen, std::sqrt(2.0 * n.y * n.y - 1.0), 1e-12);
  EXPECT_LT(seen, 0.9999);
}

}  // namespace
}  // namespace speculum
