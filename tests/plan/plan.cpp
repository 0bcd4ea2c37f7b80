#include "plan/frame_plan.hpp"

#include <glm/gtx/component_wise.hpp>

#include "plan/mirror_sight.hpp"
#include "plan/support.hpp"
#include "support/random.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

using namespace testing_support;

TEST(Rays, SayWhyTheyShowAMirror) {
  Settings settings;
  Mirror mirror;
  const auto why = [&](bool reflects, double samples) {
    return whyRays(mirror.quality, opticsOf(mirror, settings.effects), settings, reflects, samples);
  };
  EXPECT_EQ(why(true, 10.0), "");
  settings.reflection.method = ReflectionMethod::automatic;
  EXPECT_EQ(why(true, 10.0), "faster, since it covers few pixels");
  EXPECT_EQ(why(true, 1e6), "");
  settings.reflection.method = ReflectionMethod::rays;
  EXPECT_EQ(why(true, 1e6), "reflection.method");
  EXPECT_EQ(why(false, 1e6), "") << "it shows the background";
  mirror.roughness = 0.3;
  EXPECT_EQ(why(true, 1e6), "rough");
  mirror.ripple.emplace();
  EXPECT_EQ(why(false, 1e6), "ripples");
}

void expectSkipped(const FramePlan& plan, int mirror, SkipReason reason) {
  const SkippedMirror* skip = skipOf(plan, {mirror});
  ASSERT_NE(skip, nullptr);
  EXPECT_EQ(skipReasonName(skip->reason), skipReasonName(reason));
}

TEST(FramePlan, FacingMirrorNeedsOnePass) {
  const FramePlan p = planOf(sceneWith({wall({0, 0, -5}, 0)}));
  ASSERT_EQ(p.drawnMirrors().size(), 1u);
  const Pass& pass = p.drawnMirrors()[0];
  EXPECT_EQ(pass.view.path, MirrorPath{0});
  // 2 m at 5 m: 2/5 / (2 tan 30) of the height.
  const double side = 0.4 / (2.0 * std::tan(glm::radians(30.0))) * height;
  EXPECT_NEAR(pass.areaPx, side * side, 1e-6);
  EXPECT_EQ(pass.view.rect.width, static_cast<int>(2 * std::ceil(side / 2)) + 2);
  EXPECT_NEAR(glm::length(pass.view.eye - glm::dvec3(0, 0, -10)), 0.0, 1e-12);
  ASSERT_EQ(p.main().mirrors.size(), 1u);
  EXPECT_EQ(p.main().mirrors[0].pass, 0);
  EXPECT_TRUE(p.skipped.empty());
}

TEST(FramePlan, ReasonsAtTheFirstLevel) {
  expectSkipped(planOf(sceneWith({wall({0, 0, 5}, 180)})), 0, SkipReason::behind);
  expectSkipped(planOf(sceneWith({wall({0, 0, -5}, 180)})), 0, SkipReason::backface);
  expectSkipped(planOf(sceneWith({wall({0, 0, -5}, 90, {20, 20})})), 0, SkipReason::backface);
  expectSkipped(planOf(sceneWith({wall({50, 0, -5}, 0)})), 0, SkipReason::outside);
  expectSkipped(planOf(sceneWith({wall({0, 0, -5}, 0, {1e-4, 1e-4})})), 0, SkipReason::minPixels);

  Settings settings;
  settings.reflection.maxDepth = 0;
  expectSkipped(planOf(sceneWith({wall({0, 0, -5}, 0)}), settings), 0, SkipReason::maxDepth);

  Scene dark = sceneWith({wall({0, 0, -5}, 0)});
  dark.mirrors[0].reflectance = glm::dvec3(1e-5);
  expectSkipped(planOf(dark), 0, SkipReason::minThroughput);
}

