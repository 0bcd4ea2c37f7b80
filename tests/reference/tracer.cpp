#include <tbb/task_arena.h>

#include "reference/ray_tracer.hpp"
#include "reference/scenes.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

using std::numbers::pi;

Material diffuse(const glm::dvec3& color) {
  Material material;
  material.diffuse = color;
  return material;
}

const std::vector<glm::dvec3> floorCorners = {{-4, 0, 4}, {4, 0, 4}, {4, 0, -4}, {-4, 0, -4}};

Scene floorScene(const Material& material) {
  Scene scene;
  scene.camera = testing::cameraAt({0, 1, 3}, {0, 0, 0});
  testing::addObject(scene, testing::polygonMesh(floorCorners, material));
  return scene;
}

// A floor, bumpy object, a light with shadows, two mirrors, one of them rough.
Scene mixedScene() {
  Scene scene;
  scene.environment.ambient = glm::dvec3(0.05);
  scene.environment.sky = Sky{{0.2, 0.4, 0.9}, {0.8, 0.85, 0.9}, {0.3, 0.28, 0.25}};
  scene.camera = testing::cameraAt({0.5, 1.6, 4}, {0, 0.8, 0});
  testing::addObject(scene, testing::polygonMesh(floorCorners, diffuse({0.6, 0.5, 0.4})));
  testing::addObject(scene, testing::bumpyMesh(24, 3), {0, 1, 0});
  scene.objects[1].scale = {0.8, -0.6, 0.7};
  scene.objects[1].color = glm::dvec3(0.8, 0.2, 0.1);
  scene.objects[1].specular = glm::dvec3(0.2);
  scene.objects[1].shininess = 60.0;
  scene.lights.push_back({.position = {1.5, 2.5, 1.5}, .intensity = 8.0, .castsShadow = true});
  scene.mirrors.push_back(testing::mirrorOf({{-2, 0.1, -1.5}, {1, 0.1, -1.5}, {1, 2.5, -1.5}, {-2, 2.5, -1.5}}, 0.9));
  scene.mirrors.push_back(testing::mirrorOf({{-2, 0.1, 2}, {-2, 0.1, -1.5}, {-2, 2.5, -1.5}, {-2, 2.5, 2}}, 0.9));
  scene.mirrors[1].roughness = 0.2;
  return scene;
}

TEST(ReferenceTracer, NumberOfThreadsChangesNoBit) {
  const Scene scene = mixedScene();
  const SceneState state = evaluate(scene, 0.0);
  const RayTracer tracer(scene, state);
  const TraceOptions options{.width = 70, .height = 45, .samples = 4, .roughSamples = 8};
  std::vector<TraceResult> results;
  for (const int threads : {1, 2, 3}) {
    tbb::task_arena arena(threads);
    arena.execute([&] { results.push_back(*tracer.render(options)); });
  }
  for (const TraceResult& result : results) {
    EXPECT_EQ(result.image.pixels, results[0].image.pixels);
    EXPECT_EQ(result.mirrorDepth, results[0].mirrorDepth);
  }
}

// A floor whose edge crosses the pixels from left to right, nowhere at the height of the samples of a grid.
TEST(ReferenceTracer, LatticeHasAsManyHeightsAsSamples) {
  Scene scene = floorScene(diffuse({1, 1, 1}));
  scene.environment.ambient = glm::dvec3(1.0);
  scene.camera = testing::cameraAt({0, 0.7, 3}, {0, 0.3, 0});
  scene.camera.up = {0.02, 1, 0};
  const SceneState state = evaluate(scene, 0.0);
  const RayTracer tracer(scene, state);
  const auto traced = [&](int samples, bool lattice) {
    return tracer.render({.width = 33, .height = 21, .samples = samples, .lattice = lattice})->image.pixels;
  };
  EXPECT_EQ(traced(1, true), traced(1, false)) << "the pixel's centre";
  const std::vector<glm::vec3> truth = traced(32 * 32, false);
  const std::vector<glm::vec3> grid = traced(64, false);
  const std::vector<glm::vec3> lattice = traced(64, true);
  double gridError = 0.0;
  double latticeError = 0.0;
  for (size_t i = 0; i < truth.size(); ++i) {
    gridError += std::abs(grid[i].r - truth[i].r);
    latticeError += std::abs(lattice[i].r - truth[i].r);
    EXPECT_NEAR(lattice[i].r, truth[i].r, 3.0 / 64.0);
  }
  EXPECT_GT(gridError, 0.0);
  EXPECT_LT(latticeError, 0.5 * gridError) << "edges almost along the rows of a grid";
}

