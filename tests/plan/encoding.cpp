// Which main views are drawn into the display image.
#include "plan/support.hpp"
#include "plan/target_memory.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

using namespace testing_support;

// A mirror, an object before it and a light.
Scene room() {
  Scene scene = sceneWith({wall({-1, 0, -5}, 0)});
  scene.meshes = {cube(0.2, 0.2)};
  scene.objects = {objectAt({0, 0, -3})};
  scene.lights = {{.position = {0, 2, 0}, .glow = 0.0}};
  return scene;
}

Settings oneSample() {
  Settings settings;
  settings.view.samples = 1;
  return settings;
}

FramePlan shownOnly(const Scene& scene, const Settings& settings, int picture = 0) {
  return planFrame({scene, evaluate(scene, 0.0), settings, {width, height}, {}, picture, true});
}

TEST(Encoding, NeedsOneSampleAndNoOtherReader) {
  const Scene scene = room();
  ASSERT_TRUE(shownOnly(scene, oneSample()).encodes);
  EXPECT_FALSE(planFrame({scene, evaluate(scene, 0.0), oneSample(), {width, height}}).encodes) << "radiance is read";
  const auto with = [&](auto change, const Scene& changed) {
    Settings settings = oneSample();
    change(settings);
    return shownOnly(changed, settings).encodes;
  };
  EXPECT_FALSE(with([](Settings& s) { s.view.samples = 2; }, scene));
  EXPECT_FALSE(with([](Settings& s) { s.view.scale = 0.5; }, scene));
  EXPECT_FALSE(with([](Settings& s) { s.view.accumulate = 2; }, scene)) << "the mean adds radiance";
  EXPECT_FALSE(with([](Settings& s) { s.debug.checkFinite = true; }, scene)) << "the check reads it";
  EXPECT_FALSE(with([](Settings& s) { s.debug.encodeEarly = false; }, scene));
  EXPECT_TRUE(with([](Settings& s) { s.reflection.samples = 4; }, scene)) << "mirror images have their own samples";
  EXPECT_TRUE(with([](Settings& s) { s.reflection.scale = 0.5; }, scene));

  Scene shadowed = scene;
  shadowed.lights[0].castsShadow = true;
  const auto lookup = [](ShadowLookup to) { return [to](Settings& s) { s.effects.shadowLookup = to; }; };
  EXPECT_FALSE(with(lookup(ShadowLookup::traced), shadowed)) << "surfaces are shaded after the pass";
  EXPECT_FALSE(with(lookup(ShadowLookup::hybrid), shadowed));
  EXPECT_TRUE(with(lookup(ShadowLookup::map), shadowed));

  Scene nothing = sceneWith({});
  EXPECT_FALSE(shownOnly(nothing, oneSample()).encodes) << "the display is cleared";
  nothing.environment.sky.emplace();
  EXPECT_TRUE(shownOnly(nothing, oneSample()).encodes);
  EXPECT_FALSE(with([](Settings& s) { s.view.clearColor = {0.5, 0.5, 0.5}; }, nothing)) << "it replaces the sky";
}

// A picture that stays is drawn once more with its radiance, which is then shown again.
TEST(Encoding, StillPicturesAreReusedAfterTwoDrawings) {
  PlanSequence frames(room());
  frames.settings = oneSample();
  frames.shownOnly = true;
  for (int frame = 0; frame < 4; ++frame) {
    frames.moveCamera({0.01, 0, 0});
    EXPECT_TRUE(frames.next().encodes) << frame;
  }
  EXPECT_TRUE(frames.next().encodes) << "it shows new images of mirrors";
  EXPECT_FALSE(frames.next().encodes);
  EXPECT_FALSE(frames.plan.mainReused());
  for (int frame = 0; frame < 3; ++frame) {
    EXPECT_TRUE(frames.next().mainReused()) << frame;
    EXPECT_FALSE(frames.plan.encodes);
  }
  frames.moveCamera({0.01, 0, 0});
  EXPECT_TRUE(frames.next().encodes);
}

TEST(Encoding, TakesNoTargetOfRadiance) {
  const uint64_t saved =
      targetBytes(planOf(room(), oneSample()), oneSample()) - targetBytes(shownOnly(room(), oneSample()), oneSample());
  EXPECT_EQ(saved, uint64_t{width} * height * colorBytes);
}

}  // namespace
}  // namespace speculum
