// Hidden mirrors, masks of mirror passes and the order of draws, without a GPU.
#include "geometry/affine.hpp"
#include "plan/frame_plan.hpp"
#include "plan/pass_mask.hpp"
#include "plan/support.hpp"
#include "random.hpp"
#include "systems/triangles.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

using namespace testing_support;

// Every object is a square of 2 m that faces +z.
Scene sceneWith(std::vector<Mirror> mirrors, const std::vector<Object>& objects) {
  Scene scene = testing_support::sceneWith(std::move(mirrors));
  scene.objects = objects;
  scene.meshes = {meshOf({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {0, 1, 2, 0, 2, 3})};
  return scene;
}

Object square(const glm::dvec3& position, const glm::dvec3& scale = glm::dvec3(1.0)) {
  return {.name = "door", .mesh = 0, .position = position, .scale = scale};
}

bool isHidden(const FramePlan& plan, const MirrorPath& path) {
  const SkippedMirror* skip = skipOf(plan, path);
  return skip && skip->reason == SkipReason::hidden;
}

// Says whether the objects hide the mirror.
bool doHide(const std::vector<Object>& objects, const Mirror& mirror) {
  return isHidden(planOf(sceneWith({mirror}, objects)), {0});
}

TEST(Hidden, MirrorsBehindObjectsNeedNoPass) {
  const FramePlan p = planOf(sceneWith({wall({0, 0, -5}, 0, {2, 2})}, {square({0, 0, -3})}));
  EXPECT_TRUE(p.drawnMirrors().empty());
  EXPECT_TRUE(p.main().mirrors.empty());
  ASSERT_TRUE(isHidden(p, {0}));
  EXPECT_EQ(skipOf(p, {0})->detail, "behind object 'door'");
}

TEST(Hidden, MirrorsHideMirrorsFromBothSides) {
  for (const double yaw : {0.0, 180.0}) {
    Mirror screen = wall({0, 0, -3}, yaw, {2, 2});
    screen.name = "screen";
    const FramePlan p = planOf(sceneWith({wall({0, 0, -5}, 0, {2, 2}), screen}, {}));
    ASSERT_TRUE(isHidden(p, {0})) << yaw;
    EXPECT_EQ(skipOf(p, {0})->detail, "behind mirror 'screen'");
    ASSERT_EQ(p.main().mirrors.size(), 1u);
    EXPECT_EQ(p.main().mirrors[0].mirror, 1);
  }
}

TEST(Hidden, BacksAreNotDrawnEither) {
  const FramePlan p = planOf(sceneWith({wall({0, 0, -5}, 180, {2, 2})}, {square({0, 0, -3})}));
  EXPECT_TRUE(p.main().mirrors.empty());
  EXPECT_EQ(skipOf(p, {0})->reason, SkipReason::backface);
}

TEST(Hidden, OccludersMustCoverAllInFront) {
  const Mirror mirror = wall({0, 0, -5}, 0, {2, 2});
  EXPECT_FALSE(doHide({square({0, 0, -7}, {9, 9, 1})}, mirror)) << "behind it";
  EXPECT_FALSE(doHide({square({0.9, 0, -3})}, mirror)) << "part of it peeps out";
  EXPECT_FALSE(doHide({square({-0.5, 0, -3}, {0.5, 1, 1}), square({0.5, 0, -3}, {0.5, 1, 1})}, mirror))
      << "two halves are not one";
  EXPECT_FALSE(doHide({square({0, 0, -4.9999999})}, mirror)) << "depth cannot be sure";
  EXPECT_FALSE(doHide({square({0, 0, 3})}, mirror)) << "behind the eye";
  // The outline is 0.6 m wide at 3 m; a pixel is 3 * 2 tan(30) / 360 = 9.6 mm there.
  EXPECT_FALSE(doHide({square({0, 0, -3}, {0.605, 0.605, 1})}, mirror)) << "half a pixel";
  EXPECT_TRUE(doHide({square({0, 0, -3}, {0.612, 0.612, 1})}, mirror)) << "more than a pixel";
}

TEST(Hidden, OnlyVisibleRegionsMustBeCovered) {
  // The mirror reaches far past the picture's border, the occluder only just.
  EXPECT_TRUE(doHide({square({0, 0, -1}, {1.1, 0.62, 1})}, wall({0, 0, -5}, 0, {90, 90})));
}

TEST(Hidden, WireframeAndSwitchHideNothing) {
  const Scene scene = sceneWith({wall({0, 0, -5}, 0, {2, 2})}, {square({0, 0, -3})});
  Settings settings;
  settings.view.wireframe = true;
  EXPECT_EQ(planOf(scene, settings).drawnMirrors().size(), 1u);
  settings = {};
  settings.debug.skipHidden = false;
  EXPECT_EQ(planOf(scene, settings).drawnMirrors().size(), 1u);
}

// A mirror at z = -4 shows the one behind the camera; a door stands in between, or behind the first mirror's plane.
TEST(Hidden, MirrorsHideOnlyWithWhatTheyReflect) {
  const std::vector<Mirror> facing = {wall({0, 0, -4}, 0, {3, 3}), wall({0, 0, 6}, 180, {2, 2})};
  EXPECT_TRUE(isHidden(planOf(sceneWith(facing, {square({0, 0, 2}, {3, 3, 1})})), {0, 1}));
  const FramePlan beyond = planOf(sceneWith(facing, {square({0, 0, -6}, {3, 3, 1})}));
  EXPECT_FALSE(isHidden(beyond, {0, 1}));
  EXPECT_EQ(beyond.drawnMirrors().back().view.path, MirrorPath{0});
  ASSERT_TRUE(std::ranges::any_of(beyond.drawnMirrors(), [](const auto& pass) {
    return pass.view.path == MirrorPath{0, 1};
  }));
  // A door stands across the plane. Only its part before the plane is reflected, so only that part hides.
  Object across = square({0, 0, -4}, {3, 3, 1});
  across.rotation = {0, 90, 0};
  EXPECT_FALSE(isHidden(planOf(sceneWith(facing, {across})), {0, 1}));
}

TEST(Hidden, OverlappingOccludersHideTogether) {
  const Mirror mirror = wall({0, 0, -5}, 0, {2, 2});
  Object left = square({-0.5, 0, -3}, {0.6, 1, 1});
  Object right = square({0.5, 0, -2}, {0.6, 1, 1});
  left.name = "left";
  right.name = "right";
  const FramePlan p = planOf(sceneWith({mirror}, {left, right}));
  EXPECT_TRUE(p.drawnMirrors().empty());
  ASSERT_TRUE(isHidden(p, {0}));
  EXPECT_EQ(skipOf(p, {0})->detail, "behind object 'left' and object 'right'");
  right.position.x = 0.75;  // a gap
  EXPECT_FALSE(doHide({left, right}, mirror));
}

TEST(Hidden, OccluderOfAllIsNamedAlone) {
  Object half = square({-0.5, 0, -3}, {0.6, 1, 1});
  half.name = "half";
  const FramePlan p = planOf(sceneWith({wall({0, 0, -5}, 0, {2, 2})}, {half, square({0, 0, -3})}));
  ASSERT_TRUE(isHidden(p, {0}));
  EXPECT_EQ(skipOf(p, {0})->detail, "behind object 'door'");
}

// A scene with boxes of 2 m. They have no flat occluders.
Scene sceneWithBoxes(std::vector<Mirror> mirrors, const std::vector<Object>& objects) {
  Scene scene = sceneWith(std::move(mirrors), objects);
  Triangles boxes;
  for (int side = 0; side < 6; ++side) {
    const auto at = [&](double x, double y) {
      glm::dvec3 p;
      p[side / 2] = side % 2 == 0 ? 1.0 : -1.0;
      p[(side / 2 + 1) % 3] = x;
      p[(side / 2 + 2) % 3] = y;
      return p;
    };
    boxes.quad(at(-1, -1), at(1, -1), at(1, 1), at(-1, 1));
  }
  scene.meshes = {meshOf(boxes.positions, boxes.indices)};
  scene.meshes[0].faces.clear();
  return scene;
}

TEST(Hidden, BodiesHideMoreThanTheirFaces) {
  Object post = square({0, 0, -3}, {0.5, 1, 0.5});
  post.rotation = {0, 45, 0};  // an edge towards the eye
  const Mirror mirror = wall({0, 0, -5}, 0, {0.8, 0.8});
  EXPECT_TRUE(isHidden(planOf(sceneWithBoxes({mirror}, {post})), {0}));
  post.position.z = -4.6;  // the mirror is in it
  EXPECT_FALSE(isHidden(planOf(sceneWithBoxes({mirror}, {post})), {0}));
  post.position = {0.6, 0, -3};
  EXPECT_FALSE(isHidden(planOf(sceneWithBoxes({mirror}, {post})), {0})) << "part of it peeps out";
  post.position = {0, 0, -0.5};
  EXPECT_FALSE(isHidden(planOf(sceneWithBoxes({mirror}, {post})), {0})) << "the eye is in it";
}

// With the eye in an occluder's plane, rounding decides on which side of its edges the eye lies.
TEST(Hidden, EdgeOnSheetsHideNothing) {
  Random random(5);
  for (int round = 0; round < 2000; ++round) {
    const double yaw = 90.0 * random.uniform(-1, 1);
    Object sheet = square({0, 0, 0}, {1.0, 1.0, round % 2 == 0 ? 1e-17 : 1e-9});
    sheet.rotation = {0, yaw, 0};
    const glm::dvec3 along(std::cos(glm::radians(yaw)), 0, -std::sin(glm::radians(yaw)));
    const double distance = random.uniform(1, 3);
    sheet.position = (along.z < 0.0 ? distance : -distance) * along;
    const glm::dvec3 aside(-along.z, 0, along.x);
    for (const double side : {-1.5, 1.5}) {
      Scene scene = sceneWithBoxes({wall(3.0 * sheet.position + side * aside, 0, {0.5, 0.5})}, {sheet});
      scene.camera.target = scene.mirrors[0].position;
      EXPECT_FALSE(isHidden(planOf(scene), {0})) << "round " << round;
    }
  }
}

// Says whether a convex polygon holds a point, both in device coordinates.
bool holds(const std::vector<glm::dvec2>& polygon, const glm::dvec2& p) {
  bool left = true;
  bool right = true;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 a = polygon[i];
    const glm::dvec2 edge = polygon[(i + 1) % polygon.size()] - a;
    const double side = edge.x * (p.y - a.y) - edge.y * (p.x - a.x);
    left = left && side >= 0.0;
    right = right && side <= 0.0;
  }
  return left || right;
}

