#include <cstdio>
#include <numeric>

#include "plan/frame_plan.hpp"
#include "plan/pass_mask.hpp"
#include "scene/scene_loader.hpp"
#include "test_headers.hpp"
#include "window/pace.hpp"

namespace speculum {
namespace {

constexpr double budget = 50.0;  // ms

// Prices in milliseconds, which the controller has to learn.
struct Device {
  double picture = 0.0;
  double pass = 0.0;
  double triangle = 0.0;
  double texel = 0.0;
  double sample = 0.0;
  double noise = 0.08;  // relative
  bool isCpu = true;
  double ray = 1e-3;

  double frameMs(const FrameWork& work, std::mt19937& random) const {
    const double samples = work.mainTexels * (work.viewSamples - 1) + work.mirrorTexels * (work.mirrorSamples - 1);
    const double ms = picture * (work.displayTexels + work.shadowTexels) + pass * work.passes +
                      triangle * work.triangles + texel * (work.mainTexels + work.mirrorTexels) + sample * samples +
                      ray * work.lightRays;
    return ms * std::exp(noise * std::normal_distribution<>()(random));
  }
};

const Device slowCpu{.picture = 5e-6, .pass = 0.3, .triangle = 2e-5, .texel = 1.5e-4, .sample = 1.1e-4};
const Device fastCpu{.picture = 2e-6, .pass = 0.05, .triangle = 5e-6, .texel = 1e-5, .sample = 4e-6};
const Device shadingBound{.picture = 1e-6, .pass = 0.0, .triangle = 0.0, .texel = 1.2e-4, .sample = 1.2e-4};
const Device geometryBound{.picture = 4e-6, .pass = 0.2, .triangle = 5e-5, .texel = 3e-5, .sample = 1e-6};
const Device gpu{.picture = 1e-6, .pass = 0.2, .triangle = 5e-6, .texel = 3e-5, .sample = 1e-5, .isCpu = false};

// A window on a device. `mirrors` scales what is seen in mirrors.
struct Window {
  const Device& device;
  std::mt19937 random{1};
  double load = 1.0;
  double mirrors = 1.0;
  double raysOfTexel = 0.0;
  MotionController controller{device.isCpu};
  std::vector<MotionLevel> levels = motionLevels({}, {}, {}, 1 + 4);
  std::deque<std::pair<FrameWork, double>> inFlight;  // frames whose times have not arrived yet
  std::vector<double> times{};                        // ms
  std::vector<size_t> chosen{};

