// Hard cases of planes, rectangles and skipped mirrors, against rays cast at the polygon itself.
#include "geometry/polygon.hpp"
#include "plan/mirror_sight.hpp"
#include "systems/gpu_conversion.hpp"
#include "test_headers.hpp"
#include "transform_support.hpp"

namespace speculum {
namespace {

using namespace hard_cases;

constexpr int columns = 48;
constexpr int rows = 27;

glm::dvec3 withFourDecimals(const glm::dvec3& v) {
  return glm::round(v * 1e4) / 1e4;
}

TEST(NormalNotOfUnitLength, ReflectionIsUnaffected) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const glm::dvec3 n = random.direction();
    const glm::dvec3 rounded = withFourDecimals(n);
    const glm::dvec3 point = random.inBox(5.0);
    const glm::dvec3 p = random.inBox(5.0);
    const glm::dmat3 exact = reflectionLinear(n);
    EXPECT_LE(largestEntry(reflectionLinear(10.0 * n) - exact), 1e-6);
    EXPECT_LE(glm::length(reflectPoint(p, {point, 10.0 * n}) - reflectPoint(p, {point, n})), 1e-6);
    // Rounding turns the plane by up to 1e-4 rad; within it, lengths are kept.
    const glm::dmat3 turned = reflectionLinear(glm::normalize(rounded));
    EXPECT_LE(largestEntry(reflectionLinear(rounded) - turned), 1e-6);
    EXPECT_LE(largestEntry(reflectionLinear(rounded) * reflectionLinear(rounded) - glm::dmat3(1.0)), 1e-6);
  }
}

TEST(NormalNotOfUnitLength, ViewInTheMirrorIsUnaffected) {
  const View parent = mainView(lookAt({1, 2, 3}, {0, 0, 0}, {0, 1, 0}, 60, 0.001), Projection(1.0, 1.5, 0.001), 48, 32);
  const std::vector<glm::dvec3> polygon = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  const View unit = reflectedView(parent, 0, {{0, 0, 0}, {0, 0, 1}}, polygon, {0, 0, 48, 32}, {48, 32});
  const View scaled = reflectedView(parent, 0, {{0, 0, 0}, {0, 0, 10}}, polygon, {0, 0, 48, 32}, {48, 32});
  EXPECT_LE(glm::length(unit.eye - scaled.eye), 1e-6);
  EXPECT_LE(largestEntry(unit.worldToView - scaled.worldToView), 1e-6);
}

const Projection usual(glm::radians(60.0), 16.0 / 9.0, 0.001);

TEST(EyeOnOrBehindTheMirrorPlane, ObliqueDepthDoesNotExist) {
  const glm::dvec3 n = glm::normalize(glm::dvec3(0.3, 0.2, -1.0));
  EXPECT_TRUE(obliqueProjection(usual, {n, -0.5}));
  EXPECT_FALSE(obliqueProjection(usual, {n, 0.0})) << "depth would not depend on distance";
  EXPECT_FALSE(obliqueProjection(usual, {n, 0.5})) << "depth would grow with distance";
}

// A mirror in any orientation and an eye at height `h` above its plane, beside the mirror or over it, that looks along
// the plane and a little towards it.
Scene eyeAtHeight(Random& random, double h, const glm::dvec3& offset) {
  Scene scene;
  Mirror mirror{.position = offset + random.inBox(3.0), .rotation = random.inBox(170.0), .size = {2, 2}};
  const glm::dmat3 frame = rotationFromDegrees(mirror.rotation);
  const glm::dvec3 along = glm::normalize(random.uniform(-1, 1) * frame[0] + random.uniform(-1, 1) * frame[1]);
  scene.camera.position = mirror.position - random.uniform(0.5, 3.0) * along + h * frame[2];
  scene.camera.target = scene.camera.position + along - 0.2 * frame[2];
  scene.camera.up = frame[2];
  scene.mirrors.push_back(mirror);
  return scene;
}

TEST(EyeOnOrBehindTheMirrorPlane, PassIsSkippedAndTheBackDrawn) {
  Random random(2);
  for (int i = 0; i < 2000; ++i) {
    for (const double far : {0.0, 1e3, 1e7}) {
      const glm::dvec3 offset = far * random.direction();
      const FramePlan on = planOf(eyeAtHeight(random, 0.0, offset), columns, rows);
      ASSERT_TRUE(on.drawnMirrors().empty()) << "in the plane, case " << i << ", " << far << " m out";
      ASSERT_TRUE(on.main().mirrors.empty()) << "in the plane, case " << i << ", " << far << " m out";
      const double back = -std::pow(10.0, random.uniform(far > 1e6 ? -6 : -9, 0));
      const Scene behind = eyeAtHeight(random, back, offset);
      const FramePlan plan = planOf(behind, columns, rows);
      ASSERT_TRUE(plan.drawnMirrors().empty()) << "behind the plane, case " << i;
      for (const MirrorDraw& draw : plan.main().mirrors) {
        ASSERT_TRUE(draw.back) << "behind the plane, case " << i;
      }
      const FramePlan front = planOf(eyeAtHeight(random, -back, offset), columns, rows);
      ASSERT_EQ(front.drawnMirrors().size(), 1u) << "before the plane, case " << i << ", height " << -back;
    }
  }
}

