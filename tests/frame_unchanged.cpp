// reflection.skip_unchanged: which images are reused, by the planner alone.
#include "frame/effects.hpp"
#include "frame/image_reuse.hpp"
#include "frame/memory_fit.hpp"
#include "frame_support.hpp"
#include "image/color.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

using namespace testing_support;

enum { left, right, behind };                     // mirrors
enum { seenLeft, seenRight, unseen, seenTwice };  // objects

// Two mirrors side by side before the camera, which looks along -z; what they show stands before them. A third mirror
// behind the camera is seen in the right one only, and with it an object that stands between the two.
Scene room() {
  Scene scene =
      sceneWith({wall({-1.5, 0, -3}, -30, {1, 1}), wall({1.5, 0, -3}, 0, {1, 1}), wall({4.5, 0, 3}, 180, {3, 3})});
  scene.meshes = {cube(0.2, 0.2)};
  scene.objects = {objectAt({-2.5, 0, -2.9}), objectAt({1.6, 0.3, -2}), objectAt({0, 30, 0}), objectAt({3.2, 0, 1})};
  scene.lights = {{.position = {0, 2, 0}, .glow = 0.0}};
  return scene;
}

using Mirrors = std::set<int>;
const Mirrors both{left, right};

TEST(Unchanged, StillSceneIsRenderedOnce) {
  PlanSequence frames(room());
  frames.next();
  const size_t passes = frames.plan.passes.size();
  ASSERT_GE(passes, 3u) << "there is a mirror in a mirror";
  EXPECT_EQ(frames.rendered(), both);
  EXPECT_TRUE(frames.plan.reused.empty());
  for (int frame = 1; frame < 5; ++frame) {
    frames.next();
    EXPECT_TRUE(frames.plan.passes.empty());
    EXPECT_EQ(frames.unchanged(), both);
    EXPECT_EQ(frames.plan.reused.size(), passes);
    EXPECT_EQ(frames.plan.cached.size(), 2u) << "mirrors in mirrors have none";
    const std::string detail = frames.plan.skipped.back().detail;
    EXPECT_EQ(detail, frame == 1 ? "image of the last frame" : "image of " + std::to_string(frame) + " frames ago");
    for (const MirrorDraw& draw : frames.plan.main.mirrors) {
      ASSERT_TRUE(draw.cached);
      EXPECT_FALSE(draw.cached->moved);
    }
  }
}

TEST(Unchanged, SwitchedOffRendersEveryImage) {
  PlanSequence frames(room());
  frames.settings.reflection.skipUnchanged = false;
  for (int frame = 0; frame < 3; ++frame) {
    EXPECT_EQ(frames.next().passes.size(), 3u);
    EXPECT_TRUE(frames.plan.cached.empty());
  }
  frames.settings.reflection.skipUnchanged = true;
  EXPECT_EQ(frames.next().passes.size(), 3u) << "nothing was cached";
  EXPECT_TRUE(frames.next().passes.empty());
  frames.settings.reflection.skipUnchanged = false;
  EXPECT_EQ(frames.next().passes.size(), 3u);
}