TEST(ReferenceTracer, MasksSayWhatPixelCentresMeet) {
  const Scene scene = mixedScene();
  const SceneState state = evaluate(scene, 0.0);
  const TraceResult result =
      *RayTracer(scene, state).render({.width = 64, .height = 48, .samples = 1, .roughSamples = 1});
  TraceWorld world(scene);
  world.place(state);
  const double half = std::tan(0.5 * state.camera.verticalFov);
  int mirrors = 0;
  int background = 0;
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) {
      const size_t i = static_cast<size_t>(y) * 64 + x;
      const glm::dvec3 view((x + 0.5 - 32.0) / 24.0 * half, (24.0 - y - 0.5) / 24.0 * half, -1.0);
      const auto hit = world.closest({glm::dvec3(0.0), glm::transpose(state.camera.worldToView) * view}, {});
      EXPECT_EQ(result.mirrorDepth[i] > 0, hit && hit->kind == HitKind::mirror && hit->mirrorFront);
      EXPECT_EQ(result.backgroundMask[i], !hit);
      mirrors += result.mirrorDepth[i] > 0;
      background += result.backgroundMask[i];
    }
  }
  EXPECT_GT(mirrors, 300);
  EXPECT_GT(background, 100);
}

TEST(ReferenceTracer, ProgressRisesToOneAndCancels) {
  const Scene scene = mixedScene();
  const RayTracer tracer(scene, evaluate(scene, 0.0));
  const TraceOptions options{.width = 64, .height = 64, .samples = 1, .roughSamples = 1};
  double last = 0.0;
  EXPECT_TRUE(tracer.render(options, [&](double fraction) {
    EXPECT_GT(fraction, last);
    last = fraction;
    return true;
  }));
  EXPECT_DOUBLE_EQ(last, 1.0);
  int calls = 0;
  EXPECT_FALSE(tracer.render(options, [&](double) { return ++calls < 3; }));
  EXPECT_EQ(calls, 3);
}

TEST(ReferenceTracer, RefusesImpossibleOptions) {
  const Scene scene = mixedScene();
  const RayTracer tracer(scene, evaluate(scene, 0.0));
  EXPECT_THROW(tracer.render({.samples = 8}), std::invalid_argument);
  EXPECT_THROW(tracer.render({.width = 0}), std::invalid_argument);
  EXPECT_THROW(tracer.render({.samples = 4, .roughSamples = 0}), std::invalid_argument);
}

// Doubles place points there to 1e-9 m.
TEST(ReferenceTracer, FarFromTheOriginPicturesStay) {
  const Scene scene = mixedScene();
  SceneState state = evaluate(scene, 0.0);
  const TraceOptions options{.width = 64, .height = 48, .samples = 1, .roughSamples = 4};
  const TraceResult here = *RayTracer(scene, state).render(options);
  const glm::dvec3 far(1e7, -1e7, 1e7);
  state.camera.eye += far;
  for (InstanceState& instance : state.instances) {
    instance.worldFromMesh.translation += far;
    instance.center += far;
  }
  for (LightState& light : state.lights) {
    light.position += far;
  }
  for (MirrorState& mirror : state.mirrors) {
    mirror.origin += far;
    for (glm::dvec3& p : mirror.polygon) {
      p += far;
    }
  }
  const TraceResult there = *RayTracer(scene, state).render(options);
  for (size_t i = 0; i < here.image.pixels.size(); ++i) {
    EXPECT_LT(glm::length(here.image.pixels[i] - there.image.pixels[i]), 1e-4f) << "pixel " << i;
  }
}

