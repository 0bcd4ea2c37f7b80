// Mirrors with a quality of their own: what each pass has, and how lowered settings lower it.
#include "plan/fitted_plan.hpp"
#include "plan/image_reuse.hpp"
#include "plan/refined_tiles.hpp"
#include "plan/support.hpp"
#include "plan/target_memory.hpp"
#include "support/random.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

using namespace testing_support;

// A room of mirrors that show each other.
Scene mirrorRoom() {
  Scene scene = corridor();
  scene.mirrors.push_back(wall({-3, 0, 0}, 90, {8, 3}));
  scene.mirrors.push_back(wall({3, 0, 0}, -90, {8, 3}));
  return scene;
}

template <typename T>
std::optional<T> sometimes(Random& random, std::initializer_list<T> values) {
  const std::vector<T> all = values;
  return random.chance(0.5) ? std::optional(all[random.index(all.size())]) : std::nullopt;
}

MirrorQuality anyQuality(Random& random) {
  return {.scale = sometimes(random, {0.125, 0.25, 0.7, 1.0, 2.0, 4.0}),
          .samples = sometimes(random, {1, 2, 4, 8}),
          .updateInterval = sometimes(random, {1, 2, 5}),
          .method = sometimes(random, {ReflectionMethod::raster, ReflectionMethod::rays})};
}

Settings anySettings(Random& random) {
  Settings settings;
  settings.reflection.scale = sometimes(random, {0.25, 0.5, 2.0}).value_or(1.0);
  settings.reflection.samples = sometimes(random, {1, 2, 8}).value_or(4);
  settings.reflection.updateInterval = sometimes(random, {2, 3}).value_or(1);
  settings.reflection.method = sometimes(random, {ReflectionMethod::rays}).value_or(ReflectionMethod::raster);
  settings.view.samples = sometimes(random, {1, 2}).value_or(4);
  return settings;
}

const Pass& viewOf(const FramePlan& plan, std::span<const int> path) {
  const Pass* pass = path.empty() ? &plan.main() : mirrorPass(plan, path);
  return *pass;
}

TEST(MirrorQuality, EachPassHasWhatItsMirrorAsksFor) {
  Random random(5);
  int passes = 0;
  int traced = 0;
  for (int round = 0; round < 60; ++round) {
    Scene scene = mirrorRoom();
    for (Mirror& mirror : scene.mirrors) {
      mirror.quality = anyQuality(random);
    }
    const Settings settings = anySettings(random);
    const ReflectionSettings& usual = settings.reflection;
    const FramePlan plan = planOf(scene, settings);
    for (const Pass& pass : plan.drawnMirrors()) {
      const MirrorQuality& own = scene.mirrors[pass.view.path.back()].quality;
      const MirrorQuality& first = scene.mirrors[pass.view.path.front()].quality;
      const Pass& seenIn = viewOf(plan, std::span(pass.view.path).first(pass.view.path.size() - 1));
      double scale = own.scale.value_or(usual.scale);
      int samples = own.samples.value_or(usual.samples);
      if (depthOf(pass.view.path) > 0) {
        scale = std::min(scale, seenIn.quality.scale);
        samples = std::min(samples, seenIn.quality.samples);
      }
      EXPECT_EQ(pass.view.pictureSize, scale * plan.main().view.pictureSize);
      EXPECT_EQ(pass.quality.samples, samples);
      EXPECT_EQ(pass.quality.interval, first.updateInterval.value_or(usual.updateInterval));
      EXPECT_EQ(pass.shownIn.samples, seenIn.quality.samples);
      EXPECT_EQ(own.method.value_or(usual.method), ReflectionMethod::raster);
      ++passes;
    }
    for (const MirrorDraw& draw : plan.main().mirrors) {
      const bool rays = scene.mirrors[draw.mirror].quality.method.value_or(usual.method) == ReflectionMethod::rays;
      EXPECT_EQ(draw.byRays, rays && !draw.back);
      EXPECT_TRUE(plan.effects.mirrorRays || !draw.byRays);
      traced += draw.byRays;
    }
  }
  EXPECT_GT(passes, 100);
  EXPECT_GT(traced, 20);
}