// The mirrors rendered in the frame after `change`; the one after that renders nothing.
Mirrors renderedAfter(const std::function<void(PlanSequence&)>& change, Scene scene = room(), double time = 0.0) {
  PlanSequence frames(std::move(scene));
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

TEST(Unchanged, OnlyMirrorsShowingAChangeAreRendered) {
  const auto moving = [](int object) {
    return [object](PlanSequence& f) { f.scene.objects[static_cast<size_t>(object)].position.y += 1e-9; };
  };
  EXPECT_EQ(renderedAfter(moving(seenLeft)), Mirrors{left});
  EXPECT_EQ(renderedAfter(moving(seenRight)), Mirrors{right});
  EXPECT_EQ(renderedAfter(moving(unseen)), Mirrors{});
  EXPECT_EQ(renderedAfter(moving(seenTwice)), Mirrors{right}) << "seen in the mirror behind the camera";
  EXPECT_EQ(renderedAfter([](PlanSequence& f) { f.scene.mirrors[left].position.z -= 1e-9; }), Mirrors{left});
  EXPECT_EQ(renderedAfter([](PlanSequence& f) { f.scene.mirrors[behind].position.z += 1e-9; }), Mirrors{right});
  EXPECT_EQ(renderedAfter([](PlanSequence& f) { f.scene.lights[0].position.x += 1e-9; }), both);
  EXPECT_EQ(renderedAfter([](PlanSequence& f) { f.scene.camera.position.x += 1e-9; }), both);
  EXPECT_EQ(renderedAfter([](PlanSequence& f) { f.scene.camera.verticalFov += 1e-9; }), both);
}

TEST(Unchanged, EditsRenderTheMirrorsThatShowThem) {
  EXPECT_EQ(renderedAfter([](PlanSequence& f) { f.scene.objects[seenLeft].color = glm::dvec3(0.1); }), Mirrors{left});
  EXPECT_EQ(renderedAfter([](PlanSequence& f) { f.scene.objects[seenRight].shininess = 3.0; }), Mirrors{right});
  EXPECT_EQ(renderedAfter([](PlanSequence& f) { f.scene.objects[seenRight].specular = glm::dvec3(0.1); }),
            Mirrors{right});
  EXPECT_EQ(renderedAfter([](PlanSequence& f) {
              f.scene.objects.push_back(objectAt({-2.5, 0.1, -2.9}));
            }),
            Mirrors{left});
  EXPECT_EQ(renderedAfter([](PlanSequence& f) { f.scene.objects.erase(f.scene.objects.begin()); }), both)
      << "others have another index then";
  EXPECT_EQ(renderedAfter([](PlanSequence& f) { f.scene.mirrors[behind].reflectance *= 0.5; }), Mirrors{right});
  EXPECT_EQ(renderedAfter([](PlanSequence& f) { f.scene.mirrors[behind].baseColor = glm::dvec3(0.5); }),
            Mirrors{right});
  EXPECT_EQ(renderedAfter([](PlanSequence& f) { f.scene.lights[0].intensity *= 2.0; }), both);
  EXPECT_EQ(renderedAfter([](PlanSequence& f) { f.scene.lights[0].glow = 1.0; }), both);
  EXPECT_EQ(renderedAfter([](PlanSequence& f) { f.scene.lights.push_back({}); }), both);
  EXPECT_EQ(renderedAfter([](PlanSequence& f) { f.scene.environment.background.x += 0.1; }), both);
  EXPECT_EQ(renderedAfter([](PlanSequence& f) { f.scene.environment.ambient.x += 0.1; }), both);
  EXPECT_EQ(renderedAfter([](PlanSequence& f) { f.scene.environment.sky.emplace(); }), both);
}

// frame_settings.cpp tests which settings images show.
TEST(Unchanged, SettingsThatImagesShowRenderThemAnew) {
  const auto after = [](auto change) { return renderedAfter([&](PlanSequence& f) { change(f.settings); }); };
  EXPECT_EQ(after([](Settings& s) { s.view.exposure = 2.0; }), Mirrors{});
  EXPECT_EQ(after([](Settings& s) { s.reflection.updateInterval = 3; }), Mirrors{});
  EXPECT_EQ(after([](Settings& s) { s.reflection.scale = 0.5; }), both);
  EXPECT_EQ(after([](Settings& s) { s.debug.checkFinite = true; }), both) << "they were not searched";
  EXPECT_EQ(after([](Settings& s) { s.debug.maskPasses = false; }), both);
}

TEST(Unchanged, TimeCountsWhereSomethingDependsOnIt) {
  const auto nothing = [](PlanSequence&) {};
  EXPECT_EQ(renderedAfter(nothing, room(), 7.0), Mirrors{});
  Scene scene = room();
  scene.objects[seenLeft].spin = {0, 10, 0};
  EXPECT_EQ(renderedAfter(nothing, scene, 7.0), Mirrors{left});
  scene = room();
  scene.mirrors[behind].ripple = Ripple{.amplitude = 0.01};
  EXPECT_EQ(renderedAfter(nothing, scene, 7.0), both) << "rays may meet the waves anywhere";
  EXPECT_EQ(renderedAfter([](PlanSequence& f) { f.scene.objects[unseen].position.y += 1.0; }, scene), both);
  scene.mirrors[behind].ripple->speed = 0.0;
  EXPECT_EQ(renderedAfter(nothing, scene, 7.0), Mirrors{});
  scene.mirrors[behind].ripple->speed = 0.2;
  PlanSequence still(scene);
  still.settings.effects.ripple = false;
  still.next();
  EXPECT_TRUE(still.next(7.0).passes.empty());
}

TEST(Unchanged, ShadowsDependOnTheWholeScene) {
  Scene scene = room();
  scene.lights[0].castsShadow = true;
  EXPECT_EQ(renderedAfter([](PlanSequence& f) { f.scene.objects[unseen].position.y += 1e-9; }, scene), both);
  EXPECT_EQ(renderedAfter([](PlanSequence& f) { f.scene.camera.position.x += 0.0; }, scene), Mirrors{});
}

TEST(Unchanged, ReusedImagesCallForTheirEffects) {
  PlanSequence frames(room());
  frames.scene.objects[seenTwice].mirror.emplace();
  frames.scene.objects[seenTwice].position = {3.2, 0, 1.5};
  const auto why = [&] {
    return effectsOf(frames.scene, evaluate(frames.scene, 0.0), frames.settings,
                     frames.plan)[static_cast<size_t>(EffectKind::curved)]
        .why;
  };
  frames.next();
  ASSERT_TRUE(frames.plan.main.instances.empty() || std::ranges::count(frames.plan.main.instances, seenTwice) == 0);
  const std::string fresh = why();
  frames.next();
  ASSERT_TRUE(frames.plan.passes.empty());
  EXPECT_EQ(why(), fresh);
  EXPECT_EQ(fresh, "object 3");
}

// The budget of passes is not spent on deeper reflections while images are reused, because those would flicker.
TEST(Unchanged, BudgetIgnoresReuse) {
  for (const int interval : {1, 2}) {
    PlanSequence frames(room(), interval);
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
      EXPECT_EQ(frames.plan.passes.size() + frames.plan.reused.size(), 3u);
    }
  }
}