TEST(MirrorOutsideTheView, ObliqueDepthDoesNotExist) {
  // Planes that no ray of the frustum meets on the far side: beside it, and parallel to its edge.
  for (const glm::dvec3& n : {glm::dvec3(0, 0, 1), glm::normalize(glm::dvec3(0.2, 0.1, 1.0))}) {
    EXPECT_FALSE(obliqueProjection(usual, {n, -0.5}));
  }
  // Looking along the edge of the view exactly: the corner's distance is zero.
  const glm::dvec3 edge = glm::normalize(glm::dvec3(1.0, 0.0, usual.aspect / usual.focal));
  EXPECT_FALSE(obliqueProjection(usual, {edge, -0.5}));
}

bool insidePolygon(const MirrorState& mirror, const glm::dvec3& p) {
  for (size_t i = 0; i < mirror.polygon.size(); ++i) {
    const glm::dvec3& a = mirror.polygon[i];
    const glm::dvec3& b = mirror.polygon[(i + 1) % mirror.polygon.size()];
    if (glm::dot(glm::cross(b - a, p - a), mirror.normal) < 0.0) {
      return false;
    }
  }
  return true;
}

// Pixels whose centre's ray meets the only mirror.
std::vector<glm::ivec2> hitPixels(const SceneState& state, const Projection& f) {
  const MirrorState& mirror = state.mirrors[0];
  const double height0 = glm::dot(mirror.normal, mirror.origin - state.camera.eye);
  std::vector<glm::ivec2> hits;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      const glm::dvec2 p = glm::dvec2(x, y) + 0.5;
      const glm::dvec3 view((2.0 * p.x / columns - 1.0) * f.aspect / f.focal, (1.0 - 2.0 * p.y / rows) / f.focal, -1.0);
      const glm::dvec3 ray = glm::transpose(state.camera.worldToView) * view;
      const double t = height0 / glm::dot(mirror.normal, ray);
      if (t > 0.0 && std::isfinite(t) && insidePolygon(mirror, state.camera.eye + t * ray)) {
        hits.emplace_back(x, y);
      }
    }
  }
  return hits;
}

// The eye close to a large mirror, which reaches behind it, in directions that show some of it.
Scene acrossTheEyePlane(Random& random) {
  Scene scene;
  Mirror mirror{.position = random.inBox(1.0), .rotation = random.inBox(170.0)};
  mirror.size = {random.uniform(2, 20), random.uniform(2, 20)};
  const glm::dmat3 frame = rotationFromDegrees(mirror.rotation);
  scene.camera.position = mirror.position + random.uniform(-0.5, 0.5) * mirror.size.x * frame[0] +
                          random.uniform(-0.5, 0.5) * mirror.size.y * frame[1] +
                          std::pow(10.0, random.uniform(-6, 0.5)) * frame[2];
  scene.camera.target = scene.camera.position + random.direction();
  scene.camera.up = random.direction();
  scene.camera.verticalFov = random.uniform(20, 120);
  scene.mirrors.push_back(mirror);
  return scene;
}

TEST(MirrorCrossesTheEyePlane, RectangleHoldsEveryHitPixel) {
  Random random(4);
  int views = 0;
  while (views < 1500) {
    const Scene scene = acrossTheEyePlane(random);
    const SceneState state = evaluate(scene, 0.0);
    const FramePlan plan = planOf(scene, columns, rows);
    const std::vector<glm::ivec2> hits = hitPixels(state, plan.projection);
    const auto clip = toClip(plan.main().view, plan.projection, state.mirrors[0].polygon);
    const bool crosses = std::ranges::any_of(clip, [](const glm::dvec4& v) { return v.w <= 0.0; });
    if (!crosses || hits.empty()) {
      continue;
    }
    ++views;
    ASSERT_EQ(plan.drawnMirrors().size(), 1u);
    for (const glm::ivec2& p : hits) {
      EXPECT_TRUE(plan.drawnMirrors()[0].view.rect.contains(p.x, p.y)) << "view " << views;
    }
  }
}

