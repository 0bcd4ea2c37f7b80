// Hard cases of transforms: the vertex shader's inputs against the scene's own numbers in extended precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/reflection.hpp"
#include "naive_arithmetic.hpp"
#include "transform_support.hpp"

namespace speculum {
namespace {

using namespace hard_cases;

constexpr int width = 1280;
constexpr int height = 720;

// A cloud between two mirrors that face each other at a slight angle, seen from beside it. Nothing is parallel to an
// axis or near the origin, where floats are at their best.
Scene corridor(unsigned seed = 0) {
  Random random(seed);
  Scene scene;
  const glm::dvec3 place = random.inBox(50.0);
  const double pitch = random.uniform(-60, 60);
  const double yaw = random.uniform(-180, 180);
  Mirror mirror{.rotation = {pitch, yaw, random.uniform(-180, 180)}, .size = {9, 7}};
  const glm::dmat3 frame = rotationFromDegrees(mirror.rotation);
  const auto at = [&](double x, double y, double z) { return place + frame * glm::dvec3(x, y, z); };
  scene.camera = {.position = at(0.4, 0.3, 3.1), .target = at(-0.2, 0.1, -4.0)};
  scene.meshes.push_back(pointCloud(200, 1));
  scene.objects.push_back(
      {.mesh = 0, .position = at(-0.3, 0.2, 0.5), .rotation = {10, 20, 30}, .scale = {0.8, 0.6, 0.7}});
  mirror.position = at(0, 0, -4);
  scene.mirrors.push_back(mirror);
  mirror.position = at(0, 0, 4);
  mirror.rotation = {0.1 - pitch, yaw + 180.2, 7};
  scene.mirrors.push_back(mirror);
  return scene;
}

bool inPicture(const glm::dvec2& pixel) {
  return pixel.x >= 0.0 && pixel.y >= 0.0 && pixel.x <= width && pixel.y <= height;
}

struct Errors {
  double largest = 0.0;  // pixels
  double median = 0.0;
  int count = 0;
};

Errors summary(std::vector<double> errors) {
  if (errors.empty()) {
    return {};
  }
  std::sort(errors.begin(), errors.end());
  return {errors.back(), errors[errors.size() / 2], static_cast<int>(errors.size())};
}

// The reflection in plane (q, n), chained onto a point and the camera's frame: the image of a point p in mirrors
// m1 .. mk seen from the eye is R1 .. Rk p.
LongVec3 imageOf(const Scene& scene, const std::vector<int>& path, LongVec3 p) {
  for (auto it = path.rbegin(); it != path.rend(); ++it) {
    const Mirror& mirror = scene.mirrors[*it];
    const LongVec3 n = longRotation(mirror.rotation)[2];
    p -= 2 * glm::dot(n, p - LongVec3(mirror.position)) * n;
  }
  return p;
}

LongVec3 worldPoint(const Object& object, const Vertex& vertex) {
  return LongVec3(object.position) +
         longRotation(object.rotation) * (LongVec3(object.scale) * LongVec3(vertex.position));
}

// Returns the errors, in pixels, of every vertex in every pass of that many mirrors. `truth` is the scene at the
// origin.
Errors doublePathErrors(const Scene& scene, const Scene& truth, int maxDepth, size_t pathLength) {
  const SceneState state = evaluate(scene, 0.0);
  const FramePlan plan = planOf(scene, width, height, maxDepth);
  const LongMat3 worldToView = longWorldToView(truth.camera);
  std::vector<double> errors;
  const auto addPass = [&](const View& view) {
    const gpu::InstanceData data = dataIn(plan, view, state.instances[0]);
    for (const Vertex& vertex : truth.meshes[0].vertices) {
      const LongVec3 image = imageOf(truth, view.path, worldPoint(truth.objects[0], vertex));
      const glm::dvec2 expected =
          longPixel(worldToView, image - LongVec3(truth.camera.position), truth.camera.verticalFov, width, height);
      const glm::vec4 clip = shaderClip(data, vertex);
      if (clip.w > 0.5f && inPicture(expected)) {
        errors.push_back(glm::length(toPixel(glm::dvec4(clip), width, height) - expected));
      }
    }
  };
  if (pathLength == 0) {
    addPass(plan.main.view);
  }
  for (const PlannedPass& pass : plan.passes) {
    if (pass.view.path.size() == pathLength) {
      addPass(pass.view);
    }
  }
  return summary(std::move(errors));
}

// The method that every tutorial shows: world space in float, matrices multiplied in float, one reflection matrix with
// the plane as (n, d) for each mirror.
glm::mat4 floatReflection(const glm::vec3& n, const glm::vec3& q) {
  const float d = glm::dot(n, q);
  glm::mat4 m(glm::mat3(1.0f) - 2.0f * glm::outerProduct(n, n));
  m[3] = glm::vec4(2.0f * d * n, 1.0f);
  return m;
}

glm::vec3 floatNormal(const Mirror& mirror) {
  const glm::vec3 angles = glm::radians(glm::vec3(mirror.rotation));
  const float c = std::cos(angles.x);
  return {c * std::sin(angles.y), -std::sin(angles.x), c * std::cos(angles.y)};
}

glm::mat4 floatView(const Scene& scene) {
  const SceneState state = evaluate(scene, 0.0);
  const glm::mat3 rotation(state.camera.worldToView);
  glm::mat4 view(rotation);
  view[3] = glm::vec4(-(rotation * glm::vec3(state.camera.eye)), 1.0f);
  return view;
}

Errors floatPathErrors(const Scene& scene, const Scene& truth, const std::vector<int>& path) {
  const SceneState state = evaluate(scene, 0.0);
  const FramePlan plan = planOf(scene, width, height, 0);
  const LongMat3 worldToView = longWorldToView(truth.camera);
  glm::mat4 clipFromWorld = glm::mat4(plan.projection.matrix()) * floatView(scene);
  for (const int mirror : path) {
    clipFromWorld =
        clipFromWorld * floatReflection(floatNormal(scene.mirrors[mirror]), glm::vec3(scene.mirrors[mirror].position));
  }
  const Affine& place = state.instances[0].worldFromMesh;
  std::vector<double> errors;
  for (const Vertex& vertex : truth.meshes[0].vertices) {
    const LongVec3 image = imageOf(truth, path, worldPoint(truth.objects[0], vertex));
    const glm::dvec2 expected =
        longPixel(worldToView, image - LongVec3(truth.camera.position), truth.camera.verticalFov, width, height);
    const glm::vec3 world = glm::mat3(place.linear) * glm::vec3(vertex.position) + glm::vec3(place.translation);
    const glm::vec4 clip = clipFromWorld * glm::vec4(world, 1.0f);
    if (inPicture(expected)) {
      errors.push_back(clip.w == 0.0f ? 1e9 : glm::length(toPixel(glm::dvec4(clip), width, height) - expected));
    }
  }
  return summary(std::move(errors));
}

std::vector<int> alternating(int length) {
  std::vector<int> path;
  for (int i = 0; i < length; ++i) {
    path.push_back(i % 2);
  }
  return path;
}

TEST(SceneMovedFar, VerticesStayWithin2e3Pixels) {
  const Scene origin = corridor();
  for (const double distance : {0.0, 1e3, 1e5, 1e7}) {
    const Scene far = moved(origin, distance * glm::dvec3(1.0, -0.7, 0.9));
    for (const size_t depth : {0, 1, 4}) {
      const Errors errors = doublePathErrors(far, origin, 4, depth);
      ASSERT_GT(errors.count, 100) << "too few vertices in view to judge by";
      EXPECT_LE(errors.largest, 2e-3) << distance << " m from the origin, behind " << depth << " mirrors";
      std::printf("%g m, %zu mirrors: median %.1e, largest %.1e px\n", distance, depth, errors.median, errors.largest);
    }
  }
}

TEST(SceneMovedFar, FloatWorldSpaceIsSixtyPixelsOff) {
  const Scene origin = corridor();
  EXPECT_GT(floatPathErrors(moved(origin, 1e3 * glm::dvec3(1.0, -0.7, 0.9)), origin, {}).largest, 2e-3);
  const Errors errors = floatPathErrors(moved(origin, 1e7 * glm::dvec3(1.0, -0.7, 0.9)), origin, {});
  EXPECT_GT(errors.largest, 60.0);
  std::printf("float, 1e7 m: median %.1e, largest %.1e px\n", errors.median, errors.largest);
}

TEST(FacingMirrorsAtDepth32, DoublePathStaysWithin1e3Pixels) {
  for (const size_t depth : {1, 8, 16, 32}) {
    Errors worst;
    for (unsigned seed = 0; seed < 40; ++seed) {
      const Scene scene = corridor(seed);
      const Errors errors = doublePathErrors(scene, scene, 32, depth);
      ASSERT_GT(errors.count, 100) << "too few vertices in view to judge by";
      ASSERT_LE(errors.largest, 1e-3) << depth << " mirrors, room " << seed;
      worst = errors.largest > worst.largest ? errors : worst;
    }
    std::printf("%zu mirrors: median %.1e, largest %.1e px\n", depth, worst.median, worst.largest);
  }
}

TEST(FacingMirrorsAtDepth32, FloatMatricesDrift) {
  Errors worst;
  for (unsigned seed = 0; seed < 40; ++seed) {
    const Scene scene = corridor(seed);
    const Errors errors = floatPathErrors(scene, scene, alternating(32));
    worst = errors.largest > worst.largest ? errors : worst;
  }
  EXPECT_GT(worst.largest, 1e-3) << "the naive way should fail";
  std::printf("float: median %.1e, largest %.1e px\n", worst.median, worst.largest);
}

// Says whether a triangle that is counter-clockwise in the mesh is so on the screen (y down).
bool counterClockwise(const std::array<glm::dvec2, 3>& p) {
  const glm::dvec2 a = p[1] - p[0];
  const glm::dvec2 b = p[2] - p[0];
  return a.x * b.y - a.y * b.x < 0.0;
}

struct Windings {
  int triangles = 0;
  int wrong = 0;      // as the renderer sets front face and handedness
  int oneSided = 0;   // with a front face that no mirror and no scale turns
  int floatSign = 0;  // with the sign of a determinant in float
};

// Counts triangles of a cloud whose inside is taken for the outside.
Windings windingsOf(const glm::dvec3& scale, size_t depth) {
  Scene scene = corridor();
  scene.objects[0].scale = scale;
  const SceneState state = evaluate(scene, 0.0);
  const FramePlan plan = planOf(scene, width, height, 4);
  const InstanceState& instance = state.instances[0];
  const std::vector<Vertex>& vertices = scene.meshes[0].vertices;
  Windings windings;
  for (const PlannedPass* pass = plan.passes.data(); pass <= plan.passes.data() + plan.passes.size(); ++pass) {
    const View& view = pass == plan.passes.data() + plan.passes.size() ? plan.main.view : pass->view;
    if (view.path.size() != depth) {
      continue;
    }
    const gpu::InstanceData data = dataIn(plan, view, instance);
    for (size_t i = 0; i + 2 < vertices.size(); i += 3) {
      std::array<glm::dvec2, 3> pixels;
      for (size_t k = 0; k < 3; ++k) {
        pixels[k] = toPixel(glm::dvec4(shaderClip(data, vertices[i + k])), width, height);
      }
      const glm::dvec3 a = instance.worldFromMesh.point(vertices[i].position);
      const glm::dvec3 b = instance.worldFromMesh.point(vertices[i + 1].position);
      const glm::dvec3 c = instance.worldFromMesh.point(vertices[i + 2].position);
      // The outside by the winding in the model: negative scale does not turn it.
      const double turned = scale.x * scale.y * scale.z < 0.0 ? -1.0 : 1.0;
      const bool outside = turned * glm::dot(glm::cross(b - a, c - a), view.eye - a) > 0.0;
      const bool frontFacing = counterClockwise(pixels) == !view.mirrored();
      const bool taken = frontFacing == (handednessOf(instance) > 0.0f);
      const bool floatTaken = frontFacing == (glm::determinant(glm::mat3(instance.worldFromMesh.linear)) > 0.0f);
      ++windings.triangles;
      windings.wrong += taken != outside;
      windings.oneSided += counterClockwise(pixels) != outside;
      windings.floatSign += floatTaken != outside;
    }
  }
  return windings;
}

TEST(NegativeScaleAndBounces, OutsideStaysOutside) {
  for (const glm::dvec3& scale :
       {glm::dvec3(0.8), glm::dvec3(-0.8, 0.5, 0.6), glm::dvec3(-0.7, -0.7, 0.6), glm::dvec3(-0.8, -0.7, -0.9)}) {
    for (const size_t depth : {0, 1, 2, 3}) {
      const Windings windings = windingsOf(scale, depth);
      ASSERT_GT(windings.triangles, 50);
      EXPECT_EQ(windings.wrong, 0) << "scale " << scale.x << ", " << depth << " bounces";
      const bool turned = (scale.x * scale.y * scale.z < 0.0) != (depth % 2 == 1);
      EXPECT_EQ(windings.oneSided, turned ? windings.triangles : 0) << "the naive way should fail here only";
    }
  }
}

TEST(NegativeScaleAndBounces, TinyScaleKeepsItsSign) {
  const Windings windings = windingsOf(glm::dvec3(1e-16, -1e-16, 1e-16), 0);
  const InstanceState instance{.worldFromMesh = {glm::dmat3(1e-16) * glm::dmat3(1, 0, 0, 0, -1, 0, 0, 0, 1), {}}};
  EXPECT_EQ(handednessOf(instance), -1.0f);
  EXPECT_GT(windings.floatSign, 0) << "a determinant in float is zero";
}

// Degrees between the shader's world normal and the exact one; 180 for one that is not finite.
double degreesOff(const glm::dvec3& actual, const LongVec3& expected) {
  if (!std::isfinite(glm::length(actual)) || glm::length(actual) == 0.0) {
    return 180.0;
  }
  const glm::dvec3 a = glm::normalize(actual);
  const glm::dvec3 e(glm::normalize(expected));
  return glm::degrees(std::atan2(glm::length(glm::cross(a, e)), glm::dot(a, e)));
}

struct NormalErrors {
  double production = 0.0;  // degrees
  double byModelMatrix = 0.0;
  double byFloatInverse = 0.0;
};

NormalErrors normalErrors(const glm::dvec3& scale) {
  const glm::dvec3 angles(20, -35, 50);
  const LongMat3 rotation = longRotation(angles);
  const glm::dmat3 r = rotationFromDegrees(angles);
  const InstanceState instance{.worldFromMesh = {glm::dmat3(r[0] * scale.x, r[1] * scale.y, r[2] * scale.z), {}}};
  const gpu::InstanceData data = instanceData(instance, View{}, glm::dmat4(1.0));
  const glm::mat3 model(instance.worldFromMesh.linear);
  const glm::mat3 inverse = naiveInverseTranspose(model);
  NormalErrors errors;
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const glm::vec3 n(random.direction());
    const LongVec3 exact = rotation * (LongVec3(n) / LongVec3(scale));
    const glm::vec3 shaded(glm::dot(glm::vec3(data.normalFromMesh[0]), n),
                           glm::dot(glm::vec3(data.normalFromMesh[1]), n),
                           glm::dot(glm::vec3(data.normalFromMesh[2]), n));
    // safeNormalize of shading.glsl.
    const glm::vec3 unit = shaded * (1.0f / std::sqrt(std::max(glm::dot(shaded, shaded), 1e-30f)));
    errors.production = std::max(errors.production, degreesOff(glm::dvec3(unit), exact));
    errors.byModelMatrix = std::max(errors.byModelMatrix, degreesOff(glm::dvec3(model * n), exact));
    errors.byFloatInverse = std::max(errors.byFloatInverse, degreesOff(glm::dvec3(naiveNormalize(inverse * n)), exact));
  }
  return errors;
}

TEST(NonUniformAndExtremeScale, NormalsAreWithin1e4Degrees) {
  for (const double size : {1.0, 1e-20, 1e13}) {
    const NormalErrors errors = normalErrors(size * glm::dvec3(1, 2, 5));
    EXPECT_LE(errors.production, 1e-4) << size;
    std::printf("size %g: %.1e degrees, model matrix %.0f, float inverse %.1e\n", size, errors.production,
                errors.byModelMatrix, errors.byFloatInverse);
  }
}

TEST(NonUniformAndExtremeScale, NaiveMatricesTurnOrLoseThem) {
  EXPECT_GT(normalErrors({1, 2, 5}).byModelMatrix, 60.0);
  EXPECT_GT(normalErrors(1e-20 * glm::dvec3(1, 2, 5)).byFloatInverse, 1e-4);
  EXPECT_GT(normalErrors(1e13 * glm::dvec3(1, 2, 5)).byFloatInverse, 1e-4);
}

// Largest error of the clip distance relative to the point's distance from the eye.
struct CutErrors {
  double production = 0.0;
  double floatPlane = 0.0;  // world space and n.x = d in float
};

CutErrors cutErrors(double offset) {
  const Scene origin = corridor();
  const Scene scene = moved(origin, offset * glm::dvec3(1.0, -0.7, 0.9));
  const SceneState state = evaluate(scene, 0.0);
  const FramePlan plan = planOf(scene, width, height, 1);
  CutErrors errors;
  for (const PlannedPass& pass : plan.passes) {
    const gpu::InstanceData data = dataIn(plan, pass.view, state.instances[0]);
    const Mirror& mirror = origin.mirrors[pass.view.path[0]];
    const LongVec3 n = longRotation(mirror.rotation)[2];
    const glm::vec3 planeNormal(pass.view.clip->normal);
    const float d = glm::dot(planeNormal, glm::vec3(pass.view.clip->point));
    const Affine& place = state.instances[0].worldFromMesh;
    for (const Vertex& vertex : origin.meshes[0].vertices) {
      const LongVec3 world = worldPoint(origin.objects[0], vertex);
      const double exact = static_cast<double>(glm::dot(n, world - LongVec3(mirror.position)));
      const double distance = glm::length(glm::dvec3(world) - origin.camera.position);
      const float shader = glm::dot(data.clipPlane, glm::vec4(glm::vec3(vertex.position), 1.0f));
      const glm::vec3 floatWorld(place.point(vertex.position));
      errors.production = std::max(errors.production, std::abs(shader - exact) / distance);
      errors.floatPlane =
          std::max(errors.floatPlane, std::abs(glm::dot(planeNormal, floatWorld) - d - exact) / distance);
    }
  }
  return errors;
}

TEST(ObjectAcrossTheMirrorPlane, CutIsWithin1e6OfTheDistance) {
  for (const double offset : {0.0, 1e3, 1e7}) {
    const CutErrors errors = cutErrors(offset);
    EXPECT_LE(errors.production, 1e-6) << offset;
    std::printf("%g m: cut off by %.1e of the distance, float plane %.1e\n", offset, errors.production,
                errors.floatPlane);
  }
  EXPECT_GT(cutErrors(1e7).floatPlane, 1e-6) << "the naive way should fail";
}

// Points of two rooms, one on each side of each mirror's plane, that the wrong plane would cut.
TEST(NestedMirrors, PassesAreCutAtTheirMirrors) {
  const Scene scene = corridor();
  const SceneState state = evaluate(scene, 0.0);
  const FramePlan plan = planOf(scene, width, height, 4);
  const View& first = plan.passes.front().view;
  int wrong = 0;
  int stale = 0;
  for (const PlannedPass& pass : plan.passes) {
    const Mirror& mirror = scene.mirrors[pass.view.path.back()];
    const LongVec3 n = longRotation(mirror.rotation)[2];
    InstanceState cloud = state.instances[0];
    cloud.worldFromMesh.translation = mirror.position;
    const gpu::InstanceData data = dataIn(plan, pass.view, cloud);
    for (const Vertex& vertex : scene.meshes[0].vertices) {
      const LongVec3 offset =
          longRotation(scene.objects[0].rotation) * (LongVec3(scene.objects[0].scale) * LongVec3(vertex.position));
      const bool front = glm::dot(n, offset) > 0;
      const glm::dvec3 world = mirror.position + glm::dvec3(offset);
      wrong += (glm::dot(data.clipPlane, glm::vec4(glm::vec3(vertex.position), 1.0f)) > 0.0f) != front;
      stale += (first.clip->distance(world) > 0.0) != front;
    }
    EXPECT_EQ(pass.view.mirrored(), pass.view.path.size() % 2 == 1);
    EXPECT_EQ(glm::determinant(pass.view.worldToView) < 0.0, pass.view.mirrored());
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(stale, 100) << "the naive way, one plane for the frame, should fail";
}

}  // namespace
}  // namespace speculum
