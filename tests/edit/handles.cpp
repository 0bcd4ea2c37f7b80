// The gizmo's handles, drags of them, and outlines.
#include <rapidcheck.h>

#include "edit/gizmo.hpp"
#include "edit/picture_view.hpp"
#include "edit/transform.hpp"
#include "geometry/affine.hpp"
#include "systems/triangles.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

constexpr double arm = 90.0;

double uniform(double low, double high) {
  return low + (high - low) * *rc::gen::inRange(0, 1 << 20) / (1 << 20);
}

// A scene whose camera looks somewhere, as that of every file does.
Scene emptyScene() {
  Scene scene;
  scene.camera.target = {0, 0, -1};
  return scene;
}

glm::dvec3 inBox(double side) {
  const double x = uniform(-side, side);
  const double y = uniform(-side, side);
  return {x, y, uniform(-side, side)};
}

PictureView lookingAt(const glm::dvec3& eye, const glm::dvec3& target) {
  return PictureView(lookAt(eye, target, {0.0, 1.0, 0.0}, 60.0, 0.001), 900, 700);
}

TEST(PitchYawRoll, RestoresTheRotationNearGivenAngles) {
  rc::check([] {
    const glm::dvec3 angles(*rc::gen::elementOf(std::vector<double>{uniform(-400, 400), 90.0, -90.0, 0.0, 89.99999}),
                            uniform(-400, 400), uniform(-400, 400));
    const glm::dvec3 near = angles + inBox(200.0);
    const glm::dmat3 rotation = rotationFromDegrees(angles);
    RC_ASSERT(largestEntry(rotationFromDegrees(pitchYawRoll(rotation, near)) - rotation) < 1e-7);
    const glm::dvec3 back = pitchYawRoll(rotation, angles);
    RC_ASSERT(glm::length(back - angles) < (std::abs(std::cos(glm::radians(angles.x))) > 1e-3 ? 1e-6 : 1e-2));
  });
}

TEST(PitchYawRoll, KeepsTheRollAtGimbalLock) {
  const glm::dvec3 angles(90.0, 25.0, 40.0);
  const glm::dvec3 turned = pitchYawRoll(rotationAboutAxis({0, 1, 0}, 10.0) * rotationFromDegrees(angles), angles);
  EXPECT_NEAR(turned.x, 90.0, 1e-5);
  EXPECT_NEAR(turned.y, 35.0, 1e-5);
  EXPECT_EQ(turned.z, 40.0);
}

TEST(GizmoHandles, HandlesAreHitWhereDrawn) {
  const PictureView picture = lookingAt({3, 2, 4}, {0, 0, 0});
  for (const GizmoMode mode : {GizmoMode::move, GizmoMode::turn, GizmoMode::scale}) {
    const Gizmo gizmo(mode, {0.2, 0.1, 0.0}, arm);
    std::vector<Grip> drawn;
    for (const GizmoShape& shape : gizmo.shapes(picture)) {
      ASSERT_GE(shape.points.size(), 2u);
      glm::dvec2 middle(0.0);
      for (const glm::dvec2& p : shape.points) {
        middle += p / static_cast<double>(shape.points.size());
      }
      // Takes a point of a ring where it crosses no other, or the middle of any other handle.
      const glm::dvec2 p = mode == GizmoMode::turn ? shape.points[shape.points.size() / 5] : middle;
      if (!shape.behind) {
        EXPECT_EQ(gizmo.at(picture, p, 6.0), shape.handle);
        drawn.push_back(shape.handle);
      }
    }
    EXPECT_GE(drawn.size(), mode == GizmoMode::move ? 7u : mode == GizmoMode::turn ? 3u : 4u);
    EXPECT_EQ(gizmo.at(picture, picture.pixel(gizmo.pivot()).value() + glm::dvec2(300.0, 0.0), 6.0), Grip::none);
  }
}