TEST(ReferenceTracer, LightGivesItsIrradianceToAPlane) {
  Scene scene = floorScene(diffuse(glm::dvec3(0.5)));
  scene.lights.push_back({.position = {0, 2, 0}, .color = {1, 0.5, 0.25}, .intensity = 8.0, .glow = 0.0});
  const RayTracer tracer(scene, evaluate(scene, 0.0));
  const glm::dvec3 eye(0.5, 3, 0.3);
  for (const double x : {0.0, 0.7, 2.5}) {
    const glm::dvec3 p(x, 0, -0.2);
    const double r2 = x * x + 4.0 + 0.04;
    const double expected = 8.0 / r2 * (2.0 / std::sqrt(r2)) * 0.5 / pi;
    const glm::dvec3 seen = tracer.radiance({}, eye, p - eye);
    EXPECT_NEAR(seen.r, expected, 1e-14);
    EXPECT_NEAR(seen.g, 0.5 * expected, 1e-14);
    EXPECT_NEAR(seen.b, 0.25 * expected, 1e-14);
  }
}

TEST(ReferenceTracer, HighlightsFollowPhongBlinn) {
  Material material = diffuse(glm::dvec3(0.0));
  material.specular = glm::dvec3(0.3);
  material.shininess = 50.0;
  Scene scene = floorScene(material);
  scene.lights.push_back({.position = {1, 2, 0}, .intensity = 3.0, .glow = 0.0});
  const RayTracer tracer(scene, evaluate(scene, 0.0));
  const glm::dvec3 eye(-1.2, 1.5, 0.2);
  const glm::dvec3 l = glm::dvec3(1, 2, 0) / std::sqrt(5.0);
  const double nh = glm::normalize(l + glm::normalize(eye)).y;
  const double expected = 3.0 / 5.0 * l.y * 0.3 * 58.0 / (8.0 * pi) * std::pow(nh, 50.0);
  EXPECT_NEAR(tracer.radiance({}, eye, -eye).r, expected, 1e-13);
  EXPECT_GT(expected, 0.05);
}

TEST(ReferenceTracer, InverseSquareStopsAtTheRadius) {
  Scene scene = floorScene(diffuse(glm::dvec3(1.0)));
  scene.lights.push_back({.position = {0, 0.1, 0}, .intensity = 1.0, .radius = 0.5, .glow = 0.0});
  const RayTracer tracer(scene, evaluate(scene, 0.0));
  EXPECT_NEAR(tracer.radiance({}, {1, 3, 1}, {-1, -3, -1}).r, 1.0 / 0.25 / pi, 1e-13);
}

TEST(ReferenceTracer, ObjectsAndMirrorsCastShadows) {
  Scene scene = floorScene(diffuse(glm::dvec3(1.0)));
  scene.lights.push_back({.position = {0, 2, 0}, .glow = 1.0});
  scene.lights.push_back({.position = {0, 1.5, 0}, .intensity = 0.0, .radius = 0.1, .glow = 1.0});
  const auto lit = [&] {
    return RayTracer(scene, evaluate(scene, 0.0)).radiance({}, {1, 0.5, 0}, {-1, -0.5, 0}).r > 0.0;
  };
  scene.lights[0].castsShadow = true;
  EXPECT_TRUE(lit());
  scene.mirrors = {testing::mirrorOf({{-.1, 1, -.1}, {.1, 1, -.1}, {.1, 1, .1}, {-.1, 1, .1}})};
  EXPECT_FALSE(lit()) << "the mirror's back";
  std::reverse(scene.mirrors[0].polygon.begin(), scene.mirrors[0].polygon.end());
  EXPECT_FALSE(lit()) << "the mirror's front";
  scene.lights[0].castsShadow = false;
  EXPECT_TRUE(lit());
  scene.mirrors.clear();
  scene.lights[0].castsShadow = true;
  testing::addObject(scene, testing::sphereMesh(8), {0, 1, 0});
  scene.objects[1].scale = glm::dvec3(0.2);
  EXPECT_FALSE(lit());
  scene.objects[1].position = {0, 3, 0};
  EXPECT_TRUE(lit()) << "beyond the light";
}

