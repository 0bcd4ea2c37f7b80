// Which images are reused, by the planner alone: with reflection.skip_unchanged, then with an update_interval.
#include "plan/image_reuse.hpp"
#include "geometry/affine.hpp"
#include "image/image.hpp"
#include "plan/effects.hpp"
#include "plan/fitted_plan.hpp"
#include "plan/support.hpp"
#include "plan/target_memory.hpp"
#include "random.hpp"
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

// Under one number an instance, a mirror or the lights look the same in all frames, whatever happens in between.
TEST(SceneChanges, OneNumberMeansOneLook) {
  Random random(7);
  Scene scene = room();
  SceneChanges changes;
  std::map<std::tuple<char, int, uint64_t>, std::vector<double>> looks;
  const auto expectLook = [&](char kind, int index, uint64_t changed, const std::vector<double>& look) {
    const auto [known, isNew] = looks.try_emplace({kind, index, changed}, look);
    EXPECT_EQ(known->second, look) << kind << index;
  };
  const auto anyObject = [&]() -> Object& { return scene.objects[random.index(scene.objects.size())]; };
  const std::vector<std::function<void()>> edits = {
      [&] { anyObject().position.x = 0.25 * static_cast<double>(random.index(3)); },
      [&] { anyObject().color = glm::dvec3(0.25 * static_cast<double>(random.index(3))); },
      [&] {
        anyObject().copies = {.count = static_cast<int>(random.index(3)) + 1, .step = {1, 0, 0}};
      },
      [&] { std::swap(scene.objects.front(), scene.objects.back()); },
      [&] { scene.objects.push_back(scene.objects.front()); },
      [&] { scene.objects.resize(std::max<size_t>(scene.objects.size() - 1, 1)); },
      [&] { scene.mirrors[left].reflectance.x = 0.25 * static_cast<double>(random.index(3)); },
      [&] { std::swap(scene.mirrors[left], scene.mirrors[right]); },
      [&] { scene.lights[0].intensity = static_cast<double>(random.index(3)) + 1.0; }};
  for (int frame = 0; frame < 500; ++frame) {
    const SceneState state = evaluate(scene, 0.0);
    changes.update(scene, state);
    std::vector<double> all;
    for (size_t i = 0; i < state.instances.size(); ++i) {
      const Object& object = scene.objects[static_cast<size_t>(state.instances[i].object)];
      const std::vector<double> place{state.instances[i].center.x, state.instances[i].center.z};
      std::vector<double> look = place;
      look.push_back(object.color ? object.color->x : -1.0);
      expectLook('p', static_cast<int>(i), changes.placeChanged(static_cast<int>(i)), place);
      expectLook('i', static_cast<int>(i), changes.instanceChanged(static_cast<int>(i)), look);
      all.insert(all.end(), look.begin(), look.end());
    }
    for (size_t i = 0; i < scene.mirrors.size(); ++i) {
      const std::vector<double> look{scene.mirrors[i].position.x, scene.mirrors[i].reflectance.x};
      expectLook('m', static_cast<int>(i), changes.mirrorChanged(static_cast<int>(i)), look);
      all.insert(all.end(), look.begin(), look.end());
    }
    expectLook('l', 0, changes.lightsChanged(), {scene.lights[0].intensity});
    expectLook('a', 0, changes.anyChanged(), all);
    const uint64_t before = changes.anyChanged();
    changes.update(scene, state);
    EXPECT_EQ(changes.anyChanged(), before) << "nothing changed";
    edits[random.index(edits.size())]();
  }
}

using Mirrors = std::set<int>;
const Mirrors both{left, right};