TEST(GizmoHandles, SizeIsTheSameAtEveryDistance) {
  for (const double distance : {0.01, 1.0, 300.0}) {
    const PictureView picture = lookingAt({0, 0, distance}, {0, 0, 0});
    double farthest = 0.0;
    for (const GizmoShape& shape : Gizmo(GizmoMode::turn, {0, 0, 0}, arm).shapes(picture)) {
      for (const glm::dvec2& p : shape.points) {
        farthest = std::max(farthest, glm::distance(p, glm::dvec2(450.0, 350.0)));
      }
    }
    EXPECT_NEAR(farthest, arm, 3.0) << distance << " m";
  }
}

// Mirrors that are smaller than the handles, seen directly or in another mirror.
TEST(GizmoHandles, AreWholeBeyondTheirMirrorsEdge) {
  rc::check([] {
    Scene scene = emptyScene();
    scene.mirrors.push_back({.position = {0, 0, -2}, .rotation = {0, uniform(-15, 15), 0}});
    scene.mirrors.back().size = glm::dvec2(uniform(0.05, 0.4), uniform(0.05, 0.4));
    scene.mirrors.push_back({.position = {0, 0, 5}, .rotation = {0, 180, 0}, .size = {19, 9}});
    const SceneState state = evaluate(scene, 0.0);
    const std::vector<int> path = *rc::gen::elementOf(std::vector<std::vector<int>>{{0}, {0, 1}, {}});
    const auto picture = lookingAt({0, 0, 1.5}, {0, 0, -2}).through(scene, state, path);
    RC_PRE(picture);
    const glm::dvec3 pivot = inBox(0.5);
    const auto mode = static_cast<GizmoMode>(*rc::gen::inRange(0, 3));
    std::map<Grip, size_t> lines;
    std::map<Grip, glm::dvec2> ends;
    const std::vector<GizmoShape> shapes = Gizmo(mode, pivot, arm).shapes(*picture);
    RC_PRE(!shapes.empty());
    for (const GizmoShape& shape : shapes) {
      if (!shape.filled) {
        lines[shape.handle] += shape.points.size() / 2;
        ends[shape.handle] = shape.points.empty() ? glm::dvec2(-1e9) : shape.points.back();
      }
    }
    for (const GizmoShape& shape : shapes) {
      const auto end = ends.find(shape.handle);
      if (shape.filled && end != ends.end()) {
        const size_t corner = modeOf(shape.handle) == GizmoMode::scale ? 0 : 1;
        RC_ASSERT(glm::distance(0.5 * (shape.points[corner] + shape.points[corner + (corner == 0 ? 2 : 1)]),
                                end->second) < 1e-6);
      }
    }
    for (const auto& [handle, count] : lines) {
      RC_ASSERT(count == (mode == GizmoMode::turn ? 72u : 1u));
    }
  });
}

// On a monitor with small pixels all of a handle grows, not its arm alone.
TEST(GizmoHandles, HeadsGrowWithTheArm) {
  const PictureView picture = lookingAt({0, 0, 4}, {0, 0, 0});
  for (const GizmoMode mode : {GizmoMode::move, GizmoMode::scale}) {
    const std::vector<GizmoShape> small = Gizmo(mode, {0, 0, 0}, arm).shapes(picture);
    const std::vector<GizmoShape> large = Gizmo(mode, {0, 0, 0}, 2.0 * arm).shapes(picture);
    ASSERT_EQ(small.size(), large.size());
    for (size_t i = 0; i < small.size(); ++i) {
      const auto length = [](const GizmoShape& shape) { return glm::distance(shape.points[0], shape.points[1]); };
      EXPECT_NEAR(length(large[i]), 2.0 * length(small[i]), 1e-6) << i;
    }
  }
}

TEST(GizmoHandles, HandlesTowardsTheEyeAreHidden) {
  const PictureView picture = lookingAt({0, 0, 4}, {0, 0, 0});
  for (const GizmoShape& shape : Gizmo(GizmoMode::move, {0, 0, 0}, arm).shapes(picture)) {
    EXPECT_NE(shape.handle, Grip::moveZ);
    EXPECT_NE(shape.handle, Grip::moveYZ);
    EXPECT_NE(shape.handle, Grip::moveZX);
  }
}