TEST(FramePlan, BackIsDrawnUnlessTwoSided) {
  Scene scene = sceneWith({wall({0, 0, -5}, 180)});
  FramePlan p = planOf(scene);
  ASSERT_EQ(p.main().mirrors.size(), 1u);
  EXPECT_TRUE(p.main().mirrors[0].back);
  EXPECT_TRUE(p.drawnMirrors().empty());

  scene.mirrors[0].twoSided = true;
  p = planOf(scene);
  ASSERT_EQ(p.drawnMirrors().size(), 1u);
  EXPECT_FALSE(p.main().mirrors[0].back);
  EXPECT_GT(p.main().mirrors[0].plane.normal.z, 0.99);
}

TEST(FramePlan, BudgetGoesToTheBestFirst) {
  Scene scene = sceneWith({wall({-2, 0, -5}, 0, {0.5, 0.5}), wall({2, 0, -5}, 0, {2, 2}), wall({0, 0, -5}, 0)});
  scene.mirrors[2].reflectance = glm::dvec3(0.01);
  Settings settings;
  settings.reflection.maxPasses = 1;
  const FramePlan p = planOf(scene, settings);
  ASSERT_EQ(p.drawnMirrors().size(), 1u);
  EXPECT_EQ(p.drawnMirrors()[0].view.path, MirrorPath{1});
  expectSkipped(p, 0, SkipReason::maxPasses);
  expectSkipped(p, 2, SkipReason::maxPasses);
}

TEST(FramePlan, RaysTakeThePlaceOfPasses) {
  Settings settings;
  settings.reflection.method = ReflectionMethod::rays;
  const Scene scene = sceneWith({wall({0, 0, -5}, 0)});
  const FramePlan p = planOf(scene, settings);
  EXPECT_TRUE(p.drawnMirrors().empty());
  EXPECT_TRUE(p.main().mirrors.at(0).byRays);
  EXPECT_TRUE(p.effects.traces());
  expectSkipped(p, 0, SkipReason::rays);
  settings.reflection.method = ReflectionMethod::automatic;
  EXPECT_EQ(planOf(scene, settings).drawnMirrors().size(), 1u);
  const Scene far = sceneWith({wall({0, 0, -200}, 0)});
  EXPECT_TRUE(planOf(far, settings).drawnMirrors().empty());
  EXPECT_TRUE(planOf(far, settings).effects.traces());
  expectSkipped(planOf(far, settings), 0, SkipReason::rays);
  settings.reflection.method = ReflectionMethod::rays;
  settings.reflection.maxDepth = 0;
  EXPECT_FALSE(planOf(scene, settings).effects.traces());
  EXPECT_FALSE(planOf(scene).effects.traces());
}

TEST(FramePlan, FacingMirrorsRecurseDeepestFirst) {
  Settings settings;
  settings.reflection.maxDepth = 6;
  const FramePlan p = planOf(corridor(), settings);
  ASSERT_EQ(p.drawnMirrors().size(), 6u);
  for (size_t i = 0; i < p.drawnMirrors().size(); ++i) {
    const MirrorPath& path = p.drawnMirrors()[i].view.path;
    EXPECT_EQ(depthOf(path), 5 - static_cast<int>(i));
    EXPECT_EQ(p.passes[i + 1].mirrors[0].pass, static_cast<int>(i)) << "shown in the next one";
    EXPECT_EQ(p.drawnMirrors()[i].view.mirrored(), depthOf(path) % 2 == 0);
    if (i > 0) {
      EXPECT_LT(p.drawnMirrors()[i - 1].areaPx, p.drawnMirrors()[i].areaPx);
    }
  }
  const auto cut = std::ranges::find(p.skipped, SkipReason::maxDepth, &SkippedMirror::reason);
  ASSERT_NE(cut, p.skipped.end());
  EXPECT_EQ(cut->path.size(), 7u);
}

TEST(FramePlan, ThroughputIsTheProductOfReflectances) {
  Scene scene = corridor();
  scene.mirrors[0].reflectance = {0.5, 0.1, 0.1};
  scene.mirrors[1].reflectance = {0.1, 0.4, 0.1};
  const FramePlan p = planOf(scene);
  const auto second = std::ranges::find(p.drawnMirrors(), 1, [](const Pass& pass) { return depthOf(pass.view.path); });
  ASSERT_NE(second, p.drawnMirrors().end());
  EXPECT_NEAR(glm::compMax(second->channels), 0.05, 1e-15);
}