TEST(Unchanged, StillSceneIsRenderedOnce) {
  PlanSequence frames(room());
  frames.next();
  const size_t passes = frames.plan.drawnMirrors().size();
  ASSERT_GE(passes, 3u) << "there is a mirror in a mirror";
  EXPECT_EQ(frames.rendered(), both);
  EXPECT_EQ(testing_support::reusedMirrors(frames.plan), 0u);
  for (int frame = 1; frame < 5; ++frame) {
    frames.next();
    EXPECT_TRUE(frames.plan.drawnMirrors().empty());
    EXPECT_EQ(frames.unchanged(), both);
    EXPECT_EQ(testing_support::reusedMirrors(frames.plan), passes);
    EXPECT_EQ(frames.plan.cached.size(), 2u) << "mirrors in mirrors have none";
    const auto detail = frames.plan.skipped.back().detail;
    EXPECT_EQ(std::string_view(detail),
              frame == 1 ? "image of the last frame" : "image of " + std::to_string(frame) + " frames ago");
    for (const MirrorDraw& draw : frames.plan.main().mirrors) {
      ASSERT_TRUE(draw.cached);
      EXPECT_FALSE(draw.cached->moved);
    }
  }
}

TEST(Unchanged, SwitchedOffRendersEveryImage) {
  PlanSequence frames(room());
  frames.settings.reflection.skipUnchanged = false;
  for (int frame = 0; frame < 3; ++frame) {
    EXPECT_EQ(frames.next().drawnMirrors().size(), 3u);
    EXPECT_TRUE(frames.plan.cached.empty());
  }
  frames.settings.reflection.skipUnchanged = true;
  EXPECT_EQ(frames.next().drawnMirrors().size(), 3u) << "nothing was cached";
  EXPECT_TRUE(frames.next().drawnMirrors().empty());
  frames.settings.reflection.skipUnchanged = false;
  EXPECT_EQ(frames.next().drawnMirrors().size(), 3u);
}

// The mirrors rendered in the frame after `change`; the one after that renders nothing.
Mirrors renderedAfter(const std::function<void(PlanSequence&)>& change, Scene scene = room(), double time = 0.0) {
  PlanSequence frames(std::move(scene));
  frames.next();
  frames.next();
  EXPECT_TRUE(frames.plan.drawnMirrors().empty());
  change(frames);
  frames.next(time);
  Mirrors rendered = frames.rendered();
  frames.next(time);
  EXPECT_TRUE(frames.plan.drawnMirrors().empty());
  return rendered;
}

TEST(Unchanged, OnlyMirrorsShowingAChangeAreRendered) {
  const auto after = [](auto change) { return renderedAfter([&](PlanSequence& f) { change(f.scene); }); };
  const auto moving = [&](int object) {
    return after([&](Scene& s) { s.objects[static_cast<size_t>(object)].position.y += 1e-9; });
  };
  EXPECT_EQ(moving(seenLeft), Mirrors{left});
  EXPECT_EQ(moving(seenRight), Mirrors{right});
  EXPECT_EQ(moving(unseen), Mirrors{});
  EXPECT_EQ(moving(seenTwice), Mirrors{right}) << "seen in the mirror behind the camera";
  EXPECT_EQ(after([](Scene& s) { s.objects[seenLeft].color = glm::dvec3(0.1); }), Mirrors{left});
  EXPECT_EQ(after([](Scene& s) { s.objects[seenRight].shininess = 3.0; }), Mirrors{right});
  EXPECT_EQ(after([](Scene& s) { s.objects[seenRight].specular = glm::dvec3(0.1); }), Mirrors{right});
  EXPECT_EQ(after([](Scene& s) { s.objects.push_back(objectAt({-2.5, 0.1, -2.9})); }), Mirrors{left});
  EXPECT_EQ(after([](Scene& s) { s.objects.erase(s.objects.begin()); }), both) << "others have another index then";
  EXPECT_EQ(after([](Scene& s) { s.mirrors[left].position.z -= 1e-9; }), Mirrors{left});
  EXPECT_EQ(after([](Scene& s) { s.mirrors[behind].position.z += 1e-9; }), Mirrors{right});
  EXPECT_EQ(after([](Scene& s) { s.mirrors[behind].reflectance *= 0.5; }), Mirrors{right});
  EXPECT_EQ(after([](Scene& s) { s.mirrors[behind].baseColor = glm::dvec3(0.5); }), Mirrors{right});
  EXPECT_EQ(after([](Scene& s) { s.lights[0].position.x += 1e-9; }), both);
  EXPECT_EQ(after([](Scene& s) { s.lights[0].intensity *= 2.0; }), both);
  EXPECT_EQ(after([](Scene& s) { s.lights[0].glow = 1.0; }), both);
  EXPECT_EQ(after([](Scene& s) { s.lights.push_back({}); }), both);
  EXPECT_EQ(after([](Scene& s) { s.camera.position.x += 1e-9; }), both);
  EXPECT_EQ(after([](Scene& s) { s.camera.verticalFov += 1e-9; }), both);
  EXPECT_EQ(after([](Scene& s) { s.environment.background.x += 0.1; }), both);
  EXPECT_EQ(after([](Scene& s) { s.environment.ambient.x += 0.1; }), both);
  EXPECT_EQ(after([](Scene& s) { s.environment.sky.emplace(); }), both);
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
  EXPECT_TRUE(still.next(7.0).drawnMirrors().empty());
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
  ASSERT_TRUE(frames.plan.main().instances.empty() || std::ranges::count(frames.plan.main().instances, seenTwice) == 0);
  const std::string fresh = why();
  frames.next();
  ASSERT_TRUE(frames.plan.drawnMirrors().empty());
  EXPECT_EQ(why(), fresh);
  EXPECT_EQ(fresh, "object 3");
}