TEST(GizmoDragging, AxisFollowsThePointer) {
  rc::check([] {
    const glm::dvec3 pivot = inBox(2.0);
    const glm::dvec3 eye = pivot + glm::dvec3(uniform(-3, 3), uniform(-2, 2), uniform(2, 6));
    const PictureView picture = lookingAt(eye, pivot + inBox(0.5));
    const int axis = *rc::gen::inRange(0, 3);
    glm::dvec3 by(0.0);
    by[axis] = uniform(-1.0, 1.0);
    const auto from = picture.pixel(pivot);
    const auto to = picture.pixel(pivot + by);
    const glm::dvec3 sight = glm::normalize(pivot - eye);
    RC_PRE(from && to && std::abs(sight[axis]) < 0.95);
    GizmoDrag drag(picture, Gizmo(GizmoMode::move, pivot, arm), static_cast<Grip>(axis + 1), *from);
    const glm::dvec3 moved = drag.to(*to, false).translation;
    RC_ASSERT(glm::distance(moved, by) < 0.2 * picture.metresPerPixel(pivot));
    const glm::dvec3 snapped = drag.to(*to, true).translation;
    RC_ASSERT(std::abs(snapped[axis] - 0.1 * std::round(10.0 * by[axis])) <
              1e-12 + (std::abs(std::remainder(10 * by[axis], 1.0)) > 0.499 ? 0.1 : 0.0));
  });
}

TEST(GizmoDragging, MirrorImageFollowsThePointer) {
  Scene scene = emptyScene();
  scene.mirrors.push_back({.position = {0, 0, -2}, .rotation = {0, 20, 0}, .size = {9, 9}});
  scene.mirrors.push_back({.position = {0, 0, 5}, .rotation = {0, 190, 0}, .size = {19, 9}});
  const SceneState state = evaluate(scene, 0.0);
  const glm::dvec3 pivot(0.3, 0.2, 1.0);
  const glm::dvec3 by(0.0, 0.25, 0.4);
  for (const std::vector<int>& path : {std::vector<int>{0}, std::vector<int>{0, 1}}) {
    const PictureView picture = lookingAt({0.5, 0.4, 3.0}, {0, 0, -2}).through(scene, state, path).value();
    GizmoDrag drag(picture, Gizmo(GizmoMode::move, pivot, arm), Grip::moveYZ, picture.pixel(pivot).value());
    const glm::dvec3 moved = drag.to(picture.pixel(pivot + by).value(), false).translation;
    EXPECT_NEAR(glm::distance(moved, by), 0.0, 0.3 * picture.metresPerPixel(pivot));
  }
}

TEST(GizmoDragging, PlanesAndRingsFollowThePointer) {
  rc::check([] {
    const glm::dvec3 pivot = inBox(1.0);
    const PictureView picture = lookingAt(pivot + glm::dvec3(3, 2, 4), pivot);
    const int axis = *rc::gen::inRange(0, 3);
    const Gizmo moving(GizmoMode::move, pivot, arm);
    glm::dvec3 by = inBox(0.5);
    by[axis] = 0.0;
    const double pixel = picture.metresPerPixel(pivot);
    GizmoDrag plane(picture, moving, static_cast<Grip>(axis + 4), *picture.pixel(pivot));
    RC_ASSERT(glm::distance(plane.to(*picture.pixel(pivot + by), false).translation, by) < 0.2 * pixel);

    glm::dvec3 radius(0.0);
    radius[(axis + 1) % 3] = arm * pixel;
    glm::dvec3 unit(0.0);
    unit[axis] = 1.0;
    GizmoDrag ring(picture, Gizmo(GizmoMode::turn, pivot, arm), static_cast<Grip>(axis + 8),
                   *picture.pixel(pivot + radius));
    const double total = uniform(-700.0, 700.0);
    double degrees = 0.0;
    for (int i = 1; i <= 40; ++i) {
      const glm::dmat3 turn = rotationAboutAxis(unit, total * i / 40.0);
      degrees = ring.to(*picture.pixel(pivot + turn * radius), false).degrees;
    }
    RC_ASSERT(std::abs(degrees - total) < 0.1);
    RC_ASSERT(std::abs(std::remainder(
                  ring.to(*picture.pixel(pivot + rotationAboutAxis(unit, total) * radius), true).degrees, 15.0)) <
              1e-9);
  });
}

