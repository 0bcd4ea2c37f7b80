// Hard cases of transforms: the vertex shader's inputs against the scene's own numbers in extended precision.
#include "test_headers.hpp"
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
  std::ranges::sort(errors);
  return {errors.back(), errors[errors.size() / 2], static_cast<int>(errors.size())};
}

// The reflection in plane (q, n), chained onto a point and the camera's frame: the image of a point p in mirrors
// m1 .. mk seen from the eye is R1 .. Rk p.
LongVec3 imageOf(const Scene& scene, const MirrorPath& path, LongVec3 p) {
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
    addPass(plan.main().view);
  }
  for (const Pass& pass : plan.drawnMirrors()) {
    if (pass.view.path.size() == pathLength) {
      addPass(pass.view);
    }
  }
  return summary(std::move(errors));
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

// Says whether a triangle that is counter-clockwise in the mesh is so on the screen (y down).
bool counterClockwise(const std::array<glm::dvec2, 3>& p) {
  const glm::dvec2 a = p[1] - p[0];
  const glm::dvec2 b = p[2] - p[0];
  return a.x * b.y - a.y * b.x < 0.0;
}

struct Windings {
  int triangles = 0;
  int wrong = 0;  // whose inside is taken for the outside
};

// Counts triangles of a cloud, judged by the front face and handedness that the renderer sets.
Windings windingsOf(const glm::dvec3& scale, size_t depth) {
  Scene scene = corridor();
  scene.objects[0].scale = scale;
  const SceneState state = evaluate(scene, 0.0);
  const FramePlan plan = planOf(scene, width, height, 4);
  const InstanceState& instance = state.instances[0];
  const std::vector<Vertex>& vertices = scene.meshes[0].vertices;
  Windings windings;
  for (const Pass& pass : plan.passes) {
    const View& view = pass.view;
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
      ++windings.triangles;
      windings.wrong += taken != outside;
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
    }
  }
}

TEST(NegativeScaleAndBounces, TinyScaleKeepsItsSign) {
  const InstanceState instance{.worldFromMesh = {glm::dmat3(1e-16) * glm::dmat3(1, 0, 0, 0, -1, 0, 0, 0, 1), {}}};
  EXPECT_EQ(handednessOf(instance), -1.0f);
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

// Returns the largest error of a normal, in degrees.
double normalError(const glm::dvec3& scale) {
  const glm::dvec3 angles(20, -35, 50);
  const LongMat3 rotation = longRotation(angles);
  const glm::dmat3 r = rotationFromDegrees(angles);
  const InstanceState instance{.worldFromMesh = {glm::dmat3(r[0] * scale.x, r[1] * scale.y, r[2] * scale.z), {}}};
  const gpu::InstanceData data = instanceData(instance, View{}, glm::dmat4(1.0));
  double error = 0.0;
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const glm::vec3 n(random.direction());
    const LongVec3 exact = rotation * (LongVec3(n) / LongVec3(scale));
    const glm::vec3 shaded(glm::dot(glm::vec3(data.normalFromMesh[0]), n),
                           glm::dot(glm::vec3(data.normalFromMesh[1]), n),
                           glm::dot(glm::vec3(data.normalFromMesh[2]), n));
    // safeNormalize of shading.glsl.
    const glm::vec3 unit = shaded * (1.0f / std::sqrt(std::max(glm::dot(shaded, shaded), 1e-30f)));
    error = std::max(error, degreesOff(glm::dvec3(unit), exact));
  }
  return error;
}

TEST(NonUniformAndExtremeScale, NormalsAreWithin1e4Degrees) {
  for (const double size : {1.0, 1e-20, 1e13}) {
    const double error = normalError(size * glm::dvec3(1, 2, 5));
    EXPECT_LE(error, 1e-4) << size;
    std::printf("size %g: %.1e degrees\n", size, error);
  }
}

// Returns the largest error of the clip distance relative to the point's distance from the eye.
double cutError(double offset) {
  const Scene origin = corridor();
  const Scene scene = moved(origin, offset * glm::dvec3(1.0, -0.7, 0.9));
  const SceneState state = evaluate(scene, 0.0);
  const FramePlan plan = planOf(scene, width, height, 1);
  double error = 0.0;
  for (const Pass& pass : plan.drawnMirrors()) {
    const gpu::InstanceData data = dataIn(plan, pass.view, state.instances[0]);
    const Mirror& mirror = origin.mirrors[pass.view.path[0]];
    const LongVec3 n = longRotation(mirror.rotation)[2];
    for (const Vertex& vertex : origin.meshes[0].vertices) {
      const LongVec3 world = worldPoint(origin.objects[0], vertex);
      const double exact = static_cast<double>(glm::dot(n, world - LongVec3(mirror.position)));
      const double distance = glm::length(glm::dvec3(world) - origin.camera.position);
      const float shader = glm::dot(data.clipPlane, glm::vec4(glm::vec3(vertex.position), 1.0f));
      error = std::max(error, std::abs(shader - exact) / distance);
    }
  }
  return error;
}

TEST(ObjectAcrossTheMirrorPlane, CutIsWithin1e6OfTheDistance) {
  for (const double offset : {0.0, 1e3, 1e7}) {
    const double error = cutError(offset);
    EXPECT_LE(error, 1e-6) << offset;
    std::printf("%g m: cut off by %.1e of the distance\n", offset, error);
  }
}

// Points of two rooms, one on each side of each mirror's plane, that the wrong plane would cut.
TEST(NestedMirrors, PassesAreCutAtTheirMirrors) {
  const Scene scene = corridor();
  const SceneState state = evaluate(scene, 0.0);
  const FramePlan plan = planOf(scene, width, height, 4);
  ASSERT_EQ(plan.drawnMirrors().size(), 4u);
  int wrong = 0;
  for (const Pass& pass : plan.drawnMirrors()) {
    const Mirror& mirror = scene.mirrors[pass.view.path.back()];
    const LongVec3 n = longRotation(mirror.rotation)[2];
    InstanceState cloud = state.instances[0];
    cloud.worldFromMesh.translation = mirror.position;
    const gpu::InstanceData data = dataIn(plan, pass.view, cloud);
    for (const Vertex& vertex : scene.meshes[0].vertices) {
      const LongVec3 offset =
          longRotation(scene.objects[0].rotation) * (LongVec3(scene.objects[0].scale) * LongVec3(vertex.position));
      const bool front = glm::dot(n, offset) > 0;
      wrong += (glm::dot(data.clipPlane, glm::vec4(glm::vec3(vertex.position), 1.0f)) > 0.0f) != front;
    }
    EXPECT_EQ(pass.view.mirrored(), pass.view.path.size() % 2 == 1);
    EXPECT_EQ(glm::determinant(pass.view.worldToView) < 0.0, pass.view.mirrored());
  }
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace speculum