TEST(Effects, SayWhatSmoothsEdges) {
  PlanSequence frames(room());
  frames.settings.reflection.samples = 1;
  for (const auto& [samples, pictures, why] : {std::tuple(4, 1, "view.samples = 4"),
                                               {1, 1, "one sample a pixel"},
                                               {1, 64, "the mean of pictures smooths edges"}}) {
    frames.settings.view.samples = samples;
    frames.settings.view.accumulate = pictures;
    frames.next();
    EXPECT_EQ(effectsOf(frames.scene, evaluate(frames.scene, 0.0), frames.settings,
                        frames.plan)[static_cast<size_t>(EffectKind::msaa)]
                  .why,
              why);
  }
}

TEST(Effects, SayWhichSettingLeavesThemOut) {
  PlanSequence frames(room());
  frames.scene.lights[0].castsShadow = true;
  for (const bool on : {true, false}) {
    frames.settings.effects.shadows = frames.settings.effects.glyphs = on;
    frames.next();
    const std::vector<Effect> effects =
        effectsOf(frames.scene, evaluate(frames.scene, 0.0), frames.settings, frames.plan);
    const Effect& shadows = effects[static_cast<size_t>(EffectKind::shadows)];
    EXPECT_EQ(shadows.calledFor, on);
    EXPECT_EQ(shadows.why, on ? "light 0" : "effects.shadows = false");
    EXPECT_EQ(effects[static_cast<size_t>(EffectKind::glyphs)].why == "effects.glyphs = false", !on);
    EXPECT_EQ(effects[static_cast<size_t>(EffectKind::ripple)].why, "no visible mirror has ripples");
  }
}

// The budget of passes is not spent on deeper reflections while images are reused, because those would flicker.
TEST(Unchanged, BudgetIgnoresReuse) {
  for (const int interval : {1, 2}) {
    PlanSequence frames(room(), interval);
    frames.scene.mirrors[left].rotation.y = 30.0;  // the third mirror is seen in both
    ASSERT_EQ(frames.next().drawnMirrors().size(), 4u);
    frames.settings.reflection.maxPasses = 3;
    std::set<MirrorPath> paths;
    for (const Pass& pass : frames.next().drawnMirrors()) {
      paths.insert(pass.view.path);
    }
    ASSERT_EQ(paths.size(), 3u);
    for (int frame = 0; frame < 4; ++frame) {
      frames.scene.objects[frame % 2 == 0 ? seenLeft : seenRight].shininess = 2.0 + frame;
      frames.next();
      for (const Pass& pass : frames.plan.drawnMirrors()) {
        EXPECT_TRUE(paths.count(pass.view.path));
      }
      EXPECT_EQ(frames.plan.drawnMirrors().size() + testing_support::reusedMirrors(frames.plan), 3u);
    }
  }
}