TEST(GizmoDragging, RingSeenEdgeOnCountsPixels) {
  const PictureView picture = lookingAt({0, 0, 4}, {0, 0, 0});
  const glm::dvec2 start(450.0, 350.0);
  GizmoDrag ring(picture, Gizmo(GizmoMode::turn, {0, 0, 0}, arm), Grip::turnY, start);
  EXPECT_NEAR(ring.to(start + glm::dvec2(arm, 0.0), false).degrees, glm::degrees(1.0), 0.1)
      << "to the right is counter-clockwise seen from above";
  EXPECT_NEAR(ring.to(start + glm::dvec2(arm, 50.0), false).degrees, glm::degrees(1.0), 0.1);
}

TEST(GizmoDragging, LastChangeStaysBeyondTheHorizon) {
  const PictureView picture = lookingAt({0, 1, 4}, {0, 1, 0});
  GizmoDrag drag(picture, Gizmo(GizmoMode::move, {0, 0, 0}, arm), Grip::moveZX, {450.0, 500.0});
  const glm::dvec3 low = drag.to({450.0, 450.0}, false).translation;
  EXPECT_LT(low.z, -0.1);
  EXPECT_EQ(drag.to({450.0, 340.0}, false).translation, low);
  EXPECT_EQ(drag.to({450.0, 350.0}, false).translation, low);
}

// Three copies of a turning object of that mesh, a turning mirror, and one of the same shape given by its corners.
Scene turningScene(const Mesh& mesh) {
  Scene scene = emptyScene();
  scene.meshes.push_back(mesh);
  scene.objects.push_back({.mesh = 0, .position = inBox(3), .rotation = inBox(180), .spin = inBox(60)});
  scene.objects[0].copies = {.count = 3, .step = inBox(1)};
  scene.mirrors.push_back({.position = inBox(3), .rotation = inBox(180), .spin = inBox(60), .size = {2, 1}});
  Mirror polygon;
  polygon.polygon = evaluate(scene, 0.0).mirrors[0].polygon;
  scene.mirrors.push_back(polygon);
  return scene;
}

TEST(Transforming, NodesStandWhereTheyWereMoved) {
  rc::check([] {
    Scene scene = turningScene({.halfExtent = glm::dvec3(0.5), .radius = 0.9});
    scene.lights.push_back({.position = inBox(3), .orbit = Orbit{inBox(1), {0.2, 1.0, 0.1}, 30.0}});
    const double time = uniform(0, 20);
    const SceneState before = evaluate(scene, time);
    const glm::dvec3 by = inBox(1);
    const glm::dmat3 turn = rotationAboutAxis(inBox(1) + glm::dvec3(1.5, 0, 0), uniform(-180, 180));
    const Selection object{Selection::Kind::object, 0, 2};
    const glm::dvec3 pivot = pivotOf(scene, before, object);
    Scene after = scene;
    after.objects[0] = std::get<Object>(turned(moved(scene.objects[0], by, time), turn, pivot + by, 2, time));
    after.lights[0] = std::get<PointLight>(moved(scene.lights[0], by, time));
    for (int i : {0, 1}) {
      const glm::dvec3 middle = pivotOf(scene, before, {Selection::Kind::mirror, i});
      after.mirrors[i] = std::get<Mirror>(turned(moved(scene.mirrors[i], by, time), turn, middle + by, 0, time));
    }
    const SceneState state = evaluate(after, time);
    RC_ASSERT(glm::distance(state.lights[0].position, before.lights[0].position + by) < 1e-8);
    RC_ASSERT(glm::distance(state.instances[2].center, before.instances[2].center + by) < 1e-8);
    RC_ASSERT(largestEntry(state.instances[2].worldFromMesh.linear - turn * before.instances[2].worldFromMesh.linear) <
              1e-8);
    for (int i : {0, 1}) {
      const glm::dvec3 middle = pivotOf(scene, before, {Selection::Kind::mirror, i});
      for (size_t v = 0; v < 4; ++v) {
        const glm::dvec3 expected = middle + by + turn * (before.mirrors[i].polygon[v] - middle);
        RC_ASSERT(glm::distance(state.mirrors[i].polygon[v], expected) < 1e-7);
      }
    }
  });
}

