#include "plan/fitted_plan.hpp"
#include "plan/support.hpp"
#include "plan/target_memory.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

// The camera looks straight at a mirror that fills the view.
Scene wallScene() {
  return testing_support::sceneWith({testing_support::wall({0, 0, -1}, 0, {20, 20})});
}

FittedPlan fit(uint64_t budget) {
  const Scene scene = wallScene();
  return planWithin({.budgetBytes = budget, .largestSide = 4096}, {scene, evaluate(scene, 0.0), {}, {1000, 1000}});
}

TEST(MemoryFit, CountsMainViewImagesAndDepth) {
  const FittedPlan fitted = fit(1ull << 40);
  // Per pixel: main 8 resolved + 4 * (8 + 4); mirror image 4 * 8 + 4 * 4.
  EXPECT_EQ(targetBytes(fitted.plan, fitted.settings), 1000000ull * (8 + 48 + 48));
  EXPECT_TRUE(fitted.message.empty());
  EXPECT_EQ(fitted.settings.reflection.samples, 4);
}

TEST(MemoryFit, LowersMirrorSamplesViewSamplesScale) {
  EXPECT_EQ(fit(90'000'000).settings.reflection.samples, 2);
  EXPECT_EQ(fit(90'000'000).settings.view.samples, 4);
  const FittedPlan less = fit(50'000'000);
  EXPECT_EQ(less.settings.reflection.samples, 1);
  EXPECT_EQ(less.settings.view.samples, 2);
  EXPECT_EQ(less.settings.reflection.scale, 1.0);
  EXPECT_LE(targetBytes(less.plan, less.settings), 50'000'000u);
  EXPECT_TRUE(contains(less.message, "lowered reflection.samples to 2, reflection.samples to 1, view.samples to 2"));
  EXPECT_LT(fit(16'000'000).settings.reflection.scale, 1.0);
}

TEST(MemoryFit, CountsThePictureThatStaysShown) {
  const Scene scene = wallScene();
  Settings settings;
  settings.view.accumulate = 64;
  const auto scale = [&](bool keepsPicture) {
    const TargetLimits limits{.budgetBytes = 105'000'000, .largestSide = 4096, .keepsPicture = keepsPicture};
    return planWithin(limits, {scene, evaluate(scene, 0.0), settings, {1000, 1000}}).settings.reflection.scale;
  };
  // Per pixel: main 8 + 4, sums 32; mirror image 8 + 4; what stays 8 + 4 * (8 + 4).
  EXPECT_EQ(scale(false), 1.0);
  EXPECT_EQ(scale(true), 0.5);
}

TEST(MemoryFit, KeptPictureHasTheSamplesThatFitted) {
  const Scene scene = wallScene();
  Settings settings;
  settings.view.samples = 8;
  settings.view.accumulate = 64;
  const TargetLimits limits{.budgetBytes = 103'000'000, .largestSide = 4096, .keepsPicture = true};
  const FittedPlan fitted = planWithin(limits, {scene, evaluate(scene, 0.0), settings, {1000, 1000}});
  // Per pixel: with 8 samples 8 + 8 * (8 + 4), which never fitted; what stays has 4, 8 + 4 * (8 + 4).
  EXPECT_EQ(fitted.settings.reflection.scale, 0.5);
}

TEST(MemoryFit, MirrorImagesStayWithinTheLargestSide) {
  const Scene scene = wallScene();
  Settings settings;
  settings.reflection.scale = 4.0;
  const FittedPlan fitted = planWithin({.budgetBytes = 1ull << 40, .largestSide = 2500},
                                       {scene, evaluate(scene, 0.0), settings, {1000, 500}});
  EXPECT_EQ(fitted.settings.reflection.scale, 2.5);
  EXPECT_EQ(fitted.plan.drawnMirrors()[0].view.pictureSize.x, 2500.0);
  EXPECT_TRUE(contains(fitted.message, "lowered reflection.scale to 2.5"));
}

// Without rays, a rippled mirror looks its image up and has a pass.
TEST(MemoryFit, MapsAndImagesReplaceRays) {
  Scene scene = wallScene();
  scene.mirrors[0].ripple = Ripple{.amplitude = 0.01};
  scene.meshes = {testing_support::cube(0.5, 0.9)};
  scene.objects = {testing_support::objectAt({0, 0, -0.5})};
  scene.lights.assign(mostShadowMaps, {.name = "lamp", .position = {0, 2, 0}, .castsShadow = true});
  Settings settings;
  settings.effects.shadowLookup = ShadowLookup::traced;
  const auto plan = [&](bool tracesRays) {
    return planWithin({.budgetBytes = 1ull << 40, .largestSide = 4096, .whyNoRays = tracesRays ? "" : "no room"},
                      {scene, evaluate(scene, 0.0), settings, {100, 100}});
  };
  EXPECT_TRUE(plan(true).message.empty());
  EXPECT_TRUE(plan(true).plan.drawnMirrors().empty());
  const FittedPlan without = plan(false);
  EXPECT_TRUE(contains(without.message, "effects.* show images and maps instead of rays"));
  EXPECT_TRUE(contains(without.message, ": no room"));
  EXPECT_EQ(without.plan.drawnMirrors().size(), 1u);
  EXPECT_FALSE(without.plan.effects.any());
  EXPECT_TRUE(without.plan.effects.ripple);
  EXPECT_EQ(without.plan.effects.shadows, "light 'lamp'; without rays: map");
  scene.lights.push_back(scene.lights[0]);
  EXPECT_FALSE(plan(false).plan.effects.shadows) << "more lights than maps";
}

TEST(MemoryFit, RaysReplacePassesWhereTheyPay) {
  const Scene scene = wallScene();
  Settings settings;
  settings.reflection.samples = settings.view.samples = 1;
  const auto passes = [&](ReflectionMethod method, TargetLimits limits, int height = 20) {
    settings.reflection.method = method;
    limits.budgetBytes = 1ull << 40;
    limits.largestSide = 4096;
    return planWithin(limits, {scene, evaluate(scene, 0.0), settings, {2 * height, height}}).plan.drawnMirrors().size();
  };
  EXPECT_EQ(passes(ReflectionMethod::rays, {}), 0u);
  EXPECT_EQ(passes(ReflectionMethod::rays, {.whyNoRays = "no room"}), 1u);
  EXPECT_EQ(passes(ReflectionMethod::automatic, {}), 1u);
  EXPECT_EQ(passes(ReflectionMethod::automatic, {.cpu = true}), 0u);
  EXPECT_EQ(passes(ReflectionMethod::raster, {.cpu = true}), 1u);
  EXPECT_EQ(passes(ReflectionMethod::automatic, {}, 2000), 0u) << "a GPU, and a mirror that covers much";
  EXPECT_EQ(passes(ReflectionMethod::automatic, {.whyNoRays = "no room"}, 2000), 1u);
  settings.view.samples = 4;
  EXPECT_EQ(passes(ReflectionMethod::automatic, {}, 2000), 1u);
}

TEST(MemoryFit, PlansUnchangedWithNothingLeftToLower) {
  const FittedPlan least = fit(1);
  EXPECT_EQ(least.settings.reflection.scale, 0.125);
  EXPECT_EQ(least.plan.drawnMirrors().size(), 1u);
}

}  // namespace
}  // namespace speculum