TEST(Unchanged, IntervalRendersOnlyWhatChanged) {
  PlanSequence frames(room());
  frames.settings.reflection.updateInterval = 3;
  frames.next();
  for (int frame = 1; frame < 9; ++frame) {
    EXPECT_TRUE(frames.next().drawnMirrors().empty()) << "frame " << frame;
    EXPECT_EQ(std::string_view(frames.plan.skipped.back().detail),
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
    const SceneState state = evaluate(scene, 0.0);
    changes.update(scene, state);
    return planWithin({.budgetBytes = budget, .largestSide = 4096},
                      {scene, state, {}, {width, height}, {.images = cached, .changes = &changes}});
  };
  const FittedPlan first = fit(1ull << 40, {});
  const uint64_t needed = targetBytes(first.plan, first.settings);
  scene.objects[seenLeft].color = glm::dvec3(0.5);
  const FittedPlan mixed = fit(1ull << 40, first.plan.cached);
  ASSERT_LT(mixed.plan.drawnMirrors().size(), first.plan.drawnMirrors().size());
  ASSERT_FALSE(mixed.plan.drawnMirrors().empty());
  const uint64_t more = targetBytes(mixed.plan, mixed.settings);
  ASSERT_GT(more, needed) << "the case is not met";
  const FittedPlan fitted = fit(needed, first.plan.cached);
  EXPECT_EQ(fitted.plan.drawnMirrors().size(), first.plan.drawnMirrors().size());
  EXPECT_EQ(fitted.settings.reflection, first.settings.reflection);
  EXPECT_TRUE(fitted.message.empty()) << fitted.message;
}

// The frame that renders the mirrors cannot reuse the main view; nor can the one after it, which shows new images.
TEST(MainView, IsReusedOneFrameAfterItsMirrors) {
  PlanSequence frames(room());
  EXPECT_FALSE(frames.next().mainReused());
  EXPECT_TRUE(frames.plan.mainContent.empty());
  EXPECT_FALSE(frames.next().mainReused());
  for (int frame = 2; frame < 5; ++frame) {
    EXPECT_TRUE(frames.next().mainReused()) << "frame " << frame;
  }
  frames.scene.mirrors.clear();
  EXPECT_FALSE(frames.next().mainReused());
  EXPECT_TRUE(frames.next().mainReused());
}

// Says whether the main view is drawn in the frame after `change` to a scene that stood still.
bool drawnAfter(const std::function<void(PlanSequence&)>& change, Scene scene = room(), double time = 0.0) {
  PlanSequence frames(std::move(scene));
  for (int frame = 0; frame < 3; ++frame) {
    frames.next();
  }
  EXPECT_TRUE(frames.plan.mainReused());
  change(frames);
  return !frames.next(time).mainReused();
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
    EXPECT_FALSE(frames.plan.mainReused());
  }
}

// A mirror that loses its image to the budget of passes changes the main view.
TEST(MainView, MirrorsThatLoseTheirImageDrawIt) {
  PlanSequence frames(room());
  frames.next();
  frames.next();
  ASSERT_TRUE(frames.plan.main().mirrors[0].cached);
  const SceneState state = evaluate(frames.scene, 0.0);
  FramePlan plan = frames.plan;
  const ImageSurroundings around{frames.scene,    state, frames.settings, plan.projection, plan.effects,
                                 &frames.changes, {}};
  reuseMain(plan, &frames.main, around);
  EXPECT_TRUE(plan.mainReused());
  plan.main().mirrors[0].cached.reset();
  reuseMain(plan, &frames.main, around);
  EXPECT_FALSE(plan.mainReused());
}

// Six mirrors in a row before the camera, which stands at the origin and looks along -z.
Scene row() {
  Scene scene = sceneWith({});
  for (int i = 0; i < 6; ++i) {
    scene.mirrors.push_back(wall({i - 2.5, 0, -5}, 0, {0.8, 1.5}));
  }
  return scene;
}

// Plans frame after frame with an interval, whether or not anything changes.
PlanSequence withInterval(Scene scene, int interval) {
  return PlanSequence(std::move(scene), interval, false);
}

RecycledString firstUnchanged(const FramePlan& plan) {
  const auto it = std::ranges::find(plan.skipped, SkipReason::unchanged, &SkippedMirror::reason);
  return it == plan.skipped.end() ? "" : it->detail;
}