// Returns the areas of the triangles that a convex polygon is drawn as.
std::vector<double> fanAreas(const std::vector<glm::dvec2>& polygon) {
  std::vector<double> areas;
  for (size_t i = 1; i + 1 < polygon.size(); ++i) {
    const glm::dvec2 a = polygon[i] - polygon[0];
    const glm::dvec2 b = polygon[i + 1] - polygon[0];
    areas.push_back(0.5 * std::abs(a.x * b.y - a.y * b.x));
  }
  return areas;
}

TEST(PassMask, CoversTheMirrorAndItsLookups) {
  Mirror mirror = wall({0.2, -0.1, -5}, 30, {3, 2});
  mirror.rotation = {20, 30, 25};
  for (const double scale : {1.0, 0.5, 2.0}) {
    Settings settings;
    settings.reflection.scale = scale;
    const FramePlan p = planOf(sceneWith({mirror}, {}), settings);
    ASSERT_EQ(p.drawnMirrors().size(), 1u);
    const Pass& pass = p.drawnMirrors()[0];
    const double reach = lookupReach(pass, settings, false);
    const std::vector<glm::dvec2> mask = passMask(pass.view, p.projection, reach);
    ASSERT_GE(mask.size(), 4u);
    const auto clip = toClip(p.main().view, p.projection, p.main().mirrors[0].polygon);
    const glm::dvec2 texel = 2.0 / pass.view.pictureSize;
    const PixelRect& rect = pass.view.rect;
    const glm::dvec2 low = (glm::dvec2(rect.x, rect.y) + 1e-6) * texel - 1.0;
    const glm::dvec2 high = low + (glm::dvec2(rect.width, rect.height) - 2e-6) * texel;
    for (const glm::dvec4& v : clip) {
      for (int i = 0; i < 4; ++i) {
        const glm::dvec2 off(i % 4 < 2 ? 1 : -1, i % 2 == 0 ? 1 : -1);
        const glm::dvec2 near = glm::dvec2(v) / v.w + 0.99 * reach * texel * off;
        EXPECT_TRUE(holds(mask, glm::clamp(near, low, high))) << scale;
      }
    }
    const std::vector<double> areas = fanAreas(mask);
    const double texels = std::accumulate(areas.begin(), areas.end(), 0.0) / (texel.x * texel.y);
    EXPECT_LT(texels, pass.areaPx * (scale < 1.0 ? 1.2 : 1.12)) << scale;
    EXPECT_LT(texels, 0.75 * pass.view.rect.area()) << "the mirror is tilted";
  }
}

