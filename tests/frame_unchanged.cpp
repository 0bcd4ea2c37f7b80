// reflection.skip_unchanged: which images are shown again, by the planner alone, frame after frame.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>

#include "frame/effects.hpp"
#include "frame/image_reuse.hpp"
#include "frame/memory_fit.hpp"
#include "frame_support.hpp"
#include "image/color.hpp"

namespace speculum {
namespace {

using testing_support::wall;

constexpr int width = 640;
constexpr int height = 360;

Mesh ball() {
  Mesh mesh;
  mesh.halfExtent = glm::dvec3(0.2);
  mesh.radius = 0.2;
  mesh.parts.resize(1);
  mesh.indices = {0, 0, 0};
  mesh.vertices.resize(1);
  return mesh;
}

Object at(const glm::dvec3& position) {
  Object object;
  object.mesh = 0;
  object.position = position;
  return object;
}

enum { left, right, behind };                     // mirrors
enum { seenLeft, seenRight, unseen, seenTwice };  // objects

// Two mirrors side by side before the camera, which looks along -z; what they show stands before them. A third mirror
// behind the camera is seen in the right one only, and with it an object that stands between the two.
Scene room() {
  Scene scene;
  scene.camera.target = {0, 0, -1};
  scene.mirrors = {wall({-1.5, 0, -3}, -30, {1, 1}), wall({1.5, 0, -3}, 0, {1, 1}), wall({4.5, 0, 3}, 180, {3, 3})};
  scene.meshes = {ball()};
  scene.objects = {at({-2.5, 0, -2.9}), at({1.6, 0.3, -2}), at({0, 30, 0}), at({3.2, 0, 1})};
  PointLight light;
  light.position = {0, 2, 0};
  light.glow = 0.0;
  scene.lights = {light};
  return scene;
}

class Frames {
 public:
  explicit Frames(Scene s) : scene(std::move(s)) {}
  const FramePlan& next(double time = 0.0) {
    plan = planFrame(scene, evaluate(scene, time), settings, width, height,
                     {.held = plan.held, .main = main.content.empty() ? nullptr : &main});
    main = {settings, plan.mainContent};
    return plan;
  }
  // Mirrors seen directly that are rendered, and those that are not for being unchanged.
  std::set<int> rendered() const {
    std::set<int> mirrors;
    for (const PlannedPass& pass : plan.passes) {
      mirrors.insert(pass.view.path.front());
    }
    return mirrors;
  }
  std::set<int> unchanged() const {
    std::set<int> mirrors;
    for (const SkippedMirror& skip : plan.skipped) {
      if (skip.reason == SkipReason::unchanged) {
        EXPECT_EQ(skip.depth, 0);
        mirrors.insert(skip.mirror);
      }
    }
    return mirrors;
  }