  FrameWork work(const Settings& settings) const {
    const double texels = 1280.0 * 720.0 * settings.view.scale * settings.view.scale;
    const double passes = std::min(8.0 * mirrors, static_cast<double>(settings.reflection.maxPasses));
    return {.displayTexels = 1280.0 * 720.0,
            .passes = 1.0 + passes,
            .mirrorPasses = passes,
            .triangles = 1e5 * (1.0 + mirrors),
            .mainTexels = texels,
            .mirrorTexels = 0.6 * mirrors * texels,
            .lightRays = settings.effects.shadowLookup == ShadowLookup::map ? 0.0 : raysOfTexel * texels,
            .viewSamples = settings.view.samples,
            .mirrorSamples = 1.0 * settings.reflection.samples};
  }
  double draw(const Settings& settings) {
    const FrameWork frame = work(settings);
    const double ms = load * device.frameMs(frame, random);
    inFlight.emplace_back(frame, ms);
    if (inFlight.size() > 2) {
      controller.learn(inFlight.front().first, inFlight.front().second);
      inFlight.pop_front();
    }
    return ms;
  }
  void stand(int frames) {
    controller.setStill();
    for (int i = 0; i < frames; ++i) {
      draw(levels[0].settings);
    }
  }
  void move(int frames) {
    for (int i = 0; i < frames; ++i) {
      const double seconds = times.empty() ? 0.0 : times.back() / 1000.0;
      size_t level = controller.begin(levels, budget, seconds);
      while (const std::optional<size_t> next = controller.next(levels, work(levels[level].settings))) {
        level = *next;
      }
      chosen.push_back(level);
      times.push_back(draw(levels[chosen.back()].settings));
    }
  }
  void clear() {
    times.clear();
    chosen.clear();
  }
  double share(double of) const {
    std::vector<double> sorted = times;
    std::ranges::sort(sorted);
    return sorted[static_cast<size_t>(of * static_cast<double>(sorted.size() - 1))];
  }
  int changes() const {
    return std::inner_product(chosen.begin(), chosen.end() - 1, chosen.begin() + 1, 0, std::plus(),
                              std::not_equal_to());
  }
  // Says whether the next better level than the last one chosen would have taken less than 0.7 of the budget.
  bool wastes() const {
    std::mt19937 other(1);
    Device quiet = device;
    quiet.noise = 0.0;
    return chosen.back() > 0 && load * quiet.frameMs(work(levels[chosen.back() - 1].settings), other) < 0.7 * budget;
  }
};

class OnEveryDevice : public testing::TestWithParam<Device> {
 protected:
  Window run_{GetParam()};
};

INSTANTIATE_TEST_SUITE_P(MotionController, OnEveryDevice,
                         testing::Values(slowCpu, fastCpu, shadingBound, geometryBound, gpu));

TEST_P(OnEveryDevice, BudgetIsKept) {
  run_.move(300);
  run_.clear();
  run_.move(300);
  EXPECT_LE(run_.share(0.95), 1.4 * budget);
  EXPECT_LE(std::accumulate(run_.times.begin(), run_.times.end(), 0.0) / 300.0, budget);
  EXPECT_FALSE(run_.wastes()) << "level " << run_.chosen.back();
}

TEST_P(OnEveryDevice, LevelDoesNotOscillate) {
  run_.move(100);
  run_.clear();
  run_.move(600);
  EXPECT_LE(run_.changes(), 6) << "a change in a hundred frames";
}

TEST_P(OnEveryDevice, FirstMovingFrameIsPredicted) {
  run_.stand(6);
  run_.move(1);
  EXPECT_LE(run_.times[0], 1.4 * budget);
  run_.move(60);
  run_.stand(6);
  run_.clear();
  run_.move(1);
  EXPECT_LE(run_.times[0], 1.4 * budget);
  EXPECT_FALSE(run_.wastes());
}

TEST_P(OnEveryDevice, LoadOfTheMachineIsFollowed) {
  run_.move(100);
  const size_t calm = run_.chosen.back();
  run_.load = 2.5;
  run_.move(12);
  run_.clear();
  run_.move(20);
  EXPECT_LE(run_.share(0.9), 1.4 * budget) << "within twelve frames";
  run_.load = 1.0;
  run_.move(400);
  EXPECT_LE(run_.chosen.back(), calm + 1);
  EXPECT_FALSE(run_.wastes());
}

TEST_P(OnEveryDevice, CheaperViewGainsQualityWithinASecond) {
  run_.mirrors = 1.5;
  run_.move(100);
  run_.mirrors = 0.1;
  for (double ms = 0.0; ms < 1000.0; ms += run_.times.back()) {
    run_.move(1);
  }
  EXPECT_FALSE(run_.wastes()) << "level " << run_.chosen.back();
}

TEST_P(OnEveryDevice, ViewIsFollowedWithoutDelay) {
  run_.move(100);
  run_.clear();
  for (int i = 0; i < 200; ++i) {
    run_.mirrors = i % 100 < 50 ? 0.1 : 1.5;
    run_.move(1);
  }
  EXPECT_LE(run_.share(0.95), 1.4 * budget);
}

TEST(MotionController, RaisesOneLevelAtATime) {
  Window run{slowCpu};
  run.mirrors = 3.0;
  run.move(60);
  run.mirrors = 0.0;
  run.clear();
  run.move(100);
  for (size_t i = 1; i < run.chosen.size(); ++i) {
    EXPECT_GE(run.chosen[i] + 1, run.chosen[i - 1]);
  }
  EXPECT_LT(run.chosen.back(), run.chosen.front());
}

TEST(MotionController, DisturbedFramesAreForgotten) {
  Window run{slowCpu};
  run.move(200);
  const size_t level = run.chosen.back();
  run.load = 8.0;
  run.move(1);
  run.load = 1.0;
  run.clear();
  run.move(30);
  EXPECT_LE(run.chosen.back(), level + 1);
}

TEST(MotionController, NeverMovesWithoutNeed) {
  Window run{fastCpu};
  run.mirrors = 0.0;
  run.stand(4);
  run.move(50);
  EXPECT_EQ(run.chosen, std::vector<size_t>(50, 0));
}

TEST(MotionController, TakesMapsOnlyWhereRaysAreSlow) {
  Scene scene;
  scene.lights = {{.castsShadow = true}};
  for (const double ray : {3e-3, 3e-5}) {
    SCOPED_TRACE(ray);
    Device device = fastCpu;
    device.ray = ray;
    Window run{device};
    run.levels = motionLevels(scene, {}, {}, 1 + 4);
    run.raysOfTexel = 0.2;
    run.mirrors = 0.0;
    run.stand(6);
    run.move(1);
    EXPECT_LE(run.times[0], 1.4 * budget);
    run.move(60);
    const Settings& settings = run.levels[run.chosen.back()].settings;
    EXPECT_EQ(settings.effects.shadowLookup, ray < 1e-4 ? ShadowLookup::traced : ShadowLookup::map);
    EXPECT_GE(settings.view.scale, 0.8) << "maps suffice";
  }
}

TEST(MotionLevels, NoLevelExceedsTheFirst) {
  Settings chosen;
  chosen.view.samples = 2;
  chosen.view.scale = 0.7;
  chosen.reflection.maxDepth = 1;
  chosen.reflection.maxPasses = 20;
  chosen.reflection.updateInterval = 3;
  chosen.reflection.minPixels = 2000.0;
  const std::vector<MotionLevel> front{{Settings(), 0.01}};
  const std::vector<MotionLevel> levels = motionLevels({}, chosen, front, 1 + 2 + 4);
  ASSERT_GT(levels.size(), 5u);
  EXPECT_TRUE(sameMainView(levels[0].settings, chosen));
  for (const auto& [settings, error] : levels) {
    EXPECT_LE(settings.view.samples, 2);
    EXPECT_LE(settings.view.scale, 0.7);
    EXPECT_LE(settings.reflection.maxDepth, 1);
    EXPECT_LE(settings.reflection.maxPasses, 20);
    EXPECT_GE(settings.reflection.updateInterval, 3);
    EXPECT_GE(settings.reflection.minPixels, 2000.0);
    EXPECT_TRUE(settings.reflection.clip == chosen.reflection.clip && settings.effects == chosen.effects);
  }
}

TEST(MotionLevels, WireframeKeepsItsResolution) {
  Settings chosen;
  chosen.view.wireframe = true;
  std::vector<MotionLevel> front(1);
  front[0].settings.view.scale = front[0].settings.reflection.scale = 0.25;
  front[0].settings.view.samples = 1;
  const std::vector<MotionLevel> levels = motionLevels({}, chosen, front, 1 + 2 + 4);
  EXPECT_GT(levels.size(), 1u);
  EXPECT_TRUE(std::ranges::all_of(levels, [](const MotionLevel& level) {
    return level.settings.view.scale == 1.0 && level.settings.reflection.scale == 1.0;
  }));
}

// Whatever mirrors ask for themselves, no level raises it, and the last one draws them as cheaply as the others.
TEST(MotionLevels, LowerTheQualityOfSingleMirrors) {
  Scene scene;
  scene.mirrors = {{.quality = {.scale = 4.0, .samples = 8, .method = ReflectionMethod::rays}},
                   {.quality = {.scale = 0.25, .samples = 1, .method = ReflectionMethod::automatic}},
                   {}};
  MotionLevel point{Settings(), 0.02};
  point.settings.reflection.scale = 0.5;
  for (const int samples : {1, 4}) {
    Settings chosen;
    chosen.reflection.samples = samples;
    for (const auto front : {std::span<const MotionLevel>(), std::span<const MotionLevel>(&point, 1)}) {
      const std::vector<MotionLevel> levels = motionLevels(scene, chosen, front, 1 + 2 + 4 + 8);
      EXPECT_EQ(levels[0].settings, chosen);
      for (size_t i = 1; i < levels.size(); ++i) {
        for (const Mirror& mirror : scene.mirrors) {
          const ReflectionSettings better = reflectionOf(mirror.quality, levels[i - 1].settings);
          const ReflectionSettings worse = reflectionOf(mirror.quality, levels[i].settings);
          EXPECT_LE(worse.scale, better.scale);
          EXPECT_LE(worse.samples, better.samples);
          EXPECT_TRUE(worse.method == better.method || worse.method == ReflectionMethod::raster);
        }
        EXPECT_NE(motionText(chosen, levels[i]), "full quality");
      }
      for (const Mirror& mirror : scene.mirrors) {
        const ReflectionSettings last = reflectionOf(mirror.quality, levels.back().settings);
        EXPECT_EQ(last.samples, 1);
        EXPECT_NE(last.method, ReflectionMethod::rays);
        EXPECT_LE(last.scale, front.empty() ? mirror.quality.scale.value_or(1.0) : 0.5);
      }
    }
  }
}

TEST(MotionLevels, FollowTheMeasuredFront) {
  MotionLevel point{Settings(), 0.02};
  point.settings.view.scale = 0.6;
  const std::vector<MotionLevel> levels = motionLevels({}, {}, std::span(&point, 1), 1 + 4);
  EXPECT_EQ(levels[1].settings.view.scale, 0.6);
  EXPECT_EQ(levels[1].settings.view.samples, 4);
  EXPECT_EQ(levels[1].error, 0.02);
  EXPECT_LT(levels.back().settings.view.scale, 0.27);
  EXPECT_TRUE(std::ranges::is_sorted(levels, [](auto& a, auto& b) { return a.error < b.error; }));
}

TEST(MotionLevels, FewMirrorsLoseImagesBeforePixels) {
  for (const auto& [mirrors, most] : {std::pair<size_t, int>(1, 8), {2, 8}, {16, 32}, {2000, 64}}) {
    Scene scene;
    scene.mirrors.resize(mirrors);
    const std::vector<MotionLevel> levels = motionLevels(scene, {}, {}, 1 + 4);
    const auto lower = std::ranges::find_if(
        levels, [](const MotionLevel& level) { return level.settings.reflection.minPixels > 1.0; });
    EXPECT_EQ(lower->settings.reflection.maxPasses, most) << mirrors << " mirrors";
    EXPECT_EQ(lower->settings.view.scale, 1.0) << mirrors << " mirrors";
    EXPECT_TRUE(std::ranges::is_sorted(levels, {}, &MotionLevel::error)) << mirrors << " mirrors";
  }
}

TEST(MotionLevels, ShadowMapsShrinkAfterThePicture) {
  Scene scene;
  scene.lights = {{.castsShadow = true}};
  const std::vector<MotionLevel> levels = motionLevels(scene, {}, {}, 1 + 4);
  for (const auto& [settings, error] : levels) {
    EXPECT_TRUE(settings.effects.shadowMapSize == 1024 || settings.view.scale < 0.75);
  }
  EXPECT_EQ(levels.back().settings.effects.shadowMapSize, 256);
}

TEST(MotionLevels, MapsReplaceTheRaysOfTheScene) {
  const auto last = [](const Scene& scene, const Settings& chosen = {}) {
    return motionLevels(scene, chosen, {}, 1 + 4).back().settings.effects;
  };
  Scene scene;
  EXPECT_EQ(last(scene), EffectSettings());
  scene.lights = {{.castsShadow = true}};
  EXPECT_EQ(last(scene).shadowLookup, ShadowLookup::map);
  EXPECT_EQ(last(scene).roughLookup, ReflectionSource::traced);
  Settings off;
  off.effects.shadows = false;
  EXPECT_EQ(last(scene, off), off.effects);
  scene.mirrors = {{.castsLight = true}};
  EXPECT_FALSE(last(scene).castsLight);
  EXPECT_EQ(last(scene).shadowLookup, ShadowLookup::map);
  scene.mirrors = {{.roughness = 0.2}, {.ripple = Ripple()}};
  EXPECT_EQ(last(scene).roughLookup, ReflectionSource::image);
  EXPECT_EQ(last(scene).rippleLookup, ReflectionSource::image);
  EXPECT_EQ(last(scene).curvedLookup, CurvedLookup::traced);
  scene.objects = {{.mirror = ObjectMirror()}};
  EXPECT_EQ(last(scene).curvedLookup, CurvedLookup::environment);
}

TEST(MotionLevels, ImagesReplaceTheRaysOfMirrors) {
  Settings chosen;
  chosen.reflection.method = ReflectionMethod::rays;
  const std::vector<MotionLevel> levels = motionLevels({}, chosen, {}, 1 + 4);
  EXPECT_EQ(levels.front().settings.reflection.method, ReflectionMethod::rays);
  EXPECT_EQ(levels.at(1).settings.reflection.method, ReflectionMethod::raster);
  EXPECT_EQ(levels.back().settings.reflection.method, ReflectionMethod::raster);
  chosen.reflection.method = ReflectionMethod::automatic;
  EXPECT_EQ(motionLevels({}, chosen, {}, 1 + 4).back().settings.reflection.method, ReflectionMethod::automatic)
      << "it takes what is faster";
}

TEST(FrameWork, CountsTheRaysOfEffects) {
  Scene scene;
  scene.mirrors = {{.roughness = 0.2}};
  scene.lights = {{.castsShadow = true}};
  const SceneState state;
  Settings settings;
  settings.effects.perSample = true;
  settings.effects.roughSamples = 8;
  FramePlan plan{.projection = Projection(1.0, 1.0, 0.1)};
  plan.main().view = mainView({}, plan.projection, 100, 100);
  plan.effects.shadowRays = true;
  EXPECT_EQ(workOf(plan, scene, state, settings).lightRays, 4 * 1e4);
  settings.effects.perSample = false;
  EXPECT_EQ(workOf(plan, scene, state, settings).lightRays, 1e4);
  plan.main().mirrors.push_back({.byRays = true, .polygon = {{-9, -9, -1}, {9, -9, -1}, {9, 9, -1}, {-9, 9, -1}}});
  const FrameWork work = workOf(plan, scene, state, settings);
  EXPECT_NEAR(work.roughRays, 8 * 2 * 1e4, 1e-3) << "a reflected ray and one to the light";
  Settings to = settings;
  to.view.scale = 0.5;
  to.effects.roughSamples = 4;
  EXPECT_NEAR(scaledWork(work, settings, to).roughRays, 2e4, 1e-3);
  to.effects.roughSamples = 1;
  EXPECT_NEAR(scaledWork(work, settings, to).roughRays, 2e4, 1e-3) << "one at each of 4 samples";
  settings.effects.roughSamples = 5;
  EXPECT_NEAR(workOf(plan, scene, state, settings).roughRays, 8 * 2 * 1e4, 1e-3) << "two at each";
  to.effects.roughLookup = ReflectionSource::image;
  EXPECT_EQ(scaledWork(work, settings, to).roughRays, 0.0);
  plan.effects.shadowMaps = true;
  EXPECT_EQ(workOf(plan, scene, state, settings).lightRays, 0.0);
}

TEST(FrameWork, HasNoDisplayPassWhereViewsAreEncoded) {
  FramePlan plan{.projection = Projection(1.0, 1.0, 0.1), .width = 100, .height = 50};
  plan.main().view = mainView({}, plan.projection, 100, 50);
  Settings settings;
  settings.view.samples = 1;
  EXPECT_EQ(workOf(plan, {}, {}, settings).displayTexels, 5000.0);
  plan.encodes = true;
  const FrameWork work = workOf(plan, {}, {}, settings);
  EXPECT_EQ(work.displayTexels, 0.0);
  Settings to = settings;
  to.reflection.scale = 0.5;
  EXPECT_EQ(scaledWork(work, settings, to).displayTexels, 0.0);
  to.view.scale = 0.5;
  EXPECT_EQ(scaledWork(work, settings, to).displayTexels, 5000.0) << "the main view is enlarged";
  EXPECT_EQ(scaledWork(work, settings, to).mainTexels, 1250.0);
}

TEST(FrameWork, FollowsTheBoundOnPasses) {
  Settings to;
  to.reflection.maxPasses = 8;
  const FrameWork work = scaledWork({.passes = 60.0, .mirrorPasses = 50.0, .triangles = 6e4}, {}, to);
  EXPECT_EQ(work.passes, 18.0);
  EXPECT_EQ(work.triangles, 1.8e4);
}

TEST(MotionLevels, WordsSayWhatIsGivenUp) {
  MotionLevel level{Settings(), 0.0512};
  EXPECT_EQ(motionText(Settings(), level), "full quality");
  level.settings.view.scale = 0.5;
  level.settings.view.samples = level.settings.reflection.samples = 1;
  EXPECT_EQ(motionText(Settings(), level), "0.5 scale, 1 sample (estimated error 0.05 FLIP)");
  level.settings.effects.shadowLookup = ShadowLookup::map;
  EXPECT_EQ(motionText(Settings(), level), "shadows from maps, 0.5 scale, 1 sample (estimated error 0.05 FLIP)");
  level.settings.effects = {};
  level.settings.reflection.samples = 2;
  level.settings.reflection.maxDepth = 1;
  EXPECT_EQ(motionText(Settings(), level),
            "0.5 scale, 1 sample, mirrors with 2 samples, depth 1 (estimated error 0.05 FLIP)");
  level.settings = {};
  level.settings.effects.roughSamples = 1;
  EXPECT_EQ(motionText(Settings(), level), "4 rays a pixel of rough mirrors (estimated error 0.05 FLIP)")
      << "one at each sample";
  level.settings = {};
  level.settings.reflection.maxPasses = 8;
  EXPECT_EQ(motionText(Settings(), level), "at most 8 mirror images (estimated error 0.05 FLIP)");
  level.settings = {};
  level.settings.reflection.minPixels = 1500.0;
  EXPECT_EQ(motionText(Settings(), level), "mirror images from 1500 pixels on (estimated error 0.05 FLIP)");
}

TEST(StillText, SaysTheErrorOfTheSettingsInForce) {
  Scene scene;
  EXPECT_EQ(stillText(scene, {}, ShadowLookup::traced), "");
  scene.lights = {{.castsShadow = true}};
  Settings settings;
  EXPECT_EQ(stillText(scene, settings, ShadowLookup::map), "") << "traced";
  settings.effects.shadowLookup = ShadowLookup::map;
  for (const int texels : {64, 1024, 4096}) {
    settings.effects.shadowMapSize = texels;
    EXPECT_EQ(stillText(scene, settings, ShadowLookup::map), "shadow outlines within a texel of the map, 1/" +
                                                                 std::to_string(texels / 2) +
                                                                 " of the distance from the light");
  }
}

TEST(StillText, CoverageIsGrainyAndCutOutsAreExact) {
  Scene scene;
  scene.meshes.resize(1);
  scene.meshes[0].parts.resize(1);
  Material& material = scene.meshes[0].parts[0].material;
  EXPECT_EQ(stillText(scene, {}, ShadowLookup::traced), "");
  material.opacity = 0.5;
  EXPECT_EQ(stillText(scene, {}, ShadowLookup::traced), "grain of transparent materials");
  Settings opaque;
  opaque.effects.transparency = false;
  EXPECT_EQ(stillText(scene, opaque, ShadowLookup::traced), "");
  material.cutoff = 0.5;
  EXPECT_EQ(stillText(scene, {}, ShadowLookup::traced), "");
}

// The text names maps exactly where the plan of a random scene uses them.
TEST(StillText, AgreesWithThePlan) {
  std::mt19937 random(3);
  const auto chance = [&](double share) { return std::bernoulli_distribution(share)(random); };
  std::map<bool, int> found;
  for (int run = 0; run < 200; ++run) {
    Scene scene = parseScene("scene.toml",
                             "[camera]\nposition = [0, 0, 4]\ntarget = [0, 0, 0]\n"
                             "[[mirror]]\nposition = [0, 0, -1]\nsize = [4, 4]\nreflectance = [0.5, 0.5, 0.5]\n"
                             "base_color = [0.1, 0.1, 0.1]\n");
    scene.mirrors[0].castsLight = chance(0.2);
    scene.lights.resize(chance(0.2) ? 17 : 1 + run % 3, {.position = {0.0, 0.5, 1.0}, .intensity = 1.0});
    for (PointLight& light : scene.lights) {
      light.castsShadow = chance(0.8);
    }
    Settings settings;
    settings.effects.shadows = chance(0.8);
    settings.effects.castsLight = chance(0.5);
    settings.effects.shadowLookup =
        std::array{ShadowLookup::map, ShadowLookup::automatic, ShadowLookup::traced}[run % 3];
    const FittedPlan fitted = planWithin({.budgetBytes = 1ull << 40, .largestSide = 16384, .cpu = true},
                                         {scene, evaluate(scene, 0.0), settings, glm::ivec2(run % 2 ? 64 : 1024)});
    const bool maps = fitted.plan.effects.shadowMaps;
    EXPECT_EQ(contains(stillText(scene, settings, fitted.settings.effects.shadowLookup), "shadow outlines"), maps)
        << run;
    found[maps] += settings.effects.shadowLookup == ShadowLookup::automatic;
  }
  EXPECT_GT(std::min(found[true], found[false]), 10);
}

TEST(Movement, LastsAMomentAfterTheLastStep) {
  Movement movement;
  CameraPose camera;
  movement.update(camera, false, 0.1);
  EXPECT_FALSE(movement.moving()) << "the first picture stands still";
  camera.eye.x = 1.0;
  movement.update(camera, false, 0.1);
  EXPECT_TRUE(movement.moving() && !movement.ending());
  movement.update(camera, false, 0.1);
  EXPECT_TRUE(movement.moving() && movement.ending());
  movement.update(camera, false, 0.1);
  EXPECT_FALSE(movement.moving());
  movement.update(camera, true, 0.1);
  EXPECT_TRUE(movement.moving() && !movement.ending()) << "something else moves";
  movement.update(camera, false, 1.0);
  camera.eye.x = 2.0;
  movement.restart();
  movement.update(camera, false, 0.1);
  EXPECT_FALSE(movement.moving()) << "another scene has another camera";
}

class PacedScene : public testing::Test, private PicturePlanner {
 protected:
  FittedPlan frame(bool moves = false) {
    pace_.begin({}, moves, seconds_);
    return pace_.plan({.frame = {scene_, state_, chosen_, {}, {.refined = refined_, .accumulated = accumulated_}},
                       .planner = *this,
                       .shown = {.revision = revision_},
                       .budgetMs = budgetMs_,
                       .input = input_,
                       .covered = covered_,
                       .target = target_});
  }
  // Plans a frame and returns the pictures of its mean and the one that is drawn.
  std::pair<int, int> pictureOf(bool moves = false) {
    frame(moves);
    return picture_;
  }
  void expectText(const std::string& start) const { EXPECT_TRUE(startsWith(pace_.text(), start)); }