TEST(CachedImages, MirrorsTakeTurnsAfterTheFirstFrame) {
  for (const double step : {0.0, 0.002}) {
    PlanSequence sequence = withInterval(row(), 3);
    std::map<int, std::vector<int>> frames;  // by mirror: frames in which it had a pass
    for (int frame = 0; frame < 15; ++frame) {
      sequence.next();
      ASSERT_EQ(sequence.plan.cached.size(), 6u);
      EXPECT_EQ(sequence.plan.drawnMirrors().size() + count(sequence.plan, SkipReason::unchanged), 6u);
      if (frame == 0) {
        EXPECT_EQ(sequence.plan.drawnMirrors().size(), 6u);
      } else if (frame > 1) {
        EXPECT_EQ(sequence.plan.drawnMirrors().size(), 2u) << "frame " << frame << ", step " << step;
      }
      for (const Pass& pass : sequence.plan.drawnMirrors()) {
        frames[pass.view.path[0]].push_back(frame);
      }
      sequence.moveCamera({step, 0, 0});
    }
    for (const auto& [mirror, fresh] : frames) {
      for (size_t i = 1; i < fresh.size(); ++i) {
        if (fresh[i - 1] >= 3) {
          EXPECT_EQ(fresh[i] - fresh[i - 1], 3) << "mirror " << mirror << ", step " << step;
        }
      }
    }
  }
}

TEST(CachedImages, ReusedImagesAreListedWithTheirAge) {
  PlanSequence sequence = withInterval(row(), 4);
  sequence.next();
  sequence.next();
  ASSERT_EQ(count(sequence.plan, SkipReason::unchanged), 5) << "the fourth mirror comes due after one frame";
  EXPECT_EQ(firstUnchanged(sequence.plan), "image of the last frame");
  for (const MirrorDraw& draw : sequence.plan.main().mirrors) {
    EXPECT_NE(draw.cached.has_value(), draw.pass >= 0);
    EXPECT_FALSE(draw.cached && draw.cached->moved) << "nothing moved";
  }
  sequence.moveCamera({0.001, 0, 0});
  sequence.next();  // the first images had no margin
  EXPECT_EQ(sequence.plan.drawnMirrors().size(), 6u);
  sequence.moveCamera({0.001, 0, 0});
  sequence.next();
  ASSERT_GT(count(sequence.plan, SkipReason::unchanged), 0);
  EXPECT_EQ(firstUnchanged(sequence.plan), "image of the last frame, reprojected");
  for (const MirrorDraw& draw : sequence.plan.main().mirrors) {
    if (draw.cached) {
      EXPECT_TRUE(draw.cached->moved);
      EXPECT_EQ(sequence.plan.cached[static_cast<size_t>(draw.cached->image)].mirror, draw.mirror);
    }
  }
}

TEST(CachedImages, NestedMirrorsAreRenderedWithTheirParent) {
  PlanSequence sequence = withInterval(corridor(), 3);
  const size_t whole = sequence.next().drawnMirrors().size();
  EXPECT_EQ(whole, 4u);
  EXPECT_EQ(sequence.plan.cached.size(), 1u) << "mirrors in mirrors have none";
  const int deeper = count(sequence.plan, SkipReason::maxDepth);
  EXPECT_GT(deeper, 0);
  for (int frame = 1; frame < 7; ++frame) {
    sequence.next();
    EXPECT_EQ(sequence.plan.drawnMirrors().size(), frame % 3 == 0 ? whole : 0u) << "frame " << frame;
    EXPECT_EQ(count(sequence.plan, SkipReason::unchanged), frame % 3 == 0 ? 0 : 1);
    EXPECT_EQ(count(sequence.plan, SkipReason::maxDepth), frame % 3 == 0 ? deeper : 0)
        << "nothing seen in a reused image is listed";
  }
}