// In a kaleidoscope, planes through edges of different mirrors coincide up to rounding.
TEST(PassMask, HasNoTriangleWithoutArea) {
  std::mt19937 engine(8);
  const auto oneOf = [&](const std::vector<double>& values) { return values[engine() % values.size()]; };
  int masks = 0;
  for (int round = 0; round < 150; ++round) {
    const int sides = static_cast<int>(oneOf({3, 4, 5, 6, 8}));
    const double radius = oneOf({1.0, 1.5, 2.0});
    std::vector<Mirror> mirrors;
    for (int side = 0; side < sides; ++side) {
      const double angle = 360.0 * side / sides;
      const double across = 2.0 * radius * std::tan(glm::radians(180.0 / sides));
      Mirror& mirror = mirrors.emplace_back(
          wall({radius * std::sin(glm::radians(angle)), 0, -3 + radius * std::cos(glm::radians(angle))}, angle + 180.0,
               {across, oneOf({1.0, 4.0, 40.0})}));
      mirror.twoSided = round % 3 == 0;
    }
    Scene scene = sceneWith(mirrors, {});
    scene.camera.position = {oneOf({0.0, 0.1, -0.1}), oneOf({0.0, 0.2}), -3 + oneOf({0.0, 0.1, 0.5})};
    scene.camera.target = scene.camera.position + glm::dvec3(oneOf({0.0, 1.0, -0.5}), oneOf({0.0, 0.5, 1.0}), -1);
    scene.camera.verticalFov = oneOf({60, 90, 120});
    Settings settings;
    settings.reflection.maxDepth = 6;
    settings.reflection.maxPasses = 1000;
    settings.reflection.scale = oneOf({0.5, 1.0});
    const FramePlan p = planOf(scene, settings);
    for (const Pass& pass : p.drawnMirrors()) {
      std::vector<glm::dvec2> mask = passMask(pass.view, p.projection, lookupReach(pass, settings, true));
      for (glm::dvec2& corner : mask) {
        corner = glm::round((corner * 0.5 + 0.5) * pass.view.pictureSize * 256.0);  // as GPUs snap vertices
      }
      for (const double area : fanAreas(mask)) {
        ASSERT_GT(area, 0.0) << "round " << round << ", pass " << pass.view.path.size();
        ++masks;
      }
    }
  }
  EXPECT_GT(masks, 5000);
}