TEST(Transforming, NodesGrowAlongAxesAboutTheirPivots) {
  rc::check([] {
    Scene scene = turningScene({.center = {0.2, 0.9, 0.0}, .halfExtent = glm::dvec3(0.5), .radius = 0.4});
    const double time = uniform(0, 20);
    const SceneState before = evaluate(scene, time);
    const glm::dvec3 factors = glm::dvec3(1.5) + inBox(1.0);
    Scene after = scene;
    const auto grow = [&](auto& node, const Selection& selection) {
      const glm::dmat3 axes = scaleAxesOf(scene, before, selection).directions;
      const glm::dvec3 pivot = pivotOf(scene, before, selection);
      node = std::get<std::decay_t<decltype(node)>>(scaled(node, factors, axes, pivot, selection.copy));
    };
    const Selection object{Selection::Kind::object, 0, 2};
    grow(after.objects[0], object);
    for (int i : {0, 1}) {
      grow(after.mirrors[static_cast<size_t>(i)], {Selection::Kind::mirror, i});
    }
    const SceneState state = evaluate(after, time);
    RC_ASSERT(glm::distance(state.instances[2].center, before.instances[2].center) < 1e-8);
    for (int i = 0; i < 3; ++i) {
      RC_ASSERT(glm::distance(state.instances[2].worldFromMesh.linear[i],
                              factors[i] * before.instances[2].worldFromMesh.linear[i]) < 1e-7);
    }
    for (int i : {0, 1}) {
      const glm::dvec3 middle = pivotOf(scene, before, {Selection::Kind::mirror, i});
      for (int v = 0; v < 4; ++v) {
        const glm::dvec3 arm = before.mirrors[i].polygon[v] - middle;
        const glm::dvec3 x = before.mirrors[i].axisX;
        const glm::dvec3 y = before.mirrors[i].axisY;
        const glm::dvec3 expected = middle + factors.x * glm::dot(arm, x) * x + factors.y * glm::dot(arm, y) * y;
        RC_ASSERT(glm::distance(state.mirrors[i].polygon[v], expected) < 1e-7);
      }
    }
  });
}

// Expects that the outline in the image of mirror 0, 1 m wide at z = -3, ends at the mirror's sides. The eye stands at
// `distance` on the Z axis and looks at the origin.
void expectCutByMirror(const Scene& scene, const Selection& selection, const MeshOutline& shape, double distance) {
  const SceneState state = evaluate(scene, 0.0);
  const PictureView eye = lookingAt({0, 0, distance}, {0, 0, 0});
  const auto image = outlineOf(scene, state, selection, eye.through(scene, state, std::vector<int>{0}).value(), shape);
  ASSERT_FALSE(image.empty());
  const double halfWidth = 350.0 / std::tan(glm::radians(30.0)) * 0.5 / (distance + 3.0);
  for (const PixelLine& line : image) {
    EXPECT_LE(std::abs(line.a.x - 450.0), halfWidth + 1e-6);
  }
}