// frame_settings.cpp tests which settings images show.
TEST(CachedImages, ChangedSettingsAndSizesRenderAnew) {
  const auto freshAfter = [](auto change) {
    PlanSequence sequence = withInterval(row(), 100);
    sequence.next();
    change(sequence.settings);
    return sequence.next().drawnMirrors().size();
  };
  EXPECT_EQ(freshAfter([](Settings&) {}), 0u);
  EXPECT_EQ(freshAfter([](Settings& s) { s.view.exposure = 2.0; }), 0u);
  EXPECT_EQ(freshAfter([](Settings& s) { s.reflection.scale = 0.5; }), 6u);
  EXPECT_EQ(freshAfter([](Settings& s) { s.reflection.updateInterval = 1; }), 6u);

  PlanSequence sequence = withInterval(row(), 100);
  sequence.next();
  const FramePlan larger = planFrame({sequence.scene,
                                      evaluate(sequence.scene, 0.0),
                                      sequence.settings,
                                      {width + 1, height},
                                      {.images = sequence.plan.cached}});
  EXPECT_EQ(larger.drawnMirrors().size(), 6u);
}

TEST(CachedImages, CutsRenderAnewAndForgetUnseenMirrors) {
  PlanSequence sequence = withInterval(row(), 100);
  sequence.next();
  sequence.next();
  sequence.moveCamera({0.5, 0, 0});
  sequence.next();
  EXPECT_EQ(count(sequence.plan, SkipReason::unchanged), 0);
  sequence.moveCamera({50, 0, 0});
  EXPECT_TRUE(sequence.next().cached.empty());
  sequence.moveCamera({-50, 0, 0});
  sequence.next();
  EXPECT_EQ(sequence.plan.drawnMirrors().size(), 6u);
  EXPECT_EQ(sequence.plan.cached.size(), 6u);
}