// The mirror's edges pass near the corners of its rectangle.
TEST(OutsideParts, HoldEachTexelBesideTheMirror) {
  Random random(5);
  int outside = 0;
  for (int round = 0; round < 300; ++round) {
    Mirror mirror =
        wall({random.uniform(-1, 1), random.uniform(-1, 1), -5}, 0, {random.uniform(0.5, 3), random.uniform(0.5, 3)});
    mirror.rotation = glm::dvec3(random.uniform(-50, 50), random.uniform(-50, 50), random.uniform(-180, 180));
    Settings settings;
    settings.reflection.scale = random.uniform(0.02, 0.3);
    const Scene scene = sceneWith({mirror}, {});
    const FramePlan p = planOf(scene, settings);
    if (p.drawnMirrors().empty()) {
      continue;
    }
    const View& view = p.drawnMirrors()[0].view;
    std::vector<glm::dvec2> outline;
    for (const glm::dvec4& v : toClip(p.main().view, p.projection, evaluate(scene, 0.0).mirrors[0].polygon)) {
      outline.push_back((glm::dvec2(v) / v.w * 0.5 + 0.5) * view.pictureSize);
    }
    const std::vector<std::vector<glm::dvec2>> parts = outsideParts(view, p.projection);
    for (int y = view.rect.y; y < view.rect.y + view.rect.height; ++y) {
      for (int x = view.rect.x; x < view.rect.x + view.rect.width; ++x) {
        const glm::dvec2 center(x + 0.5, y + 0.5);
        double inside = INFINITY;  // texels from the nearest edge, below 0 outside
        double winding = 0.0;
        for (size_t i = 0; i < outline.size(); ++i) {
          const glm::dvec2 edge = outline[(i + 1) % outline.size()] - outline[i];
          const glm::dvec2 to = outline[(i + 2) % outline.size()] - outline[i];
          winding = edge.x * to.y - edge.y * to.x > 0.0 ? 1.0 : -1.0;
          const glm::dvec2 at = center - outline[i];
          inside = std::min(inside, winding * (edge.x * at.y - edge.y * at.x) / glm::length(edge));
        }
        if (std::abs(inside) > 0.01) {
          const glm::dvec2 device = center / view.pictureSize * 2.0 - 1.0;
          const bool marked = std::ranges::any_of(parts, [&](const auto& part) { return holds(part, device); });
          ASSERT_EQ(marked, inside < 0.0) << "round " << round << ", " << inside << " texels inside";
          outside += marked;
        }
      }
    }
  }
  EXPECT_GT(outside, 1000);
}

