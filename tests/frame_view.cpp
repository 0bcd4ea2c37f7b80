#include "frame/view.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "frame/frame_plan.hpp"

namespace speculum {
namespace {

double uniform(double low, double high) {
  return low + (high - low) * *rc::gen::inRange(0, 1 << 20) / (1 << 20);
}

glm::dvec3 inBox(double side) {
  const double x = uniform(-side, side);
  const double y = uniform(-side, side);
  return {x, y, uniform(-side, side)};
}

// A scene of two mirrors and a camera anywhere, also with mirrors across the eye's plane.
Scene randomScene() {
  Scene scene;
  scene.camera.position = inBox(3.0);
  scene.camera.target = scene.camera.position + inBox(1.0) + glm::dvec3(0.01, 0.02, 1.5);
  for (int i = 0; i < 2; ++i) {
    Mirror mirror;
    mirror.position = inBox(4.0);
    mirror.rotation = {uniform(-180, 180), uniform(-180, 180), 0};
    mirror.size = {uniform(0.1, 8), uniform(0.1, 8)};
    mirror.twoSided = true;
    scene.mirrors.push_back(mirror);
  }
  return scene;
}

bool insidePolygon(const std::vector<glm::dvec3>& polygon, const glm::dvec3& normal, const glm::dvec3& p) {
  for (size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3 edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    if (glm::dot(glm::cross(edge, p - polygon[i]), normal) < 0.0) {
      return false;
    }
  }
  return true;
}

// Where the ray through a pixel's centre hits the mirror first seen, or -1.
int hitMirror(const SceneState& state, const FramePlan& plan, double px, double py, glm::dvec3& hit) {
  const Projection& f = plan.projection;
  const glm::dvec3 view((2.0 * px / plan.width - 1.0) * f.aspect / f.focal, (1.0 - 2.0 * py / plan.height) / f.focal,
                        -1.0);
  const glm::dvec3 ray = glm::transpose(state.camera.worldToView) * view;
  int best = -1;
  double nearest = 1e300;
  for (size_t i = 0; i < state.mirrors.size(); ++i) {
    const MirrorState& m = state.mirrors[i];
    const double t = glm::dot(m.normal, m.origin - state.camera.eye) / glm::dot(m.normal, ray);
    const glm::dvec3 p = state.camera.eye + t * ray;
    if (t > 0.0 && t < nearest && insidePolygon(m.polygon, m.normal, p)) {
      nearest = t;
      best = static_cast<int>(i);
      hit = p;
    }
  }
  return best;
}

TEST(View, RectangleHoldsEveryPixelOfTheMirror) {
  EXPECT_TRUE(rc::check("rectangle is conservative", [] {
    const Scene scene = randomScene();
    const SceneState state = evaluate(scene, 0.0);
    Settings settings;
    settings.reflection.maxDepth = 1;
    settings.reflection.minPixels = 0.0;
    const FramePlan plan = planFrame(scene, state, settings, 64, 36);
    for (int y = 0; y < plan.height; ++y) {
      for (int x = 0; x < plan.width; ++x) {
        glm::dvec3 hit;
        const int mirror = hitMirror(state, plan, x + 0.5, y + 0.5, hit);
        if (mirror < 0) {
          continue;
        }
        const auto pass = std::find_if(plan.passes.begin(), plan.passes.end(),
                                       [&](const PlannedPass& p) { return p.view.path == std::vector<int>{mirror}; });
        RC_ASSERT(pass != plan.passes.end());
        RC_ASSERT(pass->view.rect.contains(x, y));
      }
    }
  }));
}

TEST(View, MirrorPointsProjectAlikeInBothViews) {
  EXPECT_TRUE(rc::check("same pixel in both views", [] {
    const Scene scene = randomScene();
    const SceneState state = evaluate(scene, 0.0);
    const FramePlan plan = planFrame(scene, state, {}, 640, 360);
    for (const PlannedPass& pass : plan.passes) {
      if (pass.depth != 0) {
        continue;
      }
      for (const glm::dvec3& p : visiblePart(plan.main.view, state.mirrors[pass.view.path[0]].polygon)) {
        const std::vector<glm::dvec3> point = {p};
        const glm::dvec4 seen = toClip(plan.main.view, plan.projection, point)[0];
        const glm::dvec4 mirrored = toClip(pass.view, plan.projection, point)[0];
        RC_ASSERT(glm::length(seen - mirrored) <= 1e-12);
      }
    }
  }));
}

TEST(View, ReflectionOfTwoMirrorsIsTheirProduct) {
  EXPECT_TRUE(rc::check("eye and handedness", [] {
    const Scene scene = randomScene();
    const SceneState state = evaluate(scene, 0.0);
    for (const PlannedPass& pass : planFrame(scene, state, {}, 64, 36).passes) {
      RC_ASSERT((glm::determinant(pass.view.worldToView) < 0.0) == pass.view.mirrored());
      // The reflected eye is behind the last mirror, whose front is kept.
      RC_ASSERT(pass.view.clip->distance(pass.view.eye) < 0.0);
    }
  }));
}

}  // namespace
}  // namespace speculum