// A reused image covers every ray through the mirror's visible region, at every distance.
TEST(CachedImages, ReusedImagesCoverTheVisibleRegion) {
  int reprojected = 0;
  for (int seed = 0; seed < 40; ++seed) {
    PlanSequence sequence = withInterval(row(), 5);
    for (int frame = 0; frame < 12; ++frame) {
      const double t = 0.01 * frame * (1 + seed % 7);
      sequence.scene.camera.position = {std::sin(seed + t), 0.3 * std::sin(2.0 * seed + t), -t};
      sequence.scene.camera.target = sequence.scene.camera.position + glm::dvec3(0.3 * std::sin(t), 0, -1);
      const FramePlan& plan = sequence.next();
      for (const MirrorDraw& draw : plan.main().mirrors) {
        ASSERT_TRUE(draw.cached || draw.pass >= 0 || count(plan, SkipReason::minPixels) > 0);
        if (!draw.cached || !draw.cached->moved) {
          continue;
        }
        ++reprojected;
        const CachedImage& image = plan.cached[static_cast<size_t>(draw.cached->image)];
        for (const glm::dvec3& corner : visiblePart(plan.main().view, draw.polygon)) {
          const glm::dvec4 clip = plan.projection.clip(plan.main().view.worldToView * (corner - plan.main().view.eye));
          const glm::dvec2 pixel = (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * plan.main().view.pictureSize;
          for (const double part : {0.0, 0.01, 0.1, 0.5, 1.0}) {
            const glm::dvec3 texel = draw.cached->texelFromPixel * glm::dvec3(pixel, 1.0) +
                                     draw.cached->texelFromDisparity * (part / clip.w);
            ASSERT_GT(texel.z, 0.0);
            const glm::dvec2 place = glm::dvec2(texel) / texel.z;
            EXPECT_GE(std::min(place.x, place.y), 0.4999);
            EXPECT_LE(place.x, image.view.rect.width - 0.4999);
            EXPECT_LE(place.y, image.view.rect.height - 0.4999);
          }
        }
      }
    }
  }
  EXPECT_GT(reprojected, 200) << "too few to judge by";
}

// The lookup finds a point's texel when the camera, the mirror or both have moved.
TEST(CachedImages, LookupFindsThePointInTheImage) {
  const Projection projection(1.0, 1.5, 0.001);
  const auto mirrorView = [&](const glm::dvec3& eye, const glm::dvec3& target, double yaw, View& parent) {
    parent = mainView(lookAt(eye, target, {0, 1, 0}, 57.3, 0.001), projection, 600, 400);
    const Plane plane{{1e6, 0, -3}, rotationFromDegrees({3, yaw, 0})[2]};
    return reflectedView(parent, 0, plane, {}, {-20, 30, 500, 300}, {300, 200});
  };
  View parentThen;
  View parentNow;
  const View then = mirrorView({1e6, 1, 2}, {1e6, 0, -3}, 5.0, parentThen);
  const View now = mirrorView({1e6 + 0.1, 1.05, 2.1}, {1e6 + 0.2, 0, -3}, 6.0, parentNow);
  const CachedLookup lookup = cachedLookup({.view = then, .projection = projection}, parentNow, now, projection);
  for (const glm::dvec3& point : {glm::dvec3(1e6, 0.5, 4), glm::dvec3(1e6 + 2, 1, 0), glm::dvec3(1e6 - 50, 9, 200)}) {
    const glm::dvec4 clipNow = projection.clip(now.worldToView * (point - now.eye));
    const glm::dvec4 clipThen = projection.clip(then.worldToView * (point - then.eye));
    const glm::dvec2 pixel = (glm::dvec2(clipNow) / clipNow.w * 0.5 + 0.5) * parentNow.pictureSize;
    const glm::dvec2 expected =
        (glm::dvec2(clipThen) / clipThen.w * 0.5 + 0.5) * then.pictureSize - glm::dvec2(then.rect.x, then.rect.y);
    const glm::dvec3 texel =
        lookup.texelFromPixel * glm::dvec3(pixel, 1.0) + lookup.texelFromDisparity * (1.0 / clipNow.w);
    EXPECT_NEAR(texel.x / texel.z, expected.x, 1e-6);
    EXPECT_NEAR(texel.y / texel.z, expected.y, 1e-6);
    EXPECT_NEAR(texel.z, clipThen.w / clipNow.w, 1e-9);
  }
}

TEST(CachedImages, MarginFollowsTheMotion) {
  PlanSequence sequence = withInterval(corridor(), 6);
  const PixelRect plain = sequence.next().drawnMirrors().back().view.rect;
  sequence.moveCamera({0.01, 0, 0});
  const PixelRect slow = sequence.next().drawnMirrors().back().view.rect;
  EXPECT_GT(slow.width, plain.width + 2);
  EXPECT_LT(slow.width, plain.width + 60);
  EXPECT_LE(slow.height, plain.height + 2 * largestMargin * height + 2);
  for (int frame = 0; frame < 12; ++frame) {
    sequence.next();
  }
  EXPECT_EQ(sequence.plan.cached[0].view.rect.height, plain.height) << "two turns after the motion there is none";
}

TEST(CachedImages, MemoryIncludesReusedImages) {
  PlanSequence sequence = withInterval(corridor(), 3);
  sequence.next();
  const uint64_t image = static_cast<uint64_t>(sequence.plan.cached[0].view.rect.area()) * 4 * 8;
  const FramePlan reused = sequence.next();
  ASSERT_TRUE(reused.drawnMirrors().empty());
  FramePlan without = reused;
  without.cached.clear();
  EXPECT_EQ(targetBytes(reused, sequence.settings), targetBytes(without, sequence.settings) + image);
}

TEST(CachedImages, MarginsStayWithinTheLargestSide) {
  Scene scene = corridor();
  Settings settings;
  settings.reflection.updateInterval = 4;
  RecycledVector<CachedImage> cached;
  for (int frame = 0; frame < 8; ++frame) {
    const FittedPlan fitted = planWithin({.budgetBytes = 1ull << 40, .largestSide = width},
                                         {scene, evaluate(scene, 0.0), settings, {width, height}, {.images = cached}});
    for (const Pass& pass : fitted.plan.drawnMirrors()) {
      EXPECT_LE((overscan(pass.view) * pass.view.pictureSize).x, width);
      EXPECT_LE(pass.view.rect.width, width);
    }
    cached = fitted.plan.cached;
    scene.camera.position.z -= 0.3;
  }
}

}  // namespace
}  // namespace speculum