// A mirror that is cut for drawing reaches beyond all that is read of its image, at any angle and resolution.
TEST(MirrorPolygons, ReachAsFarAsImagesAreRead) {
  for (const double fov : {20.0, 90.0, 160.0}) {
    Scene scene = corridor();
    scene.mirrors[1].size = {40, 40};
    scene.camera.verticalFov = fov;
    Settings settings;
    settings.reflection.scale = 0.05;
    settings.reflection.maxDepth = 8;
    const SceneState state = evaluate(scene, 0.0);
    const FramePlan plan = planOf(scene, settings);
    ASSERT_GE(plan.drawnMirrors().size(), 2u);
    const std::vector<double> reaches = lookupReaches(plan, settings, false);
    for (const Pass& pass : plan.drawnMirrors()) {
      View read = pass.view;
      widen(read, plan.projection, static_cast<int>(std::ceil(reaches[&pass - plan.passes.data()])));
      for (const MirrorDraw& draw : pass.mirrors) {
        const double all = polygonArea(visiblePart(read, state.mirrors[draw.mirror].polygon));
        EXPECT_NEAR(polygonArea(visiblePart(read, draw.polygon)), all, 1e-9 * all) << fov;
      }
    }
  }
}

TEST(PassMask, IsEmptyWhereMirrorsFillTheirRectangle) {
  const FramePlan p = planOf(sceneWith({wall({0, 0, -1}, 0, {20, 20})}, {}));
  ASSERT_EQ(p.drawnMirrors().size(), 1u);
  EXPECT_TRUE(passMask(p.drawnMirrors()[0].view, p.projection, 1.5).empty());
}

TEST(PassMask, ReachesAsFarAsLookupsDo) {
  Settings settings;
  Pass pass{.quality = {.samples = 4}, .shownIn = {.samples = 4}};
  EXPECT_DOUBLE_EQ(lookupReach(pass, settings, true), 0.75) << "4 samples, 1/8 from the texel's border";
  EXPECT_DOUBLE_EQ(lookupReach(pass, settings, false), 1.0) << "a whole texel";
  pass.quality.samples = 1;
  EXPECT_DOUBLE_EQ(lookupReach(pass, settings, true), 1.375) << "and the texel beside it";
  settings.view.samples = 1;
  EXPECT_DOUBLE_EQ(lookupReach(pass, settings, true), 1.375) << "what shows the image has 4";
  pass.shownIn.samples = 1;
  EXPECT_DOUBLE_EQ(lookupReach(pass, settings, true), 0.0);
  pass.shownIn.scale = 2.0;
  EXPECT_DOUBLE_EQ(lookupReach(pass, settings, true), 2.0) << "an image of fewer texels than what shows it";
  pass = {.quality = {.interval = 2}};
  EXPECT_DOUBLE_EQ(lookupReach(pass, settings, true), 2.0);
  pass.quality.scale = 4.0;
  EXPECT_DOUBLE_EQ(lookupReach(pass, settings, true), 5.0);
}