  FittedPlan plan(const FrameRequest& request) override {
    planned_ = request.settings;
    picture_ = {planned_.view.accumulate, request.picture};
    FittedPlan fitted{.settings = planned_};
    const auto side = static_cast<int>(side_ * planned_.view.scale);
    fitted.plan.main().view.rect = {0, 0, side, side};
    if (leavesOut_) {
      fitted.plan.skipped.push_back({.reason = SkipReason::maxPasses});
    }
    return fitted;
  }

  Pace pace_{true, 1 + 4};
  Scene scene_;
  SceneState state_;
  Settings chosen_;
  Settings planned_;
  std::pair<int, int> picture_;
  double seconds_ = 0.1;  // between frames
  uint64_t revision_ = 1;
  double budgetMs_ = 0.0;
  std::shared_ptr<const RefinedTiles> refined_;
  int accumulated_ = 0;                 // pictures in the renderer's mean
  std::optional<Pace::Target> target_;  // not kept yet
  bool input_ = false;
  bool covered_ = false;
  bool leavesOut_ = false;  // reflection.max_passes leaves mirrors without a pass
  int side_ = 0;            // of the main view, pixels
  uint64_t number_ = 0;     // of the last frame
};

// Draws on a device whose frames take half a second whatever they draw.
TEST_F(PacedScene, LowersOnlyWhatMoves) {
  chosen_.quality.stillPictures = 1;
  seconds_ = 0.5;
  side_ = 960;
  const auto draw = [&](bool moves) {
    frame(moves);
    pace_.drawn(++number_, 1.0, 0.0, true);
    pace_.finished({.frame = number_, .gpuMs = 500.0});
  };
  draw(false);
  EXPECT_TRUE(sameMainView(planned_, {}));
  EXPECT_EQ(pace_.text(), "");
  draw(true);
  EXPECT_TRUE(sameMainView(planned_, {})) << "never, with 0";
  budgetMs_ = budget;
  for (int i = 0; i < 8; ++i) {
    draw(true);
  }
  EXPECT_LT(planned_.view.scale, 0.27);
  EXPECT_TRUE(pace_.lowers());
  expectText("Moving: 0.2");
  EXPECT_FALSE(contains(pace_.text(), "mirror images")) << "no more are called for";
  leavesOut_ = true;
  draw(true);
  EXPECT_TRUE(contains(pace_.text(), "at most 8 mirror images"));
  draw(false);
  expectText("Draft: 0.2");
  draw(false);
  EXPECT_TRUE(sameMainView(planned_, {})) << "tiles of the whole picture";
  EXPECT_FALSE(pace_.lowers());
}

TEST_F(PacedScene, SendingThePictureCounts) {
  budgetMs_ = budget;
  side_ = 960;
  const double gpuMs = 0.6 * budget;
  const auto scaleAfter = [&](double sendMs, double everyThirdMs) {
    for (int i = 0; i < 60; ++i) {
      frame(true);
      pace_.drawn(++number_, 1.0, 0.0, true);
      pace_.presented(gpuMs + (i % 3 == 0 ? everyThirdMs : sendMs));
      pace_.finished({.frame = number_, .gpuMs = gpuMs});
    }
    return planned_.view.scale;
  };
  EXPECT_EQ(scaleAfter(0.5 * budget, 0.0), 1.0) << "waiting for the monitor";
  EXPECT_LT(scaleAfter(0.5 * budget, 0.5 * budget), 1.0);
}

// A frame in parts is drawn before it is presented, and its program waits meanwhile.
TEST_F(PacedScene, PartsAreWaitedFor) {
  budgetMs_ = budget;
  side_ = 960;
  const auto scaleAfter = [&](bool cpuDevice, double cpuMs, double waitedMs, double presentMs) {
    pace_ = Pace(cpuDevice, 1 + 4);
    for (int i = 0; i < 60; ++i) {
      frame(true);
      pace_.drawn(++number_, cpuMs, waitedMs, true);
      pace_.presented(presentMs);
      pace_.finished({.frame = number_, .gpuMs = 0.6 * budget});
    }
    return planned_.view.scale;
  };
  EXPECT_LT(scaleAfter(true, 1.0, 0.6 * budget, 0.5 * budget), 1.0) << "it takes long to send the picture";
  EXPECT_EQ(scaleAfter(true, 1.0, 0.6 * budget, 0.0), 1.0);
  EXPECT_LT(scaleAfter(false, 0.6 * budget, 0.6 * budget, 0.0), 1.0);
  EXPECT_EQ(scaleAfter(false, 0.6 * budget, 0.0, 0.0), 1.0) << "drawn while the program works";
}

// Opens a scene whose frames take `fullMs` with four samples in full resolution.
class OpenedScene : public PacedScene {
 protected:
  void open(double fullMs) {
    budgetMs_ = budget;
    seconds_ = 0.05;
    side_ = 960;
    pace_ = Pace(true, 1 + 4);
    opening_.begin(true, true);
    covered_ = moves_ = true;
    number_ = 0;
    for (int i = 0; i < 40 || (i < 2000 && opening_.covered()); ++i) {
      draw(fullMs);
    }
  }
  void draw(double fullMs) {
    const FittedPlan fitted = frame(moves_);
    ++number_;
    pace_.drawn(number_, 1.0, 0.0, number_ > 2);  // the first frames compile
    const double scale = planned_.view.scale;
    double ms = fullMs * scale * scale * planned_.view.samples / 4.0;
    if (const auto& tiles = fitted.plan.tiles) {
      ms *= static_cast<double>(tiles->end - tiles->first) / static_cast<double>(tileCount(fitted.plan));
    }
    pace_.finished({.frame = number_, .gpuMs = ms});
    if (opening_.drawn(pace_.playCost(), moves_, endsPicture(fitted.plan) && !pace_.coarse(), 0.0)) {
      moves_ = false;
      stoodAt_ = number_;
    }
    uncoveredBy_ = std::exchange(covered_, opening_.covered()) && !covered_ ? planned_ : uncoveredBy_;
  }