  Scene scene;
  Settings settings;
  FramePlan plan;
  MainImage main;
};

using Mirrors = std::set<int>;
const Mirrors both{left, right};

TEST(Unchanged, AStillSceneIsRenderedOnce) {
  Frames frames(room());
  frames.next();
  const size_t passes = frames.plan.passes.size();
  ASSERT_GE(passes, 3u) << "there is a mirror in a mirror";
  EXPECT_EQ(frames.rendered(), both);
  EXPECT_TRUE(frames.plan.shown.empty());
  for (int frame = 1; frame < 5; ++frame) {
    frames.next();
    EXPECT_TRUE(frames.plan.passes.empty());
    EXPECT_EQ(frames.unchanged(), both);
    EXPECT_EQ(frames.plan.shown.size(), passes);
    EXPECT_EQ(frames.plan.held.size(), 2u) << "mirrors in mirrors are not held";
    const std::string detail = frames.plan.skipped.back().detail;
    EXPECT_EQ(detail, frame == 1 ? "image of the last frame" : "image of " + std::to_string(frame) + " frames ago");
    for (const MirrorDraw& draw : frames.plan.main.mirrors) {
      ASSERT_TRUE(draw.held);
      EXPECT_FALSE(draw.held->moved);
    }
  }
}

TEST(Unchanged, SwitchedOffEveryImageIsRendered) {
  Frames frames(room());
  frames.settings.reflection.skipUnchanged = false;
  for (int frame = 0; frame < 3; ++frame) {
    EXPECT_EQ(frames.next().passes.size(), 3u);
    EXPECT_TRUE(frames.plan.held.empty());
  }
  frames.settings.reflection.skipUnchanged = true;
  EXPECT_EQ(frames.next().passes.size(), 3u) << "nothing was held";
  EXPECT_TRUE(frames.next().passes.empty());
  frames.settings.reflection.skipUnchanged = false;
  EXPECT_EQ(frames.next().passes.size(), 3u);
}

// What is rendered in the frame after `change`; the one after that renders nothing.
Mirrors renderedAfter(const std::function<void(Frames&)>& change, Scene scene = room(), double time = 0.0) {
  Frames frames(std::move(scene));
  frames.next();
  frames.next();
  EXPECT_TRUE(frames.plan.passes.empty());
  change(frames);
  frames.next(time);
  Mirrors rendered = frames.rendered();
  frames.next(time);
  EXPECT_TRUE(frames.plan.passes.empty());
  return rendered;
}

TEST(Unchanged, OnlyWhatShowsTheChangeIsRendered) {
  const auto moving = [](int object) {
    return [object](Frames& f) { f.scene.objects[static_cast<size_t>(object)].position.y += 1e-9; };
  };
  EXPECT_EQ(renderedAfter(moving(seenLeft)), Mirrors{left});
  EXPECT_EQ(renderedAfter(moving(seenRight)), Mirrors{right});
  EXPECT_EQ(renderedAfter(moving(unseen)), Mirrors{});
  EXPECT_EQ(renderedAfter(moving(seenTwice)), Mirrors{right}) << "seen in the mirror behind the camera";
  EXPECT_EQ(renderedAfter([](Frames& f) { f.scene.mirrors[left].position.z -= 1e-9; }), Mirrors{left});
  EXPECT_EQ(renderedAfter([](Frames& f) { f.scene.mirrors[behind].position.z += 1e-9; }), Mirrors{right});
  EXPECT_EQ(renderedAfter([](Frames& f) { f.scene.lights[0].position.x += 1e-9; }), both);
  EXPECT_EQ(renderedAfter([](Frames& f) { f.scene.camera.position.x += 1e-9; }), both);
  EXPECT_EQ(renderedAfter([](Frames& f) { f.scene.camera.verticalFov += 1e-9; }), both);
}

TEST(Unchanged, WhatAnEditorChangesShows) {
  EXPECT_EQ(renderedAfter([](Frames& f) { f.scene.objects[seenLeft].color = glm::dvec3(0.1); }), Mirrors{left});
  EXPECT_EQ(renderedAfter([](Frames& f) { f.scene.objects[seenRight].shininess = 3.0; }), Mirrors{right});
  EXPECT_EQ(renderedAfter([](Frames& f) { f.scene.objects[seenRight].specular = glm::dvec3(0.1); }), Mirrors{right});
  EXPECT_EQ(renderedAfter([](Frames& f) { f.scene.objects.push_back(at({-2.5, 0.1, -2.9})); }), Mirrors{left});
  EXPECT_EQ(renderedAfter([](Frames& f) { f.scene.objects.erase(f.scene.objects.begin()); }), both)
      << "others have another index then";
  EXPECT_EQ(renderedAfter([](Frames& f) { f.scene.mirrors[behind].reflectance *= 0.5; }), Mirrors{right});
  EXPECT_EQ(renderedAfter([](Frames& f) { f.scene.mirrors[behind].baseColor = glm::dvec3(0.5); }), Mirrors{right});
  EXPECT_EQ(renderedAfter([](Frames& f) { f.scene.lights[0].intensity *= 2.0; }), both);
  EXPECT_EQ(renderedAfter([](Frames& f) { f.scene.lights[0].glow = 1.0; }), both);
  EXPECT_EQ(renderedAfter([](Frames& f) { f.scene.lights.push_back({}); }), both);
  EXPECT_EQ(renderedAfter([](Frames& f) { f.scene.environment.background.x += 0.1; }), both);
  EXPECT_EQ(renderedAfter([](Frames& f) { f.scene.environment.ambient.x += 0.1; }), both);
  EXPECT_EQ(renderedAfter([](Frames& f) { f.scene.environment.sky.emplace(); }), both);
}

TEST(Unchanged, SettingsThatImagesShowMakeThemAnew) {
  const auto after = [](auto change) { return renderedAfter([&](Frames& f) { change(f.settings); }); };
  EXPECT_EQ(after([](Settings& s) { s.view.exposure = 2.0; }), Mirrors{});
  EXPECT_EQ(after([](Settings& s) { s.view.samples = 1; }), Mirrors{});
  EXPECT_EQ(after([](Settings& s) { s.view.continuous = true; }), Mirrors{});
  EXPECT_EQ(after([](Settings& s) { s.reflection.updateInterval = 3; }), Mirrors{});
  EXPECT_EQ(after([](Settings& s) { s.reflection.scale = 0.5; }), both);
  EXPECT_EQ(after([](Settings& s) { s.reflection.maxDepth = 1; }), both);
  EXPECT_EQ(after([](Settings& s) { s.view.clearColor = glm::dvec3(0.5); }), both);
  EXPECT_EQ(after([](Settings& s) { s.view.textureFilter = TextureFilter::trilinear; }), both);
  EXPECT_EQ(after([](Settings& s) { s.effects.shadows = false; }), both);
  EXPECT_EQ(after([](Settings& s) { s.debug.checkFinite = true; }), both) << "they were not searched";
  EXPECT_EQ(after([](Settings& s) { s.debug.maskPasses = false; }), both);
}

TEST(Unchanged, TimeCountsOnlyWhereSomethingDependsOnIt) {
  const auto nothing = [](Frames&) {};
  EXPECT_EQ(renderedAfter(nothing, room(), 7.0), Mirrors{});
  Scene scene = room();
  scene.objects[seenLeft].spin = {0, 10, 0};
  EXPECT_EQ(renderedAfter(nothing, scene, 7.0), Mirrors{left});
  scene = room();
  scene.mirrors[behind].ripple = Ripple{.amplitude = 0.01};
  EXPECT_EQ(renderedAfter(nothing, scene, 7.0), both) << "rays may meet the waves anywhere";
  EXPECT_EQ(renderedAfter([](Frames& f) { f.scene.objects[unseen].position.y += 1.0; }, scene), both);
  scene.mirrors[behind].ripple->speed = 0.0;
  EXPECT_EQ(renderedAfter(nothing, scene, 7.0), Mirrors{});
  scene.mirrors[behind].ripple->speed = 0.2;
  Frames still(scene);
  still.settings.effects.ripple = false;
  still.next();
  EXPECT_TRUE(still.next(7.0).passes.empty());
}

TEST(Unchanged, ShadowsMayComeFromAnywhere) {
  Scene scene = room();
  scene.lights[0].castsShadow = true;
  EXPECT_EQ(renderedAfter([](Frames& f) { f.scene.objects[unseen].position.y += 1e-9; }, scene), both);
  EXPECT_EQ(renderedAfter([](Frames& f) { f.scene.camera.position.x += 0.0; }, scene), Mirrors{});
}

TEST(Unchanged, WhatIsShownAgainCallsForItsEffects) {
  Frames frames(room());
  frames.scene.objects[seenTwice].mirror.emplace();
  frames.scene.objects[seenTwice].position = {3.2, 0, 1.5};
  const auto why = [&] {
    return effectsOf(frames.scene, evaluate(frames.scene, 0.0), frames.settings,
                     frames.plan)[static_cast<size_t>(EffectKind::curved)]
        .why;
  };
  frames.next();
  ASSERT_TRUE(frames.plan.main.instances.empty() ||
              std::count(frames.plan.main.instances.begin(), frames.plan.main.instances.end(), seenTwice) == 0);
  const std::string fresh = why();
  frames.next();
  ASSERT_TRUE(frames.plan.passes.empty());
  EXPECT_EQ(why(), fresh);
  EXPECT_EQ(fresh, "object 3");
}

// What is saved is not spent on deeper reflections, which would come and go.
TEST(Unchanged, ABudgetOfPassesIsSpentAsIfAllWereRendered) {
  Frames frames(room());
  frames.scene.mirrors[left].rotation.y = 30.0;  // the third mirror is seen in both
  ASSERT_EQ(frames.next().passes.size(), 4u);
  frames.settings.reflection.maxPasses = 3;
  std::set<std::vector<int>> paths;
  for (const PlannedPass& pass : frames.next().passes) {
    paths.insert(pass.view.path);
  }
  ASSERT_EQ(paths.size(), 3u);
  for (int frame = 0; frame < 4; ++frame) {
    frames.scene.objects[frame % 2 == 0 ? seenLeft : seenRight].shininess = 2.0 + frame;
    frames.next();
    for (const PlannedPass& pass : frames.plan.passes) {
      EXPECT_TRUE(paths.count(pass.view.path));
    }
    EXPECT_EQ(frames.plan.passes.size() + frames.plan.shown.size(), 3u);
  }
}

TEST(Unchanged, WithAnIntervalNothingIsRenderedInItsTurnUnlessItChanged) {
  Frames frames(room());
  frames.settings.reflection.updateInterval = 3;
  frames.next();
  for (int frame = 1; frame < 9; ++frame) {
    EXPECT_TRUE(frames.next().passes.empty()) << "frame " << frame;
    EXPECT_EQ(frames.plan.skipped.back().detail,
              frame == 1 ? "image of the last frame" : "image of " + std::to_string(frame) + " frames ago");
  }
  Mirrors seen;
  for (int frame = 0; frame < 3; ++frame) {
    frames.scene.lights[0].position.x += 0.1;
    frames.next();
    EXPECT_LE(frames.rendered().size(), 1u) << "they still take turns";
    seen.merge(frames.rendered());
  }
  EXPECT_EQ(seen, both);
}

// Images of earlier frames are there from the start, when one of this frame needs the most.
TEST(Unchanged, WhereMemoryIsShortImagesAreRenderedAnewRatherThanWorse) {
  Scene scene = room();
  scene.mirrors[left] = wall({-2.5, 0, -5}, 0, {4.9, 5});
  scene.mirrors[right] = wall({2.5, 0, -5}, 0, {3, 3});
  scene.mirrors[behind] = wall({0, 0, 3}, 180, {12, 6});
  scene.objects[seenLeft].position = {-2.4, 0, -4};
  const auto fit = [&](uint64_t budget, std::span<const HeldImage> held) {
    return planWithin({.budgetBytes = budget, .largestSide = 4096}, scene, evaluate(scene, 0.0), {}, width, height,
                      {.held = held});
  };
  const FittedPlan first = fit(1ull << 40, {});
  const uint64_t needed = targetBytes(first.plan, first.settings);
  scene.objects[seenLeft].color = glm::dvec3(0.5);
  const FittedPlan mixed = fit(1ull << 40, first.plan.held);
  ASSERT_LT(mixed.plan.passes.size(), first.plan.passes.size());
  ASSERT_FALSE(mixed.plan.passes.empty());
  const uint64_t more = targetBytes(mixed.plan, mixed.settings);
  ASSERT_GT(more, needed) << "the case is not met";
  const FittedPlan fitted = fit(needed, first.plan.held);
  EXPECT_EQ(fitted.plan.passes.size(), first.plan.passes.size());
  EXPECT_EQ(fitted.settings.reflection, first.settings.reflection);
  EXPECT_TRUE(fitted.message.empty()) << fitted.message;
}

// The frame that renders the mirrors cannot tell; the one after it draws the main view with what is there.
TEST(UnchangedMain, IsDrawnOnceMoreThanItsMirrors) {
  Frames frames(room());
  EXPECT_FALSE(frames.next().mainUnchanged);
  EXPECT_TRUE(frames.plan.mainContent.empty());
  EXPECT_FALSE(frames.next().mainUnchanged);
  for (int frame = 2; frame < 5; ++frame) {
    EXPECT_TRUE(frames.next().mainUnchanged) << "frame " << frame;
  }
  frames.scene.mirrors.clear();
  EXPECT_FALSE(frames.next().mainUnchanged);
  EXPECT_TRUE(frames.next().mainUnchanged);
}

// Whether the main view is drawn in the frame after `change` to a scene that stood still.
bool drawnAfter(const std::function<void(Frames&)>& change, Scene scene = room(), double time = 0.0) {
  Frames frames(std::move(scene));
  for (int frame = 0; frame < 3; ++frame) {
    frames.next();
  }
  EXPECT_TRUE(frames.plan.mainUnchanged);
  change(frames);
  return !frames.next(time).mainUnchanged;
}

TEST(UnchangedMain, EveryChangeThatItShowsDrawsIt) {
  Scene scene = room();
  scene.objects.push_back(at({0, 0, -4}));  // before the camera, in no mirror
  const auto after = [&](auto change) { return drawnAfter(change, scene); };
  EXPECT_TRUE(after([](Frames& f) { f.scene.objects.back().position.y += 1e-9; }));
  EXPECT_TRUE(after([](Frames& f) { f.scene.objects.back().color = glm::dvec3(0.1); }));
  EXPECT_TRUE(after([](Frames& f) { f.scene.objects.pop_back(); }));
  EXPECT_TRUE(after([](Frames& f) { f.scene.objects[seenLeft].position.y += 1e-9; })) << "in a mirror";
  EXPECT_TRUE(after([](Frames& f) { f.scene.mirrors[left].reflectance *= 0.5; }));
  EXPECT_TRUE(after([](Frames& f) { f.scene.lights[0].intensity *= 2.0; }));
  EXPECT_TRUE(after([](Frames& f) { f.scene.environment.background.x += 0.1; }));
  EXPECT_TRUE(after([](Frames& f) { f.scene.camera.position.x += 1e-9; }));
  EXPECT_FALSE(after([](Frames& f) { f.scene.objects[unseen].position.y += 1.0; }));
  EXPECT_TRUE(drawnAfter([](Frames& f) { f.scene.objects.back().spin = {0, 10, 0}; }, scene, 7.0));
  EXPECT_FALSE(drawnAfter([](Frames&) {}, scene, 7.0));
}

TEST(UnchangedMain, SettingsOfTheDisplayPassAloneDoNotDrawIt) {
  const auto after = [](auto change) { return drawnAfter([&](Frames& f) { change(f.settings); }); };
  EXPECT_FALSE(after([](Settings& s) { s.view.exposure = 2.0; }));
  EXPECT_FALSE(after([](Settings& s) { s.view.toneMap = ToneMap::aces; }));
  EXPECT_TRUE(after([](Settings& s) { s.view.samples = 1; }));
  EXPECT_TRUE(after([](Settings& s) { s.view.wireframe = true; }));
  EXPECT_TRUE(after([](Settings& s) { s.view.continuous = true; })) << "frames are wanted for what they cost";
  EXPECT_TRUE(after([](Settings& s) { s.reflection.skipUnchanged = false; }));
  EXPECT_TRUE(after([](Settings& s) { s.reflection.maxDepth = 1; }));
  EXPECT_TRUE(after([](Settings& s) { s.effects.glyphs = false; }));
  EXPECT_TRUE(after([](Settings& s) { s.debug.cullClusters = false; }));
}

TEST(UnchangedMain, ReprojectedImagesAreNotTheSameTwice) {
  Frames frames(room());
  frames.settings.reflection.updateInterval = 100;
  for (int frame = 0; frame < 6; ++frame) {
    frames.scene.camera.position.x += 1e-4;
    frames.next();
    EXPECT_FALSE(frames.plan.mainUnchanged);
  }
}

// As where a budget of passes is spent on others.
TEST(UnchangedMain, AMirrorThatLosesItsImageDrawsIt) {
  Frames frames(room());
  frames.next();
  frames.next();
  ASSERT_TRUE(frames.plan.main.mirrors[0].held);
  const SceneState state = evaluate(frames.scene, 0.0);
  FramePlan plan = frames.plan;
  const ImageSurroundings around{frames.scene, state, frames.settings, plan.projection, plan.effects, {}};
  keepMain(plan, &frames.main, around);
  EXPECT_TRUE(plan.mainUnchanged);
  plan.main.mirrors[0].held.reset();
  keepMain(plan, &frames.main, around);
  EXPECT_FALSE(plan.mainUnchanged);
}

}  // namespace
}  // namespace speculum