// A pixel beside a mirror's edge is read too, and may show another mirror beyond the edge at which that one was cut.
TEST(PassMask, AddsHowFarTheShowingImageIsRead) {
  FramePlan plan;
  plan.passes.resize(3);
  Pass& nested = plan.passes[0];
  nested.quality.scale = 1.0;
  nested.shownIn.scale = 2.0;
  nested.view.pictureSize = {100, 50};
  Pass& outer = plan.passes[1];
  outer.quality.scale = 2.0;
  outer.view.pictureSize = {200, 100};
  outer.mirrors.push_back({});
  outer.mirrors[0].pass = 0;
  Pass& main = plan.passes[2];
  main.view.pictureSize = {100, 50};
  main.mirrors.push_back({});
  main.mirrors[0].pass = 1;
  EXPECT_EQ(lookupReaches(plan, {}, true), (std::vector{2.0 + 0.5 * 3.0, 3.0, 0.0}));
}

TEST(PassMask, FollowsTheMarginOfACachedImage) {
  const Scene scene = sceneWith({wall({0, 0, -5}, 20, {2, 2})}, {});
  View view = planOf(scene).drawnMirrors()[0].view;
  const Projection projection = planOf(scene).projection;
  const std::vector<glm::dvec2> narrow = passMask(view, projection, 1.5);
  widen(view, projection, 20);
  const std::vector<glm::dvec2> wide = passMask(view, projection, 1.5);
  for (const glm::dvec2& p : narrow) {
    EXPECT_TRUE(holds(wide, p + glm::dvec2(19.0, 0.0) * 2.0 / view.pictureSize));
    EXPECT_TRUE(holds(wide, p - glm::dvec2(19.0, 0.0) * 2.0 / view.pictureSize));
  }
}

TEST(BoxVisible, IsTightAndNeverTooTight) {
  const Scene scene = sceneWith({wall({0, 0, -5}, 0, {2, 2})}, {});
  const FramePlan p = planOf(scene);
  Random random(5);
  const auto uniform = [&](double low, double high) { return random.uniform(low, high); };
  int culled = 0;
  for (int round = 0; round < 20000; ++round) {
    const View& view = round % 2 == 0 ? p.main().view : p.drawnMirrors()[0].view;
    const glm::dvec3 half(uniform(0.01, 2), uniform(0.01, 2), uniform(0.01, 0.05));
    const Affine place{rotationFromDegrees({uniform(0, 360), uniform(0, 360), 0}) * uniform(0.2, 2),
                       {uniform(-8, 8), uniform(-6, 6), uniform(-12, 12)}};
    const glm::dvec3 point = place.point(half * glm::dvec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)));
    const bool visible = boxVisible(view, place, half);
    if (sphereVisible(view, point, 0.0)) {
      EXPECT_TRUE(visible) << "round " << round;
    }
    culled += !visible && sphereVisible(view, place.translation, glm::length(place.linear * half));
  }
  EXPECT_GT(culled, 500) << "spheres are no tighter";
}

TEST(DrawOrder, NearMeshesFirstSurroundingsLast) {
  SceneState state;
  const auto add = [&](int mesh, double z, double radius) {
    state.instances.push_back({.mesh = mesh, .center = {0, 0, z}, .radius = radius});
  };
  add(0, -9, 1);
  add(0, -3, 1);
  add(1, -2, 1);
  add(1, -8, 1);
  add(2, -4, 30);
  add(3, -2, 1);
  const std::vector<int> all = {0, 1, 2, 3, 4, 5};
  EXPECT_EQ(frontToBack(View(), all, state), (std::vector<int>{2, 3, 5, 1, 0, 4}));
  EXPECT_EQ(frontToBack(View(), std::vector<int>{0, 5}, state), (std::vector<int>{5, 0}));
}

}  // namespace
}  // namespace speculum