  FirstPictures opening_;
  bool moves_ = true;
  uint64_t stoodAt_ = 0;
  Settings uncoveredBy_;  // of the picture that was seen first
};

TEST_F(OpenedScene, MovesUnaskedWhereTheDeviceCanMoveIt) {
  std::mt19937 random(2);
  for (int run = 0; run < 12; ++run) {
    const bool slow = run % 2 == 0;
    // One sample of a quarter of the pixels takes a sixteenth.
    const double sixteenth =
        slow ? std::uniform_real_distribution(70.0, 400.0)(random) : std::uniform_real_distribution(0.1, 35.0)(random);
    SCOPED_TRACE(sixteenth);
    open(16.0 * sixteenth);
    EXPECT_EQ(moves_, !slow);
    EXPECT_EQ(opening_.holds(), slow);
    EXPECT_FALSE(opening_.covered()) << "it moves, or is drawn in full";
    ASSERT_TRUE(pace_.playCost());
    double rate = 0.0;
    double scale = 0.0;
    EXPECT_EQ(
        std::sscanf(pace_.playCost()->c_str(), "Play (about %lf frames/s at %lf of the resolution)", &rate, &scale),
        slow ? 2 : -1);
    if (slow) {
      EXPECT_LE(stoodAt_, 15u);
      EXPECT_NEAR(scale, std::max(0.25, 0.5 * std::sqrt(budget / sixteenth)), 0.15 * scale);
      EXPECT_NEAR(1000.0 / rate, 4.0 * scale * scale * sixteenth, 0.3 * 1000.0 / rate);
    }
  }
}

TEST_F(OpenedScene, FirstPictureIsCheapButNotCoarse) {
  for (const double budgets : {10.0, 100.0}) {  // of a picture with one sample
    open(4.0 * budgets * budget);
    EXPECT_EQ(uncoveredBy_.view.scale, 1.0);
    EXPECT_EQ(uncoveredBy_.view.samples, budgets < 20.0 ? 1 : 4) << "else the whole picture follows the coarse draft";
  }
  covered_ = false;
  ++revision_;
  draw(40.0 * budget);
  EXPECT_LT(planned_.view.scale, 1.0) << "a draft that is seen at once";
}

TEST_F(OpenedScene, EditsKeepTheOfferToPlay) {
  open(1600.0);
  ASSERT_TRUE(startsWith(pace_.playCost().value_or(""), "Play"));
  pace_.sceneChanged();
  draw(1600.0);
  EXPECT_TRUE(startsWith(pace_.playCost().value_or(""), "Play"));
  pace_.forgetPlayCost();
  EXPECT_FALSE(pace_.playCost());
}

TEST(FirstPictures, StaysCoveredUntilThereIsAGoodPicture) {
  FirstPictures opening;
  opening.begin(true, true);
  EXPECT_FALSE(opening.drawn(std::nullopt, true, true, 0.0)) << "nothing is known yet";
  EXPECT_TRUE(opening.covered());
  EXPECT_TRUE(opening.drawn("Play", true, false, 0.0));
  EXPECT_FALSE(opening.drawn("Play", false, false, 0.0)) << "only once";
  EXPECT_TRUE(opening.covered()) << "a draft";
  opening.drawn("Play", false, true, 0.0);
  EXPECT_FALSE(opening.covered());
  EXPECT_TRUE(opening.holds());
  opening.drawn("Play", true, false, 0.0);
  EXPECT_FALSE(opening.holds()) << "the user plays it";
  opening.begin(false, true);
  EXPECT_FALSE(opening.drawn("Play", false, false, 0.0)) << "nothing moves";
  EXPECT_TRUE(opening.covered());
  opening.uncover();
  EXPECT_FALSE(opening.covered());
  opening.begin(true, true);
  EXPECT_FALSE(opening.drawn("", true, false, 0.0)) << "fast enough";
  EXPECT_FALSE(opening.covered());
  opening.begin(true, true);
  for (int i = 0; i < 100; ++i) {
    EXPECT_FALSE(opening.drawn(std::nullopt, true, true, 0.0)) << "never known";
  }
  EXPECT_FALSE(opening.covered());
  opening.begin(false, true);
  for (const double seconds : {0.1, 5.0, 29.9}) {
    opening.drawn(std::nullopt, false, false, seconds);
    EXPECT_TRUE(opening.covered());
  }
  opening.drawn(std::nullopt, false, false, 30.1);
  EXPECT_FALSE(opening.covered()) << "the first picture takes long, and a draft is there";
}

TEST(FirstPictures, CoverSaysWhatIsPrepared) {
  FirstPictures opening;
  opening.begin(true, true);
  EXPECT_EQ(opening.text(true, std::nullopt), "Preview. Compiling shaders for the first picture");
  EXPECT_EQ(opening.text(false, std::nullopt), "Compiling shaders for the first picture");
  opening.shows({}, false);
  opening.drawn(std::nullopt, true, false, 1.0);
  EXPECT_EQ(opening.text(true, std::nullopt), "Preview. Measuring how fast the scene plays");
  opening.drawn("slow", true, false, 1.0);
  EXPECT_EQ(opening.text(true, std::nullopt), "Preview. Compiling shaders for the first picture");
  EXPECT_EQ(opening.text(true, 0.379), "Preview. Drawing the first picture: 37 %");
}

TEST(FirstPictures, OnlyAnotherContentUncovers) {
  FirstPictures opening;
  FirstPictures::Content content;
  opening.begin(false, true);
  for (int i = 0; i < 3; ++i) {
    opening.shows(content, false);
    EXPECT_TRUE(opening.covered());
  }
  const auto uncovers = [&](const auto& change) {
    opening.begin(false, true);
    opening.shows(content, false);
    change();
    opening.shows(content, false);
    return !opening.covered();
  };
  EXPECT_TRUE(uncovers([&] { content.settings.view.exposure = 2.0; }));
  EXPECT_TRUE(uncovers([&] { ++content.revision; }));
  EXPECT_TRUE(uncovers([&] { content.time = 1.0; }));
  EXPECT_TRUE(uncovers([&] { content.camera = CameraPose{}; }));
  opening.begin(true, true);
  for (int i = 0; i < 3; ++i) {
    content.time += 0.1;
    opening.shows(content, false);
    EXPECT_TRUE(opening.covered()) << "it moves by itself";
    opening.drawn(std::nullopt, true, true, 0.0);
  }
  EXPECT_TRUE(opening.drawn("Play", true, false, 0.0));
  content.time = 0.0;
  ++content.seeks;
  opening.shows(content, false);
  EXPECT_TRUE(opening.covered()) << "back at its start";
  content.time = 0.1;
  opening.shows(content, false);
  EXPECT_FALSE(opening.covered()) << "the user plays it";
  opening.begin(true, true);
  opening.shows(content, false);
  content.camera->eye.x = 2.0;
  opening.shows(content, false);
  EXPECT_FALSE(opening.covered()) << "the user moves the camera while the scene moves";
  opening.begin(true, true);
  opening.shows(content, false);
  ++content.seeks;
  content.time = 4.0;
  opening.shows(content, false);
  EXPECT_FALSE(opening.covered()) << "the user sets the time while the scene moves";
  opening.begin(true, true);
  opening.shows(content, false);
  opening.drawn(std::nullopt, false, false, 0.0);
  EXPECT_FALSE(opening.covered()) << "the user pauses it where it is";
  opening.begin(false, true);
  opening.shows(content, true);
  EXPECT_FALSE(opening.covered()) << "two halves are compared";
}

TEST_F(PacedScene, StillPicturesConvergeOnce) {
  chosen_.quality.stillPictures = 3;
  EXPECT_EQ(pictureOf(), std::pair(1, 0)) << "full quality first";
  for (int picture = 0; picture < 3; ++picture) {
    EXPECT_EQ(pace_.text(), std::to_string(picture) + " of 3 pictures averaged");
    EXPECT_EQ(pace_.progress(), "not finished: " + std::to_string(std::max(picture, 1)) + " of 3 pictures averaged");
    EXPECT_TRUE(pace_.wantsFrame());
    EXPECT_EQ(pictureOf(), std::pair(3, picture));
  }
  EXPECT_EQ(pace_.text(), "3 of 3 pictures averaged");
  EXPECT_EQ(pace_.progress(), "finished: 3 pictures averaged");
  EXPECT_FALSE(pace_.wantsFrame());
  EXPECT_FALSE(pace_.drawsSlowly()) << "each took one frame";
  EXPECT_EQ(pictureOf(), std::pair(3, 3)) << "the mean again";
  chosen_.ui.scale = 2.0;
  EXPECT_EQ(pictureOf(), std::pair(3, 3)) << "the size of panels changes no pixel";
  chosen_.quality.motionMs = 0.0;
  EXPECT_EQ(pictureOf(), std::pair(3, 3)) << "nor does what moves otherwise";
  chosen_.view.continuous = true;
  EXPECT_EQ(pictureOf(), std::pair(3, 3)) << "nor how often the window draws";
  revision_ = 2;
  EXPECT_EQ(pictureOf(), std::pair(1, 0)) << "something else is shown";
  revision_ = 3;
  budgetMs_ = 1e-9;
  EXPECT_EQ(pictureOf(), std::pair(1, 0)) << "full quality would take too long";
  expectText("Draft: 0.2");
  EXPECT_EQ(pace_.progress(), "not finished: a draft");
  EXPECT_EQ(pictureOf(), std::pair(3, 0));
}

TEST_F(PacedScene, TargetsKeepTheMean) {
  chosen_.quality.stillPictures = 3;
  target_.emplace(MirrorPath{}, TargetKind::depth);
  for (const int picture : {0, 0, 1, 2}) {
    EXPECT_EQ(pictureOf().second, picture);
    EXPECT_FALSE(pace_.repeats());
  }
  target_.reset();
  EXPECT_EQ(pictureOf(), std::pair(3, 3));
  for (const int mirror : {0, 1}) {
    target_.emplace(MirrorPath{mirror}, TargetKind::color);
    EXPECT_EQ(pictureOf(), std::pair(3, 2)) << "the last picture again";
    EXPECT_TRUE(pace_.repeats());
    EXPECT_EQ(pictureOf(), std::pair(3, 3)) << "once, even if it lacks the target";
    EXPECT_FALSE(pace_.wantsFrame());
  }
  target_.reset();
  frame();
  EXPECT_EQ(pace_.text(), "3 of 3 pictures averaged");
}

TEST_F(PacedScene, MeansEndWhereTheyHaveConverged) {
  chosen_.quality.stillPictures = 64;
  chosen_.quality.stillError = 0.5;
  frame();
  for (accumulated_ = 0; accumulated_ < 8; ++accumulated_) {
    EXPECT_EQ(pictureOf(), std::pair(64, accumulated_));
    EXPECT_EQ(planned_.view.accumulateError, 0.5);
  }
  refined_ = std::make_shared<RefinedTiles>(RefinedTiles{8, {32, 8}, {0, 1, 0, 0}});
  for (; accumulated_ < 12; ++accumulated_) {
    EXPECT_EQ(pictureOf(), std::pair(64, accumulated_));
    EXPECT_EQ(pace_.text(), std::to_string(accumulated_ + 1) + " of 64 pictures averaged, refining 25 %");
  }
  refined_ = std::make_shared<RefinedTiles>(RefinedTiles{12, {32, 8}, {0, 0, 0, 0}});
  EXPECT_EQ(pictureOf(), std::pair(64, 64)) << "the mean again";
  EXPECT_EQ(pace_.text(), "12 of 64 pictures averaged: converged");
  EXPECT_EQ(pace_.progress(), "finished: 12 pictures averaged");
  EXPECT_FALSE(pace_.wantsFrame());
  target_.emplace(MirrorPath{0}, TargetKind::color);
  EXPECT_EQ(pictureOf(), std::pair(64, 11)) << "the last picture that was drawn";
  EXPECT_EQ(pace_.text(), "12 of 64 pictures averaged: converged");
  chosen_.view.accumulateError = 1.0;
  frame();
  EXPECT_EQ(pictureOf(), std::pair(64, 0));
  EXPECT_EQ(planned_.view.accumulateError, 1.0) << "the larger of both";
}

// As while frames are recorded, or with quality.motion_ms at 0.
TEST_F(PacedScene, MeansBeginAnewAfterMovementWithoutBudget) {
  chosen_.quality.stillPictures = 3;
  seconds_ = 1.0;
  frame();
  EXPECT_EQ(pictureOf(), std::pair(3, 0));
  EXPECT_EQ(pictureOf(true), std::pair(1, 0));
  EXPECT_EQ(pictureOf(), std::pair(1, 0));
  EXPECT_EQ(pictureOf(), std::pair(3, 0));
}

TEST_F(PacedScene, LostLastFrameOfMovementIsMadeUpFor) {
  chosen_.quality.stillPictures = 1;
  budgetMs_ = budget;
  frame(true);
  pace_.begin({}, false, 1.0);
  EXPECT_FALSE(pace_.moving());
  EXPECT_TRUE(pace_.wantsFrame()) << "no frame was planned since";
  frame();
  EXPECT_FALSE(pace_.wantsFrame());
}

// As when a recording begins.
TEST_F(PacedScene, PictureWithoutBudgetIsNoRepeatBeforeItIsComplete) {
  chosen_.quality.stillPictures = 1;
  side_ = 3200;
  budgetMs_ = budget;
  frame();
  expectText("Draft: ");
  budgetMs_ = 0.0;
  frame();
  EXPECT_FALSE(pace_.repeats());
  EXPECT_FALSE(pace_.drawsSlowly());
  frame();
  EXPECT_TRUE(pace_.repeats());
}

// Pictures that take several budgets, soon after input. The device reports the time of a frame when the next one
// begins.
class SlowPictures : public PacedScene {
 protected:
  SlowPictures() {
    budgetMs_ = budget;
    side_ = 3200;
    seconds_ = 0.0;
  }
  FittedPlan draw() {
    FrameTimings timings{.frame = number_, .gpuMs = ms_ + panelsMs_};
    if (panelsMs_ > 0.0) {
      timings.passes = {{.name = "main view", .gpuMs = ms_}, {.name = "overlay", .gpuMs = panelsMs_}};
    }
    pace_.finished(timings);
    const FittedPlan fitted = frame();
    const TileRange tiles = tilesOfPasses(fitted.plan)[0];
    ms_ = 0.0;
    for (size_t tile = tiles.first; tile < tiles.end; ++tile) {
      ms_ += (tile % 8000 < 800 ? 5.0 : 0.5) / 16;  // a tenth of the tiles is dear
    }
    pace_.drawn(++number_, besidesMs_, 0.0, false);
    return fitted;
  }
  // Draws a picture tile by tile and returns the times of its frames.
  std::vector<double> drawPicture() {
    std::vector<double> times;
    size_t end = 0;
    while (end < count_) {
      EXPECT_TRUE(pace_.wantsFrame());
      const FittedPlan fitted = draw();
      if (!fitted.plan.tiles) {
        ADD_FAILURE() << "no tiles";
        break;
      }
      EXPECT_EQ(fitted.plan.tiles->first, end);
      EXPECT_EQ(fitted.settings.view.samples, chosen_.view.samples);
      end = fitted.plan.tiles->end;
      times.push_back(ms_);
    }
    return times;
  }