TEST(FramePlan, SchlickBoundUsesTheFarthestPoint) {
  Scene scene = sceneWith({wall({0, 0, -5}, 0, {2, 2})});
  scene.mirrors[0].reflectance = glm::dvec3(0.04);
  scene.mirrors[0].fresnel = Fresnel::schlick;
  const FramePlan p = planOf(scene);
  ASSERT_EQ(p.drawnMirrors().size(), 1u);
  const double cosine = 5.0 / std::sqrt(27.0);
  EXPECT_NEAR(glm::compMax(p.drawnMirrors()[0].channels), 0.04 + 0.96 * std::pow(1.0 - cosine, 5.0), 1e-12);
}

TEST(FramePlan, CoplanarNeighboursDoNotReflectEachOther) {
  const FramePlan p = planOf(sceneWith({wall({-1.5, 0, -5}, 0), wall({1.5, 0, -5}, 0)}));
  EXPECT_EQ(p.drawnMirrors().size(), 2u);
  for (const Pass& pass : p.drawnMirrors()) {
    EXPECT_TRUE(pass.mirrors.empty());
  }
}

TEST(FramePlan, TexelsFollowBothScales) {
  Random random(3);
  const Scene scene = corridor();
  const SceneState state = evaluate(scene, 0.0);
  for (int round = 0; round < 100; ++round) {
    const glm::ivec2 size(static_cast<int>(random.uniform(1, 2000)), static_cast<int>(random.uniform(1, 2000)));
    const FramePlan whole = planFrame({scene, state, {}, {size.x, size.y}});
    Settings settings;
    settings.view.scale = random.uniform(0.125, 1.0);
    settings.reflection.scale = random.uniform(0.125, 4.0);
    const FramePlan p = planFrame({scene, state, settings, {size.x, size.y}});
    EXPECT_EQ(p.width, size.x);
    const glm::dvec2 texels = glm::dvec2(size) * settings.view.scale;
    const glm::dvec2 drawn = p.main().view.pictureSize;
    EXPECT_EQ(p.main().view.rect, (PixelRect{0, 0, static_cast<int>(drawn.x), static_cast<int>(drawn.y)}));
    EXPECT_EQ(drawn, glm::max(glm::round(texels), 1.0));
    EXPECT_EQ(p.main().areaPx, drawn.x * drawn.y);
    // The scale changes resolutions, but neither the mirrors with passes nor the reasons of the others nor picking.
    ASSERT_EQ(p.drawnMirrors().size(), whole.drawnMirrors().size());
    EXPECT_EQ(p.skipped.size(), whole.skipped.size());
    for (size_t i = 0; i < p.drawnMirrors().size(); ++i) {
      const View& view = p.drawnMirrors()[i].view;
      EXPECT_EQ(view.path, whole.drawnMirrors()[i].view.path);
      EXPECT_EQ(view.pictureSize, settings.reflection.scale * drawn);
      EXPECT_NEAR(p.drawnMirrors()[i].areaPx * size.x * size.y,
                  whole.drawnMirrors()[i].areaPx * view.pictureSize.x * view.pictureSize.y,
                  1e-6 * p.drawnMirrors()[i].areaPx * size.x * size.y);
      EXPECT_GE(std::min(view.rect.width, view.rect.height), 1);
    }
  }
}

TEST(FramePlan, MinPixelsCountsPixelsOfThePicture) {
  const Scene scene = sceneWith({wall({0, 0, -5}, 0, {0.1, 0.1})});
  Settings settings;
  const double pixels = planOf(scene).drawnMirrors()[0].areaPx;
  for (const double scale : {1.0, 0.5, 0.125}) {
    settings.view.scale = scale;
    settings.reflection.minPixels = 0.99 * pixels;
    EXPECT_EQ(planOf(scene, settings).drawnMirrors().size(), 1u) << scale;
    settings.reflection.minPixels = 1.01 * pixels;
    EXPECT_EQ(planOf(scene, settings).drawnMirrors().size(), 0u) << scale;
  }
}

}  // namespace
}  // namespace speculum