TEST(ReferenceTracer, GlyphsAreSpheresFromOutsideAndInside) {
  Scene scene;
  scene.camera = testing::cameraAt({0, 0, 5}, {0, 0, 0});
  scene.lights.push_back({.position = {0, 0, 0}, .color = {1, 2, 3}, .radius = 0.5, .glow = 0.5});
  const RayTracer tracer(scene, evaluate(scene, 0.0));
  EXPECT_EQ(tracer.radiance({}, {0, 0, 5}, {0, 0, -1}), glm::dvec3(0.5, 1.0, 1.5));
  const double tangent = 0.5 / std::sqrt(25.0 - 0.25);
  EXPECT_GT(tracer.radiance({}, {0, 0, 5}, {tangent * (1 - 1e-9), 0, -1}).r, 0.0);
  EXPECT_EQ(tracer.radiance({}, {0, 0, 5}, {tangent * (1 + 1e-9), 0, -1}).r, 0.0);
  EXPECT_GT(tracer.radiance({}, {0.1, 0.2, 0.1}, {1, 1, -1}).r, 0.0);
  TraceWorld world(scene);
  world.place(evaluate(scene, 0.0));
  const auto hit = world.closest({glm::dvec3(0.0), {0, 0, -1}}, {});
  ASSERT_TRUE(hit && hit->kind == HitKind::glyph);
  EXPECT_NEAR(hit->t, 4.5, 1e-14);
}

TEST(ReferenceTracer, SphereSilhouetteIsTheTangentCone) {
  Scene scene;
  scene.camera = testing::cameraAt({0, 0, 3}, {0, 0, 0}, 60.0);
  scene.environment.background = glm::dvec3(1.0);
  scene.environment.ambient = glm::dvec3(1.0);
  testing::addObject(scene, testing::sphereMesh(256, diffuse(glm::dvec3(0.0))));
  const RayTracer tracer(scene, evaluate(scene, 0.0));
  const int size = 200;
  const TraceResult result = *tracer.render({.width = size, .height = size, .samples = 16});
  double covered = 0.0;
  for (const glm::vec3& p : result.image.pixels) {
    covered += 1.0 - p.r;
  }
  const double radius = 1.0 / std::sqrt(8.0) / std::tan(pi / 6.0) * size / 2.0;
  EXPECT_NEAR(covered / (pi * radius * radius), 1.0, 1e-3);
}

TEST(ReferenceTracer, ClearColorReplacesTheSky) {
  Scene scene;
  scene.camera = testing::cameraAt({0, 0, 3}, {0, 0, 0});
  scene.environment.background = glm::dvec3(7.0);
  const auto seen = [&](const glm::dvec3& d, const TraceOptions& options = {}) {
    return RayTracer(scene, evaluate(scene, 0.0)).radiance(options, glm::dvec3(0.0), d);
  };
  EXPECT_EQ(seen({0, 1, 0}), glm::dvec3(7.0));
  scene.environment.sky = Sky{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  EXPECT_EQ(seen({0, 2, 0}), glm::dvec3(1, 0, 0));
  EXPECT_EQ(seen({3, 0, 0}), glm::dvec3(0, 1, 0));
  EXPECT_EQ(seen({0, -1, 0}), glm::dvec3(0, 0, 1));
  EXPECT_NEAR(seen({0, 0.6, 0.8}).r, std::sqrt(0.6), 1e-15);
  EXPECT_NEAR(seen({0, -0.05, std::sqrt(1 - 0.0025)}).b, 0.4, 1e-15);
  EXPECT_EQ(seen({0, 1, 0}, {.clearColor = glm::dvec3(0.25)}), glm::dvec3(0.25));
}

TEST(ReferenceTracer, TexturesAreBilinearRepeatedAndUpright) {
  Scene scene;
  scene.environment.ambient = glm::dvec3(1.0);
  scene.camera = testing::cameraAt({0, 0, 3}, {0, 0, 0});
  Texture texture{.width = 2, .height = 2, .texels = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}}};
  scene.textures.push_back(texture);
  Material material = diffuse(glm::dvec3(1.0));
  material.diffuseTexture = 0;
  // uv = (x, y)
  testing::addObject(scene, testing::polygonMesh({{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}}, material));
  const RayTracer tracer(scene, evaluate(scene, 0.0));
  const auto at = [&](double u, double v) { return tracer.radiance({}, {u, v, 1}, {0, 0, -1}); };
  const auto expect = [&](const glm::dvec3& a, const glm::dvec3& b) { EXPECT_LT(glm::length(a - b), 1e-12); };
  expect(at(0.25, 0.75), {1, 0, 0});
  expect(at(0.75, 0.75), {0, 1, 0});
  expect(at(0.25, 0.25), {0, 0, 1});
  expect(at(1.75, -0.75), {1, 1, 1});
  expect(at(0.5, 0.75), {0.5, 0.5, 0});
  expect(at(0.0, 0.75), {0.5, 0.5, 0});
  expect(at(0.5, 0.5), {0.5, 0.5, 0.5});
}