  const size_t count_ = 40000;  // tiles
  double ms_ = 0.0;             // of the last frame's tiles
  double besidesMs_ = 0.0;
  double panelsMs_ = 0.0;  // the GPU's, of each frame
};

TEST_F(SlowPictures, UntouchedOnesTakeFewFrames) {
  chosen_.quality.stillPictures = 16;
  draw();
  for (int picture = 0; picture < 3; ++picture) {
    drawPicture();
  }
  const size_t frames = drawPicture().size();
  seconds_ = 0.1;
  drawPicture();
  const std::vector<double> times = drawPicture();
  EXPECT_LE(std::ranges::max(times), 9.0 * budget) << "an input waits for one frame";
  EXPECT_LE(2 * times.size(), frames);
  EXPECT_TRUE(pace_.drawsLong());
  const auto tilesMs = [&] {
    draw();
    return ms_;
  };
  EXPECT_GE(tilesMs(), 4.0 * budget);
  input_ = true;
  EXPECT_LE(tilesMs(), 0.1 * budget) << "at once";
  seconds_ = 0.02;
  EXPECT_LE(tilesMs(), 0.1 * budget) << "with a new panel";
  input_ = false;
  EXPECT_LE(tilesMs(), 2.6 * budget) << "more input may follow";
  input_ = true;
  const double touched = tilesMs();
  EXPECT_LE(touched, 1.3 * budget);
  EXPECT_GE(touched, 0.4 * budget) << "the picture goes on while there is input";
}

TEST_F(SlowPictures, PanelsAreNoTimeOfTiles) {
  chosen_.quality.stillPictures = 16;
  panelsMs_ = 2.0 * budget;
  draw();
  for (int picture = 0; picture < 3; ++picture) {
    drawPicture();
  }
  const std::vector<double> times = drawPicture();
  EXPECT_GE(std::accumulate(times.begin(), times.end(), 0.0), 0.6 * panelsMs_ * static_cast<double>(times.size()));
}

TEST_F(PacedScene, UntouchedPicturesOfSomeBudgetsAreWhole) {
  chosen_.quality.stillPictures = 8;
  budgetMs_ = budget;
  side_ = 960;
  const auto draw = [&] {
    FittedPlan fitted = frame();
    pace_.drawn(++number_, 1.0, 0.0, true);
    const double ms = 5.0 * budget * planned_.view.scale * planned_.view.scale;
    pace_.finished({.frame = number_, .gpuMs = ms, .passes = {{.gpuMs = ms}}});
    return fitted;
  };
  const auto drawTiles = [&] {
    bool tiles = false;
    for (int i = 0; i < 6; ++i) {
      tiles = draw().plan.tiles || tiles;
    }
    return tiles;
  };
  drawTiles();
  seconds_ = 0.0;
  input_ = true;
  revision_ = 2;
  draw();
  expectText("Draft: ");
  EXPECT_TRUE(drawTiles()) << "there is input";
  input_ = false;
  seconds_ = 1.0;
  revision_ = 3;
  EXPECT_FALSE(drawTiles());
  EXPECT_EQ(planned_.view.scale, 1.0);
  EXPECT_TRUE(pace_.drawsLong()) << "and waited for, so that input does not wait for two";
}

TEST_F(SlowPictures, AreDrawnTileByTile) {
  chosen_.quality.stillPictures = 16;
  chosen_.view.samples = chosen_.reflection.samples = 1;
  EXPECT_FALSE(draw().plan.tiles);
  expectText("Draft: ");
  EXPECT_LE(std::ranges::max(drawPicture()), 8.0 * budget);
  EXPECT_TRUE(pace_.drawsTiles());
  EXPECT_EQ(pace_.text(), "1 of 16 pictures averaged");
  for (int picture = 1; picture < 4; ++picture) {
    drawPicture();
  }
  for (const bool input : {false, true}) {
    input_ = input;
    EXPECT_LE(std::ranges::max(drawPicture()), (input ? 2.0 : 2.6) * budget) << "the dear tiles are known";
  }
  input_ = false;
  draw();
  expectText("6 of 16 pictures averaged, next one ");
  EXPECT_FALSE(pace_.firstShare());
  revision_ = 2;
  EXPECT_FALSE(draw().plan.tiles) << "another picture is asked for";
  expectText("Draft: ");
  EXPECT_EQ(draw().plan.tiles->first, 0u);
  EXPECT_TRUE(contains(pace_.text(), "; first picture ")) << "the draft is still shown";
  EXPECT_TRUE(pace_.firstShare());
  EXPECT_LT(pace_.firstShare().value_or(1.0), 0.5);
  besidesMs_ = 3.0 * budget;
  while (draw().plan.tiles.value_or(TileRange{0, count_}).end < count_) {
  }
  EXPECT_LE(drawPicture().size(), 20u) << "a slow program does not leave one tile for each frame";
}

TEST_F(SlowPictures, SingleOneEndsWithItsTiles) {
  chosen_.quality.stillPictures = 1;
  EXPECT_FALSE(draw().plan.tiles);
  expectText("Draft: ");
  drawPicture();
  EXPECT_EQ(picture_, std::pair(1, 0));
  EXPECT_FALSE(pace_.wantsFrame());
  EXPECT_EQ(pace_.text(), "");
  EXPECT_TRUE(draw().plan.tiles) << "another event, and the picture cannot be shown again";
  EXPECT_TRUE(pace_.wantsFrame()) << "it is not left unfinished";
  while (pace_.wantsFrame()) {
    EXPECT_TRUE(pace_.repeats());
    draw();
  }
  target_.emplace(MirrorPath{0}, TargetKind::color);
  EXPECT_TRUE(draw().plan.tiles) << "it stays while a target is drawn";
  EXPECT_TRUE(pace_.repeats());
}

TEST(SlowPicture, FacesOfMapsHaveTheirOwnFrames) {
  SlowPicture picture;
  picture.begin(5, 100, 1000.0);
  EXPECT_EQ(picture.next(50.0), (TileRange{0, 1})) << "nothing is known yet";
  picture.took(12.0);
  EXPECT_EQ(picture.next(50.0), (TileRange{1, 5})) << "no tile of a pass";
  picture.took(48.0);
  EXPECT_EQ(picture.next(50.0), (TileRange{5, 6})) << "a tile takes another time";
  picture.took(2.0);
  EXPECT_GT(picture.next(50.0).end, 20u);
  while (!picture.finished()) {
    picture.next(50.0);
  }
  picture.begin(0, 100, 1000.0);
  EXPECT_GT(picture.next(50.0).end, 15u) << "known from the picture before";
}

// One frame is slow for a reason other than its tiles. Without it the picture takes 100 frames.
TEST(SlowPicture, OneSlowFrameIsSoonForgotten) {
  constexpr size_t tiles = 10'000;
  SlowPicture picture;
  picture.begin(0, tiles, 1000.0);
  int frames = 0;
  for (TileRange drawn; drawn.end < tiles; ++frames) {
    drawn = picture.next(10.0);
    picture.took(frames == 10 ? 1000.0 : 0.1 * static_cast<double>(drawn.end - drawn.first));
  }
  EXPECT_LE(frames, 150);
}

// As on a machine that other programs keep busy: a frame takes a second, however few tiles it draws.
TEST(SlowPicture, SlowFramesDrawManyTiles) {
  SlowPicture slow;
  for (const size_t tiles : {1u, 100u, 128u, 255u, 1000u, 20000u}) {
    int frames = 0;
    for (slow.begin(3, tiles, 100.0); !slow.finished(); ++frames) {
      slow.next(50.0);
      slow.took(1000.0);
    }
    EXPECT_LE(frames, 3 + 128 + 10) << tiles;
    EXPECT_GE(frames, std::min<int>(static_cast<int>(tiles), 100)) << "each leaves time for input";
  }
}

TEST(SlowPicture, OneWrongMeasurementDoesNotLast) {
  SlowPicture slow;
  slow.begin(0, 20'000, 1e6);
  int frames = 0;
  for (; !slow.finished(); ++frames) {
    slow.next(50.0);
    slow.took(frames == 1 ? 3000.0 : 1000.0);  // as if two tiles took longer than twice one
  }
  EXPECT_LE(frames, 160);
}

TEST(SlowPicture, SlowTilesLeaveTimeForInput) {
  SlowPicture slow;
  slow.begin(0, 3600, 60'000.0);
  for (int frame = 0; !slow.finished(); ++frame) {
    const TileRange tiles = slow.next(100.0, frame % 3 == 0);
    const double ms = 300.0 * static_cast<double>(tiles.end - tiles.first);
    EXPECT_LE(ms, frame % 3 == 0 ? 300.0 : 600.0) << frame;
    slow.took(ms);
  }
}

TEST(Pace, BudgetFollowsDeviceAndMonitor) {
  Settings settings;
  EXPECT_EQ(motionBudget(settings, true, 144.0), 50.0);
  EXPECT_NEAR(motionBudget(settings, false, 60.0), 13.3, 0.1);
  settings.quality.motionMs = 7.0;
  EXPECT_EQ(motionBudget(settings, false, 60.0), 7.0);
}

}  // namespace
}  // namespace speculum