// Moves the mirror just past one of the planes that bound the view.
void moveOutside(Random& random, Scene& scene) {
  const SceneState state = evaluate(scene, 0.0);
  const Projection projection(state.camera.verticalFov, static_cast<double>(columns) / rows, 0.001);
  const View view = mainView(state.camera, projection, columns, rows);
  const glm::dvec3 inward = view.cone[static_cast<size_t>(random.uniform(0.0, 3.999))];
  double reach = -1e300;
  for (const glm::dvec3& p : state.mirrors[0].polygon) {
    reach = std::max(reach, glm::dot(inward, p - view.eye));
  }
  scene.mirrors[0].position -= (reach + std::pow(10.0, random.uniform(-9, 0))) * inward;
  scene.mirrors[0].twoSided = true;
}

TEST(MirrorOutsideTheView, HasNoPassAtAll) {
  Random random(5);
  for (int i = 0; i < 3000; ++i) {
    Scene scene = acrossTheEyePlane(random);
    moveOutside(random, scene);
    const FramePlan plan = planOf(scene, columns, rows);
    ASSERT_TRUE(plan.drawnMirrors().empty()) << "view " << i;
    ASSERT_EQ(skippedCount(plan), 1u);
  }
}

// Between two mirrors at 180/n degrees a ray meets mirrors n times at most, so that images of depth n and less fill the
// view once: 2n passes, however deep they may go. Planes through edges of such images coincide.
TEST(CornersThatDivide180Degrees, ImagesFillTheViewOnce) {
  Random random(6);
  for (int n = 2; n <= 12; ++n) {
    for (int i = 0; i < 20; ++i) {
      const double angle = std::numbers::pi / n;
      const auto wall = [&](double at, bool left) {
        const glm::dvec3 far(1e3 * std::cos(at), 0.0, 1e3 * std::sin(at));
        const glm::dvec3 up(0, 1e3, 0);
        Mirror mirror;
        mirror.polygon = left ? std::vector{far - up, -up, up, far + up} : std::vector{-up, far - up, far + up, up};
        return mirror;
      };
      Scene scene;
      scene.mirrors = {wall(0.0, false), wall(angle, true)};
      const double at = random.uniform(0.05, 0.95) * angle;
      scene.camera.position = {2.0 * std::cos(at), random.uniform(-1, 1), 2.0 * std::sin(at)};
      scene.camera.target = {0.0, random.uniform(-0.2, 0.2), 0.0};
      scene.camera.verticalFov = 40.0;
      const FramePlan plan = planOf(scene, columns, rows, 32);
      std::map<int, double> areas;
      for (const Pass& pass : plan.drawnMirrors()) {
        areas[depthOf(pass.view.path)] += pass.areaPx;
      }
      EXPECT_LE(plan.drawnMirrors().size(), 2u * n) << n;
      EXPECT_LE(static_cast<int>(areas.size()), n) << n;
      for (const auto& [depth, area] : areas) {
        EXPECT_LE(area, columns * rows + 1e-6) << n << ", depth " << depth;
      }
      EXPECT_NEAR(areas[0], columns * rows, 1e-6) << n;
    }
  }
}

// Strips across strips, all in one plane, would be cut into 90 000 parts in each pass.
TEST(MirrorsOfOnePlane, CutsAreLimited) {
  constexpr int strips = 300;
  Pass pass;
  SceneState state;
  std::vector<std::vector<ClipPolygon>> polygons;
  for (int i = 0; i < 2 * strips; ++i) {
    const bool across = i >= strips;
    const double low = 2.0 * (i % strips) / strips - 1.0;
    const double high = low + 1.0 / strips;
    const auto corner = [&](double along, double side) {
      return across ? glm::dvec4(side, along, 0.5, 1.0) : glm::dvec4(along, side, 0.5, 1.0);
    };
    polygons.push_back({{corner(-1, low), corner(1, low), corner(1, high), corner(-1, high)}});
    state.mirrors.emplace_back().plane = 0;
    pass.mirrors.emplace_back().mirror = i;
    pass.mirrors.back().layer = across;
  }
  size_t cuts = 0;
  EXPECT_EQ(partsToDraw(pass, state, polygons, 0, cuts).size(), 1u);
  EXPECT_EQ(partsToDraw(pass, state, polygons, strips, cuts).size(), strips + 1u) << "and the whole behind them";
  for (size_t i = strips + 1; i < 2 * strips; ++i) {
    partsToDraw(pass, state, polygons, i, cuts);
  }
  EXPECT_LE(cuts, 100'000u + strips + 1);
}

}  // namespace
}  // namespace speculum