TEST(Unchanged, IntervalRendersOnlyWhatChanged) {
  PlanSequence frames(room());
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

// Cached images take memory from the start of a frame, when its own images need the most.
TEST(Unchanged, ShortMemoryRendersAnewRatherThanWorse) {
  Scene scene = room();
  scene.mirrors[left] = wall({-2.5, 0, -5}, 0, {4.9, 5});
  scene.mirrors[right] = wall({2.5, 0, -5}, 0, {3, 3});
  scene.mirrors[behind] = wall({0, 0, 3}, 180, {12, 6});
  scene.objects[seenLeft].position = {-2.4, 0, -4};
  SceneChanges changes;
  const auto fit = [&](uint64_t budget, std::span<const CachedImage> cached) {
    return planWithin({.budgetBytes = budget, .largestSide = 4096}, scene, evaluate(scene, 0.0), {}, width, height,
                      {.images = cached, .changes = &changes});
  };
  const FittedPlan first = fit(1ull << 40, {});
  const uint64_t needed = targetBytes(first.plan, first.settings);
  scene.objects[seenLeft].color = glm::dvec3(0.5);
  const FittedPlan mixed = fit(1ull << 40, first.plan.cached);
  ASSERT_LT(mixed.plan.passes.size(), first.plan.passes.size());
  ASSERT_FALSE(mixed.plan.passes.empty());
  const uint64_t more = targetBytes(mixed.plan, mixed.settings);
  ASSERT_GT(more, needed) << "the case is not met";
  const FittedPlan fitted = fit(needed, first.plan.cached);
  EXPECT_EQ(fitted.plan.passes.size(), first.plan.passes.size());
  EXPECT_EQ(fitted.settings.reflection, first.settings.reflection);
  EXPECT_TRUE(fitted.message.empty()) << fitted.message;
}

// The frame that renders the mirrors cannot reuse the main view; nor can the one after it, which shows new images.
TEST(MainView, IsReusedOneFrameAfterItsMirrors) {
  PlanSequence frames(room());
  EXPECT_FALSE(frames.next().mainReused);
  EXPECT_TRUE(frames.plan.mainContent.empty());
  EXPECT_FALSE(frames.next().mainReused);
  for (int frame = 2; frame < 5; ++frame) {
    EXPECT_TRUE(frames.next().mainReused) << "frame " << frame;
  }
  frames.scene.mirrors.clear();
  EXPECT_FALSE(frames.next().mainReused);
  EXPECT_TRUE(frames.next().mainReused);
}

// Says whether the main view is drawn in the frame after `change` to a scene that stood still.
bool drawnAfter(const std::function<void(PlanSequence&)>& change, Scene scene = room(), double time = 0.0) {
  PlanSequence frames(std::move(scene));
  for (int frame = 0; frame < 3; ++frame) {
    frames.next();
  }
  EXPECT_TRUE(frames.plan.mainReused);
  change(frames);
  return !frames.next(time).mainReused;
}

TEST(MainView, VisibleChangesDrawIt) {
  Scene scene = room();
  scene.objects.push_back(objectAt({0, 0, -4}));  // before the camera, in no mirror
  const auto after = [&](auto change) { return drawnAfter(change, scene); };
  EXPECT_TRUE(after([](PlanSequence& f) { f.scene.objects.back().position.y += 1e-9; }));
  EXPECT_TRUE(after([](PlanSequence& f) { f.scene.objects.back().color = glm::dvec3(0.1); }));
  EXPECT_TRUE(after([](PlanSequence& f) { f.scene.objects.pop_back(); }));
  EXPECT_TRUE(after([](PlanSequence& f) { f.scene.objects[seenLeft].position.y += 1e-9; })) << "in a mirror";
  EXPECT_TRUE(after([](PlanSequence& f) { f.scene.mirrors[left].reflectance *= 0.5; }));
  EXPECT_TRUE(after([](PlanSequence& f) { f.scene.lights[0].intensity *= 2.0; }));
  EXPECT_TRUE(after([](PlanSequence& f) { f.scene.environment.background.x += 0.1; }));
  EXPECT_TRUE(after([](PlanSequence& f) { f.scene.camera.position.x += 1e-9; }));
  EXPECT_FALSE(after([](PlanSequence& f) { f.scene.objects[unseen].position.y += 1.0; }));
  EXPECT_TRUE(drawnAfter([](PlanSequence& f) { f.scene.objects.back().spin = {0, 10, 0}; }, scene, 7.0));
  EXPECT_FALSE(drawnAfter([](PlanSequence&) {}, scene, 7.0));
}

TEST(MainView, DisplaySettingsAloneReuseIt) {
  const auto after = [](auto change) { return drawnAfter([&](PlanSequence& f) { change(f.settings); }); };
  EXPECT_FALSE(after([](Settings& s) { s.view.exposure = 2.0; }));
  EXPECT_TRUE(after([](Settings& s) { s.view.samples = 1; }));
  EXPECT_TRUE(after([](Settings& s) { s.view.continuous = true; })) << "frames are wanted for what they cost";
  EXPECT_TRUE(after([](Settings& s) { s.reflection.skipUnchanged = false; }));
  EXPECT_TRUE(after([](Settings& s) { s.debug.cullClusters = false; }));
}

TEST(MainView, ReprojectedImagesDrawIt) {
  PlanSequence frames(room());
  frames.settings.reflection.updateInterval = 100;
  for (int frame = 0; frame < 6; ++frame) {
    frames.scene.camera.position.x += 1e-4;
    frames.next();
    EXPECT_FALSE(frames.plan.mainReused);
  }
}

// A mirror that loses its image to the budget of passes changes the main view.
TEST(MainView, MirrorsThatLoseTheirImageDrawIt) {
  PlanSequence frames(room());
  frames.next();
  frames.next();
  ASSERT_TRUE(frames.plan.main.mirrors[0].cached);
  const SceneState state = evaluate(frames.scene, 0.0);
  FramePlan plan = frames.plan;
  const ImageSurroundings around{frames.scene,    state, frames.settings, plan.projection, plan.effects,
                                 &frames.changes, {}};
  reuseMain(plan, &frames.main, around);
  EXPECT_TRUE(plan.mainReused);
  plan.main.mirrors[0].cached.reset();
  reuseMain(plan, &frames.main, around);
  EXPECT_FALSE(plan.mainReused);
}

}  // namespace
}  // namespace speculum