TEST(Outline, SurroundsAnObjectClosely) {
  Scene scene = emptyScene();
  Mesh mesh{.halfExtent = glm::dvec3(1.0), .radius = 1.0};
  for (int i = 0; i < 60; ++i) {
    for (int j = 0; j <= 60; ++j) {
      const double a = glm::radians(6.0 * i);
      const double b = glm::radians(3.0 * j);
      mesh.vertices.push_back({{std::sin(b) * std::cos(a), std::cos(b), std::sin(b) * std::sin(a)}, {}, {}});
    }
  }
  const MeshOutline points = meshOutline(mesh);
  EXPECT_LE(points.points.size(), 512u);
  EXPECT_TRUE(points.edges.empty()) << "no triangles: the hull";
  scene.meshes.push_back(mesh);
  scene.objects.push_back({.mesh = 0});
  scene.mirrors.push_back({.position = {0, 0, -3}, .size = {1.0, 8.0}});
  const SceneState state = evaluate(scene, 0.0);
  const Selection sphere{Selection::Kind::object, 0};
  const PictureView picture = lookingAt({0, 0, 5}, {0, 0, 0});
  const double radius = 350.0 / std::tan(glm::radians(30.0)) * std::tan(std::asin(0.2));
  const auto lines = outlineOf(scene, state, sphere, picture, points);
  EXPECT_GT(lines.size(), 20u);
  for (const PixelLine& line : lines) {
    EXPECT_NEAR(glm::distance(line.a, glm::dvec2(450.0, 350.0)), radius, 3.0);
  }
  // The image is wider than the mirror, so the mirror cuts it.
  expectCutByMirror(scene, sphere, points, 5.0);
  const auto inside = outlineOf(scene, state, sphere, lookingAt({0, 0, 0.5}, {0, 0, 0}), points);
  EXPECT_LE(inside.size(), 12u) << "the edges of its box";
}

// A ring about the Z axis, of radius 1 and thickness 0.25, with as many steps around as across.
Mesh ring(uint32_t steps) {
  Mesh mesh = sheetOf(steps, [&](uint32_t x, uint32_t y) {
    const double a = 2.0 * std::numbers::pi * (x % steps) / steps;  // both ends at the same place
    const double b = 2.0 * std::numbers::pi * (y % steps) / steps;
    const double r = 1.0 + 0.25 * std::cos(b);
    return glm::dvec3(r * std::cos(a), r * std::sin(a), 0.25 * std::sin(b));
  });
  mesh.halfExtent = {1.25, 1.25, 0.25};
  mesh.radius = 1.3;
  return mesh;
}

TEST(Outline, FollowsTheSilhouetteAlsoInside) {
  Scene scene = emptyScene();
  scene.meshes.push_back(ring(64));
  scene.objects.push_back({.mesh = 0, .scale = {2.0, 2.0, 0.5}});
  scene.mirrors.push_back({.position = {0, 0, -3}, .size = {1.0, 20.0}});
  const SceneState state = evaluate(scene, 0.0);
  const Selection object{Selection::Kind::object, 0};
  const MeshOutline shape = meshOutline(scene.meshes[0]);
  const auto lines = outlineOf(scene, state, object, lookingAt({0, 0, 50}, {0, 0, 0}), shape);
  const double perMetre = 350.0 / std::tan(glm::radians(30.0)) / 50.0;
  int inner = 0;
  int outer = 0;
  for (const PixelLine& line : lines) {
    const double r = glm::distance(line.a, glm::dvec2(450.0, 350.0)) / perMetre;
    inner += std::abs(r - 1.5) < 0.02;
    outer += std::abs(r - 2.5) < 0.02;
  }
  EXPECT_EQ(static_cast<size_t>(inner + outer), lines.size());
  EXPECT_GE(inner, 64);
  EXPECT_GE(outer, 64);
  expectCutByMirror(scene, object, shape, 50.0);
  EXPECT_TRUE(meshOutline(ring(200)).edges.empty()) << "80000 triangles";
}

TEST(Outline, BoxHasSixEdges) {
  Triangles sides;
  sides.box(glm::dvec3(-1.0), glm::dvec3(1.0));
  Mesh mesh{.halfExtent = glm::dvec3(1.0), .radius = std::sqrt(3.0), .indices = sides.indices};
  for (const glm::dvec3& p : sides.positions) {
    mesh.vertices.push_back({.position = p});
  }
  Scene scene = emptyScene();
  scene.meshes.push_back(mesh);
  scene.objects.push_back({.mesh = 0});
  const SceneState state = evaluate(scene, 0.0);
  const Selection box{Selection::Kind::object, 0};
  EXPECT_EQ(outlineOf(scene, state, box, lookingAt({4, 3, 5}, {0, 0, 0}), meshOutline(mesh)).size(), 6u);
  EXPECT_EQ(outlineOf(scene, state, box, lookingAt({0, 0, 5}, {0, 0, 0}), meshOutline(mesh)).size(), 4u);
}

}  // namespace
}  // namespace speculum
