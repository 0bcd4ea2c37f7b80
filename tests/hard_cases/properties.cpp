// Invariants of the optics, with coordinates log-uniform over 1e-6 .. 1e7 of either sign. RapidCheck prints its seed;
// RC_PARAMS="seed=N" repeats a run.
#include <rapidcheck.h>

#include "geometry/polygon.hpp"
#include "test_headers.hpp"
#include "transform_support.hpp"

namespace speculum::properties {
namespace {

using namespace hard_cases;

constexpr int width = 64;
constexpr int height = 36;

// Sets RapidCheck's parameters before the first property; those in the environment take precedence.
const bool tenThousandCases = [] {
  const char* given = std::getenv("RC_PARAMS");
  const std::string wanted = "max_success=10000 " + std::string(given ? given : "");
  return setenv("RC_PARAMS", wanted.c_str(), 1) == 0;
}();

template <typename Property>
void expectProperty(const char* name, Property property) {
  ASSERT_TRUE(tenThousandCases);
  EXPECT_TRUE(rc::check(name, property)) << "see the counterexample above";
}

// Takes numbers of the whole range from the first case on; RapidCheck alone would begin with small ones.
int whole(int low, int high) {
  return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(low, high));
}

double uniform(double low, double high) {
  return low + (high - low) * whole(0, 1 << 30) / (1 << 30);
}

double size() {
  return std::pow(10.0, uniform(-6.0, 7.0));
}

double coordinate() {
  return whole(0, 2) == 0 ? size() : -size();
}

glm::dvec3 point() {
  const double x = coordinate();
  const double y = coordinate();
  return {x, y, coordinate()};
}

// Rounds to 27 binary places, so that sums and differences are exact.
glm::dvec3 dyadic(const glm::dvec3& p) {
  constexpr double unit = 134217728.0;
  return glm::round(p * unit) / unit;
}

glm::dvec3 direction() {
  return glm::normalize(point());
}

Plane plane() {
  const glm::dvec3 normal = direction();
  return {point(), normal};
}

double largest(const glm::dvec3& p) {
  return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
}

double scaleOf(const glm::dvec3& p, const Plane& m) {
  return std::max(glm::length(p), glm::length(m.point));
}

// Two-sided, so that it is seen from wherever the eye is.
Mirror triangleMirror() {
  for (;;) {
    const glm::dvec3 a = dyadic(point());
    const glm::dvec3 b = dyadic(point());
    Mirror mirror{.polygon = {a, b, dyadic(point())}, .twoSided = true};
    if (!polygonDefect(mirror.polygon)) {
      return mirror;
    }
  }
}

// A mirror and an eye that looks at a point of it.
Scene lookingAtAMirror() {
  Scene scene;
  scene.mirrors.push_back(triangleMirror());
  const std::vector<glm::dvec3>& p = scene.mirrors[0].polygon;
  const double u = uniform(0.0, 1.0);
  const double v = uniform(0.0, 1.0 - u);
  scene.camera.position = dyadic(point());
  scene.camera.target = dyadic(p[0] + u * (p[1] - p[0]) + v * (p[2] - p[0]));
  scene.camera.verticalFov = uniform(5.0, 150.0);
  const glm::dvec3 forward = scene.camera.target - scene.camera.position;
  // Whatever axis the view direction is farthest from.
  const glm::dvec3 a = glm::abs(forward);
  scene.camera.up = a.x <= a.y && a.x <= a.z ? glm::dvec3(1, 0, 0)
                    : a.y <= a.z             ? glm::dvec3(0, 1, 0)
                                             : glm::dvec3(0, 0, 1);
  return scene;
}

double reachOf(const Scene& scene) {
  double reach = std::max(largest(scene.camera.position), largest(scene.camera.target));
  for (const glm::dvec3& p : scene.mirrors[0].polygon) {
    reach = std::max(reach, largest(p));
  }
  return reach;
}

// Says whether the eye is so near the mirror's plane that rounding decides on which side it is.
bool tooNearToTell(const Scene& scene) {
  const std::vector<glm::dvec3>& p = scene.mirrors[0].polygon;
  const LongVec3 n = glm::normalize(glm::cross(LongVec3(p[1]) - LongVec3(p[0]), LongVec3(p[2]) - LongVec3(p[0])));
  const long double h = glm::dot(n, LongVec3(scene.camera.position) - LongVec3(p[0]));
  return std::abs(h) <= 1e-14L * (glm::length(LongVec3(scene.camera.position)) + glm::length(LongVec3(p[0])));
}

TEST(Invariants, ReflectionTurnsHandedness) {
  expectProperty("det R = -1", [] { RC_ASSERT(std::abs(glm::determinant(reflectionLinear(point())) + 1.0) <= 1e-14); });
}

TEST(Invariants, PointsOfThePlaneStay) {
  expectProperty("R q = q", [] {
    const Plane m = plane();
    RC_ASSERT(reflectPoint(m.point, m) == m.point);
    const glm::dvec3 along = glm::cross(m.normal, direction());
    const glm::dvec3 p = m.point + coordinate() * along;
    RC_ASSERT(glm::length(reflectPoint(p, m) - p) <= 1e-14 * scaleOf(p, m));
  });
}

TEST(Invariants, DistancesAreKept) {
  expectProperty("|Ra - Rb| = |a - b|", [] {
    const Plane m = plane();
    const glm::dvec3 a = point();
    const glm::dvec3 b = point();
    const double before = glm::length(a - b);
    const double after = glm::length(reflectPoint(a, m) - reflectPoint(b, m));
    RC_ASSERT(std::abs(before - after) <= 1e-14 * std::max(scaleOf(a, m), scaleOf(b, m)));
  });
}

TEST(Invariants, DepthFallsStrictlyWithDistance) {
  expectProperty("depth is monotone", [] {
    const Projection projection(glm::radians(uniform(1.0, 170.0)), 16.0 / 9.0, 0.001);
    const glm::mat4 m(projection.matrix());
    const double near = size();
    const double far = near * (1.0 + std::pow(10.0, uniform(-6.0, 3.0)));
    // Computes depth as a GPU does: a matrix and a point in float, one division.
    const auto depth = [&](double distance) {
      const glm::vec4 clip = m * glm::vec4(0.0f, 0.0f, static_cast<float>(-distance), 1.0f);
      return clip.z / clip.w;
    };
    RC_ASSERT(depth(near) > depth(far));
    RC_ASSERT(std::isfinite(depth(near)) && depth(far) > 0.0f);
  });
}

void checkTranslation(const Scene& scene, const glm::dvec3& offset) {
  const Scene far = moved(scene, offset);
  const FramePlan a = planOf(scene, width, height);
  const FramePlan b = planOf(far, width, height);
  const double reach = reachOf(scene) + reachOf(far);
  const auto clipsOf = [](const FramePlan& plan, const View& view, const Scene& s) {
    return toClip(view, plan.projection, s.mirrors[0].polygon);
  };
  // Differences from the eye are exact: not one bit differs before the first reflection.
  RC_ASSERT(clipsOf(a, a.main().view, scene) == clipsOf(b, b.main().view, far));
  if (tooNearToTell(scene) || tooNearToTell(far)) {
    return;
  }
  RC_ASSERT(a.drawnMirrors().size() == b.drawnMirrors().size());
  for (size_t i = 0; i < a.drawnMirrors().size(); ++i) {
    const auto before = clipsOf(a, a.drawnMirrors()[i].view, scene);
    const auto after = clipsOf(b, b.drawnMirrors()[i].view, far);
    for (size_t k = 0; k < before.size(); ++k) {
      const double lens = std::max(a.projection.focal, 1.0);
      RC_ASSERT(glm::length(before[k] - after[k]) <= 1e-14 * lens * reach);
    }
  }
}

TEST(Invariants, TranslatingEverythingChangesNothing) {
  expectProperty("translation", [] {
    const Scene scene = lookingAtAMirror();
    checkTranslation(scene, dyadic(point()));
  });
}

// Checks points of the polygon in extended precision. Returns how many are in view.
int checkRectangle(const Scene& scene) {
  if (tooNearToTell(scene)) {
    return 0;
  }
  int inView = 0;
  const FramePlan plan = planOf(scene, width, height);
  const LongMat3 worldToView = longWorldToView(scene.camera);
  const std::vector<glm::dvec3>& p = scene.mirrors[0].polygon;
  for (int i = 0; i < 40; ++i) {
    // Also close to edges and corners.
    const long double u = i % 3 == 0 ? std::pow(10.0, -0.3 * i) : 0.0125L * i;
    const long double v = (1.0L - u) * ((i * 17) % 41) / 40.0L;
    const LongVec3 hit = LongVec3(p[0]) + u * (LongVec3(p[1]) - LongVec3(p[0])) + v * (LongVec3(p[2]) - LongVec3(p[0]));
    const LongVec3 relative = hit - LongVec3(scene.camera.position);
    if ((worldToView * relative).z >= 0) {
      continue;
    }
    const glm::dvec2 pixel = longPixel(worldToView, relative, scene.camera.verticalFov, width, height);
    if (pixel.x >= 0.0 && pixel.y >= 0.0 && pixel.x < width && pixel.y < height) {
      RC_ASSERT(plan.drawnMirrors().size() == 1u);
      RC_ASSERT(plan.drawnMirrors()[0].view.rect.contains(static_cast<int>(pixel.x), static_cast<int>(pixel.y)));
      ++inView;
    }
  }
  return inView;
}

TEST(Invariants, RectangleHoldsEveryHit) {
  int64_t inView = 0;
  expectProperty("rectangle is conservative", [&] { inView += checkRectangle(lookingAtAMirror()); });
  EXPECT_GT(inView, 30000) << "too few hits to judge by";
  std::printf("%d hits\n", static_cast<int>(inView));
}

TEST(Invariants, MirrorImageShowsTheMirroredScene) {
  int judged = 0;
  expectProperty("seen in the mirror = mirrored and seen", [&] {
    const Scene scene = lookingAtAMirror();
    const glm::dvec3 p = point();
    const FramePlan plan = planOf(scene, width, height);
    if (plan.drawnMirrors().empty()) {
      return;
    }
    ++judged;
    const View& view = plan.drawnMirrors()[0].view;
    const std::vector<glm::dvec3> original = {p};
    const std::vector<glm::dvec3> mirrored = {reflectPoint(p, *view.clip)};
    const glm::dvec4 seen = toClip(view, plan.projection, original)[0];
    const glm::dvec4 direct = toClip(plan.main().view, plan.projection, mirrored)[0];
    const double reach = std::max({reachOf(scene), largest(p), largest(mirrored[0])});
    RC_ASSERT(glm::length(seen - direct) <= 1e-14 * std::max(plan.projection.focal, 1.0) * reach);
  });
  EXPECT_GT(judged, 8000);
}

}  // namespace
}  // namespace speculum::properties
