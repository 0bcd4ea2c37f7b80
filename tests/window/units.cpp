// Parts of the window that stand alone.
#include <atomic>
#include <thread>

#include "cli/commands.hpp"
#include "plan/pass_mask.hpp"
#include "plan_by_hand.hpp"
#include "platform/keys.hpp"
#include "scene/scene_loader.hpp"
#include "session/options.hpp"
#include "settings/setting_fields.hpp"
#include "temporary_folder.hpp"
#include "test_headers.hpp"
#include "window/background_job.hpp"
#include "window/camera_controller.hpp"
#include "window/difference_map.hpp"
#include "window/frame_report.hpp"
#include "window/pace.hpp"

namespace speculum {
namespace {

template <typename Done>
bool waitFor(const Done& done) {
  for (int i = 0; i < 12000 && !done(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return done();
}

TEST(DifferenceMap, ErrorsOfMirrorsAreWithinTheirOutlines) {
  Scene scene;
  scene.environment.background = glm::dvec3(1.0);
  scene.camera.target = {0, 0, -1};
  const Mirror gray{.position = {-2, 0, -4}, .size = {1.5, 1.5}, .reflectance = glm::dvec3(0.2)};
  scene.mirrors = {gray, gray, gray};
  scene.mirrors[1].position.x = 2.0;
  scene.mirrors[1].reflectance = glm::dvec3(1.0);
  scene.mirrors[2].position.z = 4.0;  // behind the eye
  const SceneState state = evaluate(scene, 0.0);
  const Settings settings;
  const ShownPicture shown{scene, state, settings, 96, 54};
  DifferenceMap difference;
  EXPECT_TRUE(difference.mirrorErrors().empty());
  const auto white = [] { return Image8(96, 54); };
  ASSERT_TRUE(waitFor([&] { return difference.update(shown, white, 4) || !difference.mirrorErrors().empty(); }));
  const std::vector<double> errors = difference.mirrorErrors();
  ASSERT_EQ(errors.size(), 3u);
  EXPECT_GT(errors[0], 0.3);
  EXPECT_LT(errors[1], 0.02) << "it shows the background, as the picture does";
  EXPECT_TRUE(std::isnan(errors[2]));
  difference.stop();
  EXPECT_TRUE(difference.mirrorErrors().empty());
}

TEST(DifferenceMap, CompleteMeanIsComparedAgain) {
  Scene scene;
  scene.environment.background = glm::dvec3(1.0);
  scene.camera.target = {0, 0, -1};
  const SceneState state = evaluate(scene, 0.0);
  Settings settings;
  settings.view.accumulate = 64;
  ShownPicture shown{scene, state, settings, 96, 54, 2, false};
  DifferenceMap difference;
  const auto statusWith = [&](uint8_t code) {
    Image8 picture(96, 54);
    std::ranges::fill(picture.rgba, code);
    bool fresh = false;
    EXPECT_TRUE(waitFor([&] {
      fresh = fresh || difference.update(
                           shown, [&] { return picture; }, 4);
      return fresh;
    }));
    return difference.status();
  };
  const std::string partial = statusWith(0);
  EXPECT_TRUE(startsWith(partial, "Mean FLIP of the mean of 2 of 64 pictures: 0.967. RMSE 1.0000")) << partial;
  shown.pictures = 3;
  difference.update(
      shown, [] { return Image8(96, 54); }, 4);
  EXPECT_FALSE(difference.working()) << "nothing to compare until it is complete";
  shown.pictures = 12;  // where it has converged
  shown.complete = true;
  const std::string complete = statusWith(255);
  EXPECT_TRUE(startsWith(complete, "Mean FLIP of the mean of 12 pictures: 0. RMSE 0.0000")) << complete;
  difference.stop();
}

TEST(DifferenceMap, OnlyAnimationsAreToBePaused) {
  Scene scene;
  scene.camera.target = {0.0, 0.0, -1.0};
  scene.lights.resize(1);
  scene.lights[0].orbit.emplace().speed = 90.0;
  DifferenceMap difference;
  const auto statusAt = [&](double time) {
    const SceneState state = evaluate(scene, time);
    difference.update(
        {scene, state, Settings(), 96, 54}, [] { return Image8(96, 54); }, 4);
    return difference.status();
  };
  EXPECT_EQ(statusAt(0.0), "Waiting for the view to stand still");
  EXPECT_EQ(statusAt(0.1), "Waiting for the view to stand still (pause the animation)");
  scene.camera.position.x += 1.0;
  EXPECT_EQ(statusAt(0.1), "Waiting for the view to stand still") << "it is paused";
  difference.stop();
}

TEST(BackgroundJob, ResultIsTakenOnce) {
  BackgroundJob<int> job;
  EXPECT_FALSE(job.busy());
  std::atomic<bool> go = false;
  job.start(0.25, [&](const auto& report) {
    while (!go) {
      std::this_thread::yield();
    }
    EXPECT_TRUE(report(0.5));
    return 7;
  });
  EXPECT_EQ(job.progress(), 0.25);
  go = true;
  ASSERT_TRUE(waitFor([&] { return job.hasResult(); }));
  EXPECT_FALSE(job.progress());
  EXPECT_FALSE(job.takeError());
  EXPECT_EQ(job.takeResult(), 7);
  EXPECT_FALSE(job.takeResult());
  EXPECT_FALSE(job.busy());
}

TEST(BackgroundJob, ExceptionsBecomeErrors) {
  BackgroundJob<int> job;
  job.start(0.0, [](const auto&) -> int { throw std::runtime_error("no disk"); });
  ASSERT_TRUE(waitFor([&] { return job.finished(); }));
  EXPECT_FALSE(job.takeResult());
  EXPECT_EQ(job.takeError(), "no disk");
  EXPECT_FALSE(job.takeError());
}

TEST(BackgroundJob, CancelledWorkIsDropped) {
  BackgroundJob<int> job;
  std::atomic<bool> ended = false;
  const auto work = [&](const auto& report) {
    while (report(0.0)) {
      std::this_thread::yield();
    }
    ended = true;
    return 1;
  };
  job.start(0.0, work);
  job.cancel();
  EXPECT_FALSE(job.running());
  ASSERT_TRUE(waitFor([&] { return ended.load(); }));
  EXPECT_FALSE(job.takeResult());
  ended = false;
  job.start(0.0, work);
  job.stop();
  EXPECT_TRUE(ended) << "stop waits";
}

TEST(FramePacer, DrawsUntilReusedImagesAreFresh) {
  FramePacer pacer;
  EXPECT_FALSE(pacer.due());
  Settings settings;
  settings.reflection.updateInterval = 9;
  pacer.change({&settings, 1});
  int frames = 0;
  for (; pacer.due(); ++frames) {
    pacer.frameDrawn();
  }
  EXPECT_EQ(frames, 4 + 9);
  pacer.requestFrames(2);
  pacer.requestFrames(1);
  pacer.frameDrawn();
  EXPECT_TRUE(pacer.due());
}

TEST(FramePacer, IdleTimeIsNoFrameTime) {
  FramePacer pacer;
  EXPECT_TRUE(std::isnan(pacer.beginFrame(3.0)));
  EXPECT_EQ(pacer.beginFrame(0.5), 500.0);
  pacer.idle();
  EXPECT_TRUE(std::isnan(pacer.beginFrame(0.5)));
}

class Report : public testing::Test {
 protected:
  Report() { scene_.mirrors.resize(3); }
  RecordedFrame frameOf(uint64_t number, double cpuMs, double sinceMs) const {
    return {scene_, state_, settings_, plan, number, cpuMs, sinceMs};
  }

  FramePlan plan;
  FrameReport report;
  const ShownFrame& view = report.shown();
  const std::vector<PassRow>& rows = view.passes;
  Settings settings_;

 private:
  Scene scene_;
  const SceneState state_;
};

TEST_F(Report, PanelOnlyFramesChangeNoFigure) {
  uint64_t number = 0;
  const auto frame = [&](bool panelOnly, double sinceMs, double cpuMs, const FrameTimings& timings) {
    plan.main().source = panelOnly ? PassSource::reused : PassSource::drawn;
    report.updateTimes(frameOf(++number, cpuMs, sinceMs), timings);
  };
  const auto timed = [](uint64_t frame, double ms) {
    return FrameTimings{.frame = frame, .gpuMs = ms, .passes = {{.name = "main view", .gpuMs = ms}}};
  };
  frame(false, NAN, 5.0, {});
  EXPECT_FALSE(view.still);
  frame(true, 14000.0, 1.0, timed(1, 13990.0));
  for (int i = 0; i < 100; ++i) {
    frame(true, 20.0, 1.0, timed(number, 3.0));
  }
  EXPECT_TRUE(view.still);
  EXPECT_EQ(view.frameMs, 13995.0);
  EXPECT_EQ(view.gpuMs, 13990.0);
  EXPECT_EQ(view.cpuMs, 5.0);
  EXPECT_EQ(view.history.frames(), 1u);
  frame(false, 20.0, 5.0, {});
  frame(false, 10.0, 5.0, timed(number, 8.0));
  EXPECT_FALSE(view.still);
  EXPECT_LT(view.gpuMs, 10.0);
  for (int i = 0; i < 100; ++i) {
    frame(false, 10.0, 5.0, timed(number, 8.0));
  }
  EXPECT_NEAR(view.frameMs, 10.0, 1.0) << "not held up by the slow frame before";
}

TEST_F(Report, RepeatedPicturesChangeNoFigure) {
  report.updateTimes(frameOf(1, 5.0, NAN), {});
  report.updateTimes(frameOf(2, 5.0, 30.0), {.frame = 1, .gpuMs = 20.0});
  EXPECT_FALSE(view.still);
  const double ms = view.frameMs;
  for (uint64_t number = 3; number < 9; ++number) {
    RecordedFrame again = frameOf(number, 1.0, 16.0);
    again.repeats = true;  // as for the Targets window
    report.updateTimes(again, {.frame = number - 1, .gpuMs = 20.0});
    EXPECT_TRUE(view.still);
  }
  EXPECT_EQ(view.cpuMs, 5.0);
  EXPECT_NEAR(view.frameMs, 25.0, 1e-9) << "of the last other one, not " << ms;
  EXPECT_EQ(view.history.frames(), 2u);
}

TEST_F(Report, TilesOfAPictureAreOneFrame) {
  plan.main().view.rect = {0, 0, 2 * tileSide, 2 * tileSide};
  report.updateTimes(frameOf(1, 1.0, NAN), {});
  uint64_t number = 1;
  for (int picture = 0; picture < 2; ++picture) {
    for (size_t tile = 0; tile < 4; ++tile) {
      plan.tiles = {tile, tile + 1};
      report.updateTimes(frameOf(number + 1, 2.0, 30.0), {.frame = number, .gpuMs = 25.0});
      ++number;
      EXPECT_TRUE(view.still) << "no picture follows another at once";
      EXPECT_EQ(view.target.share, static_cast<double>(tile + 1) / 4.0);
      EXPECT_EQ(view.frameMs, picture == 0 ? 1.0 + 25.0 : 4 * 27.0) << "of the last complete picture";
    }
    if (picture == 0) {
      plan.tiles = {0, 1};
      FrameReport next = report;
      next.updateTimes(frameOf(number + 1, 2.0, 30.0), {.frame = number, .gpuMs = 25.0});
      EXPECT_EQ(next.shown().gpuMs, 4 * 25.0) << "known while the next picture is drawn";
    }
  }
  EXPECT_EQ(view.history.frames(), 3u);
  plan.tiles.reset();
  plan.main().source = PassSource::reused;
  report.updateTimes(frameOf(number + 1, 1.0, 10.0), {.frame = number, .gpuMs = 25.0});
  EXPECT_EQ(view.gpuMs, 4 * 25.0);
  EXPECT_EQ(view.cpuMs, 4 * 2.0);
}

TEST_F(Report, TargetsStayWhileTilesAreDrawn) {
  Settings settings;
  settings.debug.maskPasses = false;
  const auto target = [&](const MirrorPath& path) {
    report.target({.path = path, .drawn = true}, plan, settings, true);
    return view.target;
  };
  plan.main().view.rect = {0, 0, tileSide, tileSide};
  EXPECT_TRUE(target({}).complete);
  testing_support::addMirror(plan, {0}).view.rect = {0, 0, tileSide, tileSide};
  plan.main().view.rect = {0, 0, 2 * tileSide, tileSide};
  plan.tiles = {0, 1};
  EXPECT_EQ(target({}).size.x, tileSide) << "of the picture before";
  EXPECT_FALSE(target({0}).complete) << "it has no picture before";
  plan.tiles = {1, 3};
  EXPECT_TRUE(target({0}).complete);
  EXPECT_EQ(target({}).size.x, 2 * tileSide);
}

TEST_F(Report, ReasonsAreWords) {
  plan.skipped = {{.path = {0}, .reason = SkipReason::backface},
                  {.path = {1}, .reason = SkipReason::outside},
                  {.path = {2}, .reason = SkipReason::maxPasses}};
  report.updateSkipped(frameOf(1, 1.0, 1.0));
  const std::vector<SkippedRow>& skipped = view.skipped;
  ASSERT_EQ(skipped.size(), 3u);
  EXPECT_EQ(skipped[0].reason, "seen from behind");
  EXPECT_EQ(skipped[1].reason, "outside the view");
  EXPECT_EQ(skipped[2].reason, "above Max. passes") << "the label of the setting";
}

TEST_F(Report, EffectsAreNamedAsTheirSwitches) {
  report.updateEffects(frameOf(1, 1.0, 1.0), {});
  const std::vector<EffectRow>& effects = view.effects;
  EXPECT_EQ(std::ranges::count(effects, "Glowing lights", &EffectRow::name), 1);
  for (const EffectRow& effect : effects) {
    EXPECT_TRUE(std::ranges::any_of(settingFields(), [&](const SettingField& f) { return f.label == effect.name; }))
        << effect.name;
  }
}

// The mirror is larger than the picture, so that none of its own edges is in view.
TEST(FrameReport, MirrorThatFillsThePictureIsOutlined) {
  TemporaryFolder folder;
  const Scene scene = loadScene(folder.write(
      "fills.toml",
      "[camera]\nposition = [0, 0, 4]\ntarget = [0, 0, 0]\n[[mirror]]\nposition = [0, 0, 0]\nsize = [99, 99]\n"));
  const SceneState state = evaluate(scene, 0.0);
  const Settings settings;
  FramePlan plan;
  plan.width = 64;
  plan.height = 32;
  FrameReport report;
  report.updateOutline({scene, state, settings, plan}, {0});
  double length = 0.0;
  for (const PixelLine& line : report.shown().outline) {
    length += glm::distance(line.a, line.b);
  }
  EXPECT_NEAR(length, 2.0 * (64 + 32), 1e-3);
}

// Times of a frame's passes.
FrameTimings timings(uint64_t frame, const std::vector<double>& ms) {
  FrameTimings all{.frame = frame};
  for (const double pass : ms) {
    all.gpuMs += pass;
    all.passes.push_back({.gpuMs = pass});
  }
  return all;
}

TEST_F(Report, EarlierTimesAreMarked) {
  const RecordedPass mirror{{.path = {0}}, "mirror a"};
  const RecordedPass main{{.kind = PassKind::main}, "main view"};
  const auto frame = [&](uint64_t number, const std::vector<RecordedPass>& passes, const FrameTimings& timings,
                         const std::vector<RecordedPass>& timed) {
    report.updateTimes(frameOf(number, 1.0, 1.0), timings, timed);
    report.updatePasses(frameOf(number, 1.0, 1.0), passes);
  };
  frame(1, {mirror, main}, {}, {});
  frame(2, {mirror, main}, timings(1, {530.0, 100.0}), {mirror, main});
  EXPECT_TRUE(rows[0].timed && rows[1].timed);
  testing_support::addMirror(plan, {0}, PassSource::reused);
  frame(3, {main}, timings(2, {}), {mirror, main});
  EXPECT_TRUE(rows[0].reused && rows[0].timed) << "the frame's own passes were not timed";
  frame(4, {main}, timings(3, {90.0}), {main});
  EXPECT_EQ(view.timedGpuMs, 90.0);
  EXPECT_FALSE(rows[0].timed);
  EXPECT_EQ(rows[0].gpuMs, 530.0);
  EXPECT_TRUE(rows[1].timed);
  EXPECT_EQ(rows[1].gpuMs, 90.0);
  plan.main().source = PassSource::reused;
  frame(5, {}, {}, {});
  frame(6, {}, timings(5, {3.0}), {main});
  EXPECT_EQ(rows[1].gpuMs, 90.0) << "a frame that draws the panels only";
  EXPECT_EQ(view.timedGpuMs, 90.0);
  EXPECT_TRUE(rows[0].reused);
  EXPECT_FALSE(rows[1].reused);
}

TEST_F(Report, DraftsHaveTheirOwnTimes) {
  const std::vector<RecordedPass> passes = {{{.kind = PassKind::main}, "main view"}};
  const auto frame = [&](RecordedFrame frame, const FrameTimings& timings) {
    report.updateTimes(frame, timings, passes);
    report.updatePasses(frame, passes);
  };
  const auto draft = [&](uint64_t number) {
    RecordedFrame frame = frameOf(number, 1.0, 1.0);
    frame.lowered = true;
    return frame;
  };
  frame(frameOf(1, 1.0, 1.0), {});
  frame(frameOf(2, 1.0, 1.0), timings(1, {500.0}));
  frame(draft(3), {});
  EXPECT_TRUE(std::isnan(rows[0].gpuMs)) << "not the whole picture's";
  EXPECT_EQ(view.timedGpuMs, 0.0);
  plan.main().view.rect = {0, 0, 2 * tileSide, tileSide};
  plan.tiles = {0, 1};
  report.updateTimes(frameOf(4, 1.0, 1.0), timings(3, {20.0}), passes);
  EXPECT_EQ(rows[0].gpuMs, 20.0) << "known while tiles of the next picture are drawn";
  EXPECT_EQ(view.timedGpuMs, 20.0);
  EXPECT_EQ(view.history.frames(), 1u) << "of drafts";
}

TEST_F(Report, OtherSettingsMakeTimesOld) {
  const std::vector<RecordedPass> passes = {{{.kind = PassKind::main}, "main view"}};
  report.updateTimes(frameOf(1, 1.0, 1.0), {});
  report.updatePasses(frameOf(1, 1.0, 1.0), passes);
  report.updateTimes(frameOf(2, 1.0, 1.0), timings(1, {500.0}), passes);
  EXPECT_TRUE(rows[0].timed);
  settings_.view.scale = 0.5;
  report.updatePasses(frameOf(3, 1.0, 1.0), passes);
  EXPECT_FALSE(rows[0].timed);
  EXPECT_EQ(rows[0].gpuMs, 500.0);
  EXPECT_EQ(view.timedGpuMs, 0.0);
}

TEST_F(Report, HistoryIsOfThePresentSettings) {
  const auto drawn = [&](uint64_t number, double scale, bool lowered = false) {
    RecordedFrame frame = frameOf(number, 1.0, 1.0);
    frame.chosen.reflection.scale = scale;
    frame.lowered = lowered;
    report.updateTimes(frame, {});
    return view.history.frames();
  };
  drawn(1, 1.0);
  EXPECT_EQ(drawn(2, 1.0), 2u);
  EXPECT_EQ(drawn(3, 1.0, true), 1u);
  EXPECT_EQ(drawn(4, 1.0), 3u) << "drafts are no change of settings";
  EXPECT_EQ(drawn(5, 0.5), 1u) << "cheaper, which a median over earlier frames would hide";
  EXPECT_EQ(drawn(6, 0.5), 2u);
}

TEST_F(Report, FramesThatCompileAreNoHistory) {
  RecordedFrame first = frameOf(1, 900.0, 1000.0);
  first.compiles = true;
  report.updateTimes(first, {});
  report.updateTimes(frameOf(2, 1.0, 20.0), {});
  EXPECT_EQ(view.history.series(FrameHistory::Figure::cpu), std::vector<float>{1.0f});
}

TEST_F(Report, MirrorsSeenInReusedImagesStayListed) {
  plan.skipped = {{.path = {0, 1}, .reason = SkipReason::hidden}, {.path = {2, 1}, .reason = SkipReason::hidden}};
  const RecordedFrame frame = frameOf(1, 1.0, 1.0);
  report.updateSkipped(frame);
  EXPECT_EQ(view.skipped.size(), 2u);
  plan.skipped.clear();
  testing_support::addMirror(plan, {0}, PassSource::reused);
  report.updateSkipped(frame);
  ASSERT_EQ(view.skipped.size(), 1u) << "the image of mirror 2 is rendered again";
  EXPECT_EQ(view.skipped[0].path, (MirrorPath{0, 1}));
  EXPECT_EQ(view.skipped[0].reason, "hidden");
  plan.passes.erase(plan.passes.begin());
  report.updateSkipped(frame);
  EXPECT_TRUE(view.skipped.empty());
}

TEST_F(Report, TimesOfTilesAddUp) {
  const std::vector<RecordedPass> passes = {{{.path = {0}}, "mirror a"}, {{.kind = PassKind::main}, "main view"}};
  testing_support::addMirror(plan, {0}).view.rect = {0, 0, tileSide, tileSide};
  plan.main().view.rect = {0, 0, tileSide, tileSide};
  const auto frame = [&](uint64_t number, const FrameTimings& timings, const std::vector<RecordedPass>& timed) {
    report.updateTimes(frameOf(number, 1.0, 1.0), timings, timed);
    if (endsPicture(plan)) {
      report.updatePasses(frameOf(number, 1.0, 1.0), passes);
    }
  };
  frame(1, {}, {});
  frame(2, timings(1, {1.0, 5.0}), passes);
  EXPECT_EQ(rows[1].gpuMs, 5.0);
  plan.tiles = {0, 1};
  frame(3, timings(2, {1.0, 5.0}), passes);
  plan.tiles = {1, 2};
  frame(4, timings(3, {40.0}), {passes[0]});
  EXPECT_TRUE(std::isnan(rows[1].gpuMs)) << "not the draft's";
  EXPECT_EQ(view.timedGpuMs, 0.0);
  plan.tiles = {0, 1};
  frame(5, timings(4, {2.0, 300.0}), passes);
  EXPECT_EQ(rows[0].gpuMs, 42.0);
  EXPECT_EQ(rows[1].gpuMs, 300.0);
  EXPECT_TRUE(rows[0].timed && rows[1].timed);
  EXPECT_EQ(view.timedGpuMs, 342.0);
  EXPECT_EQ(view.history.passSeries("mirror a").back(), 42.0f);
  plan.tiles = {1, 2};
  frame(6, timings(5, {40.0}), {passes[0]});
  EXPECT_EQ(rows[1].gpuMs, 300.0) << "until the next picture is timed";
}

TEST(Options, FileAloneIsTheScene) {
  const auto scene = [](std::vector<const char*> arguments) {
    return std::string(parseOptions(static_cast<int>(arguments.size()), arguments.data()).value().scene);
  };
  EXPECT_EQ(scene({"speculum", "rooms/hall.toml", "--frames", "3"}), "rooms/hall.toml");
  EXPECT_EQ(scene({"speculum", "demo", "thing.obj"}), "thing.obj");
  EXPECT_EQ(scene({"speculum", "pool"}), "pool");
  EXPECT_EQ(scene({"speculum", "demo", "pool"}), "pool");
  EXPECT_EQ(scene({"speculum", "--scene", "pool"}), "pool");
  EXPECT_THROW(scene({"speculum", "rnder"}), UsageError);
}

// The camera of a scene that stands still, with that position and target.
struct StillCamera : CameraController {
  StillCamera(const glm::dvec3& position, const glm::dvec3& target) {
    reset({.position = position, .target = target});
    start = lookAt(position, target, {0, 1, 0}, 60.0, 0.001);
    now();
  }
  CameraPose now() { return pose(start); }

  CameraPose start;
};

TEST(CameraControl, FramesSpheresWithRoomAroundThem) {
  const Sphere sphere{{5.0, -2.0, 1.0}, 3.0};
  for (const double aspect : {0.25, 1.0, 4.0}) {
    StillCamera camera({1.0, 2.0, 3.0}, {0.0, 0.5, 0.0});
    camera.frame(sphere, aspect, {});
    const CameraPose pose = camera.now();
    const glm::dvec3 seen = pose.worldToView * (sphere.center - pose.eye);
    EXPECT_NEAR(seen.x, 0.0, 1e-9);
    EXPECT_NEAR(seen.y, 0.0, 1e-9);
    // The nearer pair of the frustum's sides does not touch the sphere.
    const double half = 0.5 * pose.verticalFov;
    const double narrower = std::min(half, std::atan(std::tan(half) * aspect));
    EXPECT_NEAR(-seen.z * std::sin(narrower), 1.1 * sphere.radius, 1e-9);
    EXPECT_NEAR(glm::distance(pose.worldToView[0], camera.start.worldToView[0]), 0.0, 1e-9) << "the direction stays";
  }
}

TEST(CameraControl, FramesBetweenPanelsAndOrbitsThere) {
  StillCamera camera({1.0, 2.0, 3.0}, {0.0, 0.5, 0.0});
  const glm::dvec3 center(5.0, -2.0, 1.0);
  camera.frame({center, 3.0}, 2.0, {.center = {0.4, -0.1}, .half = {0.6, 0.9}});
  for (int turn = 0; turn < 3; ++turn) {
    const CameraPose pose = camera.now();
    const glm::dvec3 seen = pose.worldToView * (center - pose.eye);
    const double slope = std::tan(0.5 * pose.verticalFov);
    EXPECT_NEAR(seen.x / -seen.z / (2.0 * slope), 0.4, 1e-9) << "it stays while the camera orbits";
    EXPECT_NEAR(seen.y / -seen.z / slope, -0.1, 1e-9);
    camera.drag(40.0, 10.0);
  }
}

TEST(CameraControl, OrbitStaysAboveTheFloor) {
  StillCamera camera({0.0, 2.0, 4.0}, {0.0, 1.0, 0.0});
  camera.setMode(CameraMode::orbit);
  camera.setFloor(0.0);
  for (int i = 0; i < 50; ++i) {
    camera.drag(0.0, -20.0);
    EXPECT_GT(camera.now().eye.y, 0.0);
  }
  EXPECT_LT(camera.now().eye.y, 0.5);
}

TEST(CameraControl, DragsTurnAndStopAtThePole) {
  for (const CameraMode mode : {CameraMode::orbit, CameraMode::fly}) {
    StillCamera camera({0.0, 2.0, 4.0}, {0.0, 1.0, 0.0});
    camera.setMode(mode);
    const auto forward = [&] { return -glm::dvec3(glm::transpose(camera.now().worldToView)[2]); };
    const glm::dvec3 before = forward();
    camera.drag(0.0, 90.0);
    const double turned = glm::degrees(std::acos(glm::dot(before, forward())));
    EXPECT_GT(turned, 5.0);
    EXPECT_LT(turned, 30.0);
    for (const double way : {1.0, -1.0}) {
      camera.drag(0.0, way * 5000.0);
      const double pitch = glm::degrees(std::asin(forward().y));
      EXPECT_GT(std::abs(pitch), 80.0) << "as far as it goes, in one large step too";
      EXPECT_LT(std::abs(pitch), 89.0);
      EXPECT_LT(pitch * way, 0.0) << "down to look up, in both modes";
    }
  }
}

TEST(CameraControl, FloorMirrorLeansWhereTheCameraLooks) {
  MirrorState floor;
  floor.polygon = {{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}};
  floor.normal = {0, 1, 0};
  for (const auto side : {MirrorSide::back, MirrorSide::front}) {
    StillCamera camera({0.0, 2.0, 5.0}, {0.0, 0.0, 0.0});
    camera.lookFrom(floor, side, 1.5);
    const CameraPose pose = camera.now();
    EXPECT_EQ(pose.eye.y > 0.0, side == MirrorSide::front);
    EXPECT_GT(pose.worldToView[1][2], -1.0);
    const glm::dvec3 forward = -glm::dvec3(glm::transpose(pose.worldToView)[2]);
    EXPECT_GT(forward.y, 0.9);
    EXPECT_LT(forward.z, -0.1) << "the top of the picture is towards where the camera came from";
  }
}

TEST(Gamepad, StickBeginsWithoutAJump) {
  EXPECT_EQ(withoutDeadZone(0.2f), 0.0f);
  EXPECT_EQ(withoutDeadZone(-0.25f), 0.0f);
  EXPECT_FALSE(std::signbit(withoutDeadZone(-0.1f)));
  EXPECT_NEAR(withoutDeadZone(0.26f), 0.0133f, 1e-3f);
  EXPECT_EQ(withoutDeadZone(1.0f), 1.0f);
  EXPECT_EQ(withoutDeadZone(-1.0f), -1.0f);
}

TEST(CameraController, MovesFromTheSceneCameraAtOnce) {
  const CameraSpec spec{.position = {0, 1.9, 8.4}, .target = {0, 0.85, 0}};  // above the origin
  CameraController camera;
  camera.reset(spec);
  camera.drag(1.0, 0.0);
  EXPECT_LT(glm::distance(camera.pose({}).eye, spec.position), 0.2);
}

}  // namespace
}  // namespace speculum
