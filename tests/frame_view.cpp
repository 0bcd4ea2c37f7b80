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
    scene.mirrors.push_back({.position = inBox(4.0),
                             .rotation = {uniform(-180, 180), uniform(-180, 180), 0},
                             .size = {uniform(0.1, 8), uniform(0.1, 8)},
                             .twoSided = true});
  }
  return scene;
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