// The same plan whether settings or all mirrors ask for a quality, but for what is looked up beside images' edges.
TEST(MirrorQuality, EqualToTheSettingsChangesNothing) {
  Random random(6);
  for (int round = 0; round < 30; ++round) {
    Scene scene = mirrorRoom();
    Settings settings = anySettings(random);
    const FramePlan without = planOf(scene, settings);
    const ReflectionSettings asked = settings.reflection;
    for (Mirror& mirror : scene.mirrors) {
      mirror.quality = {asked.scale, asked.samples, asked.updateInterval, asked.method};
    }
    settings.reflection.scale = 1.0;
    settings.reflection.samples = 2;
    settings.reflection.updateInterval = 1;
    settings.reflection.method = ReflectionMethod::raster;
    const FramePlan with = planOf(scene, settings);
    ASSERT_EQ(with.drawnMirrors().size(), without.drawnMirrors().size());
    for (size_t i = 0; i < with.drawnMirrors().size(); ++i) {
      EXPECT_EQ(with.drawnMirrors()[i].view.path, without.drawnMirrors()[i].view.path);
      EXPECT_EQ(with.drawnMirrors()[i].view.rect, without.drawnMirrors()[i].view.rect);
      EXPECT_EQ(with.drawnMirrors()[i].view.cone, without.drawnMirrors()[i].view.cone);
      EXPECT_EQ(with.drawnMirrors()[i].quality.samples, without.drawnMirrors()[i].quality.samples);
      EXPECT_EQ(with.drawnMirrors()[i].areaPx, without.drawnMirrors()[i].areaPx);
    }
    EXPECT_EQ(targetBytes(with, settings), targetBytes(without, settings));
  }
}

TEST(MirrorQuality, IntervalsDifferFromMirrorToMirror) {
  PlanSequence frames(sceneWith({wall({-1.2, 0, -5}, 0), wall({1.2, 0, -5}, 0)}), 1, false);
  frames.scene.mirrors[1].quality.updateInterval = 3;
  std::vector<int> rendered(2, 0);
  for (int frame = 0; frame < 13; ++frame) {
    frames.next();
    for (const int mirror : frames.rendered()) {
      rendered[static_cast<size_t>(mirror)] += frame > 0;
    }
  }
  EXPECT_EQ(rendered[0], 12);
  EXPECT_EQ(rendered[1], 4);
}

TEST(MirrorQuality, ChangedSamplesRenderTheImageAgain) {
  for (const int interval : {1, 4}) {
    PlanSequence frames(sceneWith({wall({-1.2, 0, -5}, 0), wall({1.2, 0, -5}, 0)}), interval);
    frames.next();
    frames.next();
    EXPECT_TRUE(frames.rendered().empty());
    frames.scene.mirrors[1].quality.samples = 1;
    frames.next();
    EXPECT_EQ(frames.rendered(), std::set<int>{1}) << interval;
    frames.settings.limit.samples = 1;
    frames.settings.reflection.samples = 1;
    frames.next();
    EXPECT_TRUE(frames.rendered().contains(0)) << interval;
  }
}

TEST(MirrorQuality, MeansHaveNeitherSamplesNorIntervals) {
  Settings settings;
  settings.view.accumulate = 16;
  const MirrorQuality own{.scale = 2.0, .samples = 8, .updateInterval = 9};
  const ReflectionSettings drawn = reflectionOf(own, pictureSettings(settings));
  EXPECT_EQ(drawn.samples, 1);
  EXPECT_EQ(drawn.updateInterval, 1);
  EXPECT_EQ(drawn.scale, 2.0);
}

TEST(MirrorQuality, LoweredSettingsLowerItButNeverRaiseIt) {
  Random random(7);
  for (int round = 0; round < 200; ++round) {
    const MirrorQuality own = anyQuality(random);
    const Settings before = anySettings(random);
    Settings after = before;
    after.reflection.scale = std::min(after.reflection.scale, random.uniform(0.125, 4.0));
    after.reflection.samples = std::min(after.reflection.samples, 1 << static_cast<int>(random.uniform(0, 3.99)));
    after.reflection.updateInterval += static_cast<int>(random.uniform(0, 3));
    after.reflection.method = random.chance(0.5) ? ReflectionMethod::raster : after.reflection.method;
    lowerLimit(before.reflection, after);
    const ReflectionSettings asked = reflectionOf(own, before);
    const ReflectionSettings drawn = reflectionOf(own, after);
    EXPECT_LE(drawn.scale, asked.scale);
    EXPECT_LE(drawn.samples, asked.samples);
    EXPECT_GE(drawn.updateInterval, asked.updateInterval);
    const auto lowered = [&](auto member) { return after.reflection.*member != before.reflection.*member; };
    if (lowered(&ReflectionSettings::scale)) {
      EXPECT_LE(drawn.scale, after.reflection.scale);
    }
    if (lowered(&ReflectionSettings::samples)) {
      EXPECT_LE(drawn.samples, after.reflection.samples);
    }
    if (lowered(&ReflectionSettings::updateInterval)) {
      EXPECT_GE(drawn.updateInterval, after.reflection.updateInterval);
    }
    if (lowered(&ReflectionSettings::method)) {
      EXPECT_EQ(drawn.method, ReflectionMethod::raster);
    }
    if (after == before) {
      EXPECT_EQ(drawn, asked);
    }
  }
}