// The shading normal is on the viewer's side by the winding in the file, whatever the sign of the scale.
TEST(ReferenceTracer, NegativeScaleKeepsTheOutsideOutside) {
  Scene scene;
  scene.camera = testing::cameraAt({0, 1, 3}, {0, 0, 0});
  testing::addObject(scene, testing::sphereMesh(64, diffuse(glm::dvec3(1.0))));
  scene.lights.push_back({.position = {0, 5, 0}, .intensity = 25.0, .glow = 0.0});
  const glm::dvec3 eye(1.0, 4.0, 0.0);
  const auto top = [&] {
    return RayTracer(scene, evaluate(scene, 0.0)).radiance({}, eye, glm::dvec3(0.001, 1, 0.002) - eye).r;
  };
  const double expected = top();
  EXPECT_NEAR(expected, 25.0 / 16.0 / pi, 1e-2);
  for (const glm::dvec3 scale : {glm::dvec3(-1, 1, 1), glm::dvec3(-1, 1, -1), glm::dvec3(1, -1, 1), glm::dvec3(-1.0)}) {
    scene.objects[0].scale = scale;
    EXPECT_NEAR(top(), expected, 1e-2);
  }
}

TEST(ReferenceTracer, ExtremeScalesStayFinite) {
  Scene scene;
  scene.environment.ambient = glm::dvec3(1.0);
  scene.camera = testing::cameraAt({0, 0, 3}, {0, 0, 0});
  testing::addObject(scene, testing::sphereMesh(32, diffuse(glm::dvec3(1.0))));
  for (const glm::dvec3 scale :
       {glm::dvec3(1e-20), glm::dvec3(1e13), glm::dvec3(1, 2, 5), glm::dvec3(1e-20, 1e13, 1)}) {
    scene.objects[0].scale = scale;
    const RayTracer tracer(scene, evaluate(scene, 0.0));
    const double width = scale.x;
    EXPECT_EQ(tracer.radiance({}, {0.1 * width, 0.0, 9.0 * scale.z}, {0, 0, -1}).r, 1.0) << scale.x;
    EXPECT_EQ(tracer.radiance({}, {1.1 * width, 0.0, 9.0 * scale.z}, {0, 0, -1}).r, 0.0) << scale.x;
  }
}

// Right-handed, y up, vertical field of view.
TEST(ReferenceTracer, CameraIsRightHandedWithVerticalField) {
  Scene scene;
  scene.camera = testing::cameraAt({0, 0, 0}, {0, 0, -1}, 90.0);
  scene.lights.push_back({.position = {1, 0.5, -1}, .radius = 0.02, .glow = 1.0});
  const TraceResult result =
      *RayTracer(scene, evaluate(scene, 0.0)).render({.width = 200, .height = 100, .samples = 1});
  EXPECT_EQ(result.image.at(150, 25), glm::vec3(1.0f));
  EXPECT_EQ(std::ranges::count(result.image.pixels, glm::vec3(0.0f)), 20000 - 4);
}

}  // namespace
}  // namespace speculum