FittedPlan fit(const Scene& scene, const TargetLimits& limits, const Settings& settings = {}) {
  return planWithin(limits, {scene, evaluate(scene, 0.0), settings, {1000, 1000}});
}

TEST(MirrorQuality, MemoryThatIsMissingLowersIt) {
  Scene scene = sceneWith({wall({0, 0, -1}, 0, {20, 20})});
  scene.mirrors[0].quality = {.scale = 2.0, .samples = 8};
  Settings settings;
  settings.reflection.samples = 1;
  settings.reflection.scale = 0.5;
  const FittedPlan whole = fit(scene, {.budgetBytes = 1ull << 40, .largestSide = 4096}, settings);
  // Per pixel: main 8 resolved + 4 * (8 + 4); four texels of the image with 8 * (8 + 4).
  EXPECT_EQ(targetBytes(whole.plan, whole.settings), 1'000'000ull * (8 + 48 + 4 * 96));
  EXPECT_EQ(sampleBytes(whole.plan, whole.settings), 1'000'000ull * (48 - 4 + 4 * (96 - 12)));
  EXPECT_TRUE(whole.message.empty());
  const FittedPlan less = fit(scene, {.budgetBytes = 30'000'000, .largestSide = 4096}, settings);
  EXPECT_LE(targetBytes(less.plan, less.settings), 30'000'000u);
  EXPECT_EQ(less.plan.drawnMirrors()[0].quality.samples, 1);
  EXPECT_LE(less.plan.drawnMirrors()[0].quality.scale, 1.0);
  EXPECT_TRUE(contains(less.message, "lowered quality.samples to 4, quality.samples to 2, quality.samples to 1"));
  EXPECT_TRUE(contains(less.message, "quality.scale to 1.0")) << less.message;
  EXPECT_EQ(less.settings.reflection.scale, 0.5) << "the others' images are not larger";
  const FittedPlan small = fit(scene, {.budgetBytes = 1ull << 40, .largestSide = 1500}, settings);
  EXPECT_EQ(small.plan.drawnMirrors()[0].quality.scale, 1.5);
  EXPECT_TRUE(contains(small.message, "lowered quality.scale to 1.5")) << small.message;
}

TEST(MirrorQuality, DepthIsSharedByEqualSampleCountsOnly) {
  Scene scene = sceneWith({wall({-1.2, 0, -5}, 0), wall({1.2, 0, -5}, 0)});
  Settings settings;
  settings.reflection.samples = 1;
  const auto bytes = [&] { return targetBytes(planOf(scene, settings), settings); };
  const uint64_t same = bytes();
  const FramePlan plan = planOf(scene, settings);
  const PixelRect rect = mirrorPass(plan, std::array{1})->view.rect;
  scene.mirrors[1].quality.samples = 4;
  EXPECT_EQ(bytes() - same, static_cast<uint64_t>(rect.area()) * 3 * (8 + 4));
}

TEST(MirrorQuality, AutomaticMirrorsChooseByThemselves) {
  Scene scene = sceneWith({wall({-1.2, 0, -5}, 0), wall({1.2, 0, -5}, 0)});
  scene.mirrors[0].quality.method = ReflectionMethod::automatic;
  const auto passes = [&](const TargetLimits& limits, int height, int samples = 1) {
    Settings settings;
    settings.view.samples = samples;
    TargetLimits all = limits;
    all.budgetBytes = 1ull << 40;
    all.largestSide = 65536;
    std::set<int> drawn;
    const FittedPlan fitted = planWithin(all, {scene, evaluate(scene, 0.0), settings, {height, height}});
    for (const Pass& pass : fitted.plan.drawnMirrors()) {
      drawn.insert(pass.view.path.front());
    }
    return drawn;
  };
  const std::set<int> both{0, 1};
  const std::set<int> other{1};
  EXPECT_EQ(passes({}, 20), both) << "a GPU renders small images";
  EXPECT_EQ(passes({}, 4000), other) << "rays are faster there";
  EXPECT_EQ(passes({}, 4000, 4), both);
  EXPECT_EQ(passes({.cpu = true}, 20), other);
  EXPECT_EQ(passes({.whyNoRays = "no room", .cpu = true}, 20), both);
  scene.mirrors[0].quality.method = ReflectionMethod::rays;
  EXPECT_EQ(passes({}, 20), other);
  EXPECT_EQ(passes({.whyNoRays = "no room"}, 20), both);
  scene.mirrors[0].quality.method = ReflectionMethod::raster;
  EXPECT_EQ(passes({}, 4000), both);
}

}  // namespace
}  // namespace speculum
