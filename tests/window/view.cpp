// Camera, bookmarks, time, captures and files of the window, by commands.
#include "accuracy/sweep_json.hpp"
#include "compare/image_metrics.hpp"
#include "image/picture_files.hpp"
#include "window/accuracy_controller.hpp"
#include "window/support.hpp"

namespace speculum {
namespace {

using namespace testing_support;
namespace fs = std::filesystem;

class WindowView : public WorkspaceTest {
 protected:
  WindowView() : WorkspaceTest(wallScene) {}

  // Says whether the whole wall is in the picture.
  bool seesWall() {
    const CameraPose pose = camera();
    const double half = std::tan(0.5 * pose.verticalFov);
    for (const glm::dvec3& corner : {glm::dvec3(-2.5, -0.5, -2.0), glm::dvec3(2.5, 2.5, -2.0)}) {
      const glm::dvec3 seen = pose.worldToView * (corner - pose.eye);
      if (seen.z >= 0.0 || std::abs(seen.y / seen.z) >= half || std::abs(seen.x / seen.z) >= half * width / height) {
        return false;
      }
    }
    return true;
  }
};

class Measuring : public WindowView {
 protected:
  Measuring() {
    request_.options.scene = workspace_->scene().file.string();
    request_.options.size = {320, 240};
    request_.camera = camera();
  }

  SweepRequest request_;
};

TEST_F(Measuring, FirstFigureTakesOneRound) {
  std::map<std::string, int> reports;
  const auto count = [&](const SweepStatus& status) { return ++reports[status.stage] > 0; };
  ViewMeasurement measurement(request_);
  const SweepResults first = measurement.rough(1, count);
  EXPECT_LE(first.width * first.height, 160 * 90);
  EXPECT_EQ(first.truthSamples, 4);
  const auto points = static_cast<int>(first.points.size());
  ASSERT_GT(points, 5);
  EXPECT_LE(reports["times"], points + 2);
  EXPECT_GT(first.points.front().frameMs.median, 0.0);
  const SweepResults better = measurement.rough(3, count);
  EXPECT_EQ(better.points.front().frameMs.repeats, 3);
  EXPECT_LE(reports["times"], 4 * points + 4);
}

TEST_F(Measuring, PickedRoughPointsStay) {
  // Without a mirror there is little to vary, and the measurement is soon done.
  request_.options.scene = writeScene("plain", wallScene.substr(0, wallScene.find("[[mirror]]"))).string();
  AccuracyController accuracy({}, {}, "");
  Settings settings;
  const auto waitFor = [&](const auto& done) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(5);
    while (!done() && std::chrono::steady_clock::now() < end) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      accuracy.beforeFrame(settings);
    }
    return done();
  };
  settings.quality.maxError = 0.9;
  accuracy.beforeFrame(settings);
  EXPECT_EQ(accuracy.shown().choice, "") << "there are no points";
  settings.quality = {};
  accuracy.beforeFrame(settings);
  accuracy.measure(request_, watchedState());
  settings.quality.maxError = 0.9;
  accuracy.beforeFrame(settings);
  EXPECT_EQ(accuracy.shown().choice, "") << "the first points are not measured";
  ASSERT_TRUE(waitFor([&] { return !accuracy.shown().points.empty(); }));
  ASSERT_TRUE(accuracy.working()) << "better figures follow";
  EXPECT_EQ(accuracy.shown().current, accuracy.shown().front.front()) << "the bound chose";
  const Settings chosen = settings;
  accuracy.applyPoint(accuracy.shown().current == 0 ? 1 : 0, settings);
  ASSERT_NE(settings, chosen);
  const Settings picked = settings;
  ASSERT_TRUE(waitFor([&] { return !accuracy.working(); })) << accuracy.shown().about;
  accuracy.beforeFrame(settings);
  EXPECT_EQ(settings, picked) << "better figures change no settings that were picked by hand";
}

TEST(EnlargedTimes, PartsThatDependOnNoSizeStay) {
  SweepResults results;
  for (const double ms : {60.0, 45.0, 50.0}) {
    SweepPoint& point = results.points.emplace_back();
    point.frameMs = spreadOf({ms});
  }
  // 40 ms of shadow maps, and 64 times as many pixels.
  enlargeTimes(results, {60.0, 40.0 + 64.0 * 20.0}, {45.0, 40.0 + 64.0 * 5.0}, 64.0);
  EXPECT_DOUBLE_EQ(results.points[2].frameMs.median, 40.0 + 64.0 * 10.0);
  EXPECT_EQ(results.points[2].gpuMs.repeats, 0);
  EXPECT_EQ(results.points[2].gpuMs.median, 0.0) << "the device has no timestamps";
  enlargeTimes(results, {10.0, 30.0}, {9.5, 29.0}, 64.0);
  EXPECT_DOUBLE_EQ(results.points[2].frameMs.median, 3.0 * 680.0) << "too close for a line";
}

TEST(EnlargedTimes, NoiseStaysWithinTheModel) {
  const auto enlarged = [](const SizedMs& base, const SizedMs& fastest) {
    SweepResults results;
    results.points.emplace_back().frameMs = spreadOf({30.0});
    enlargeTimes(results, base, fastest, 16.0);
    return results.points[0].frameMs.median;
  };
  EXPECT_DOUBLE_EQ(enlarged({12.0, 96.0}, {9.0, 95.0}), 8.0 * 30.0) << "no less than in proportion";
  EXPECT_DOUBLE_EQ(enlarged({12.0, 96.0}, {9.0, 10.0}), 96.0 + 16.0 * 18.0) << "no more than by pixels";
}

TEST_F(WindowView, MiddleButtonPans) {
  const glm::dvec3 before = eye();
  const glm::dvec3 looked = forward();
  drag({600, 400}, {100, -50}, MouseButton::middle);
  // The target is 4 m away and the picture 700 pixels high at 60 degrees.
  const double metresPerPixel = 2.0 * std::tan(glm::radians(30.0)) * 4.0 / height;
  EXPECT_NEAR(glm::distance(eye(), before + glm::dvec3(-100.0, -50.0, 0.0) * metresPerPixel), 0.0, 1e-9);
  EXPECT_NEAR(glm::distance(forward(), looked), 0.0, 1e-9);
  const glm::dvec3 panned = eye();
  moveTo({600, 400});
  EXPECT_EQ(eye(), panned) << "let go";
}

TEST_F(WindowView, WheelNeverReachesTheTarget) {
  const glm::dvec3 looked = forward();
  for (const double notches : {1.0, -1.0}) {
    for (int i = 0; i < 1000; ++i) {
      workspace_->view().camera.zoom(notches);
      ASSERT_NEAR(glm::distance(forward(), looked), 0.0, 1e-6) << i << " notches of " << notches;
    }
  }
}

TEST_F(WindowView, SticksMoveAndTurn) {
  const glm::dvec3 before = eye();
  workspace_->view().camera.move({}, {.leftY = -1.0f}, 0.1);
  EXPECT_LT(eye().z, before.z) << "forward";
  EXPECT_NEAR(eye().x, before.x, 1e-9);
  workspace_->view().camera.move({}, {.rightTrigger = 1.0f}, 0.1);
  EXPECT_GT(eye().y, before.y) << "up";
  send(ResetCamera{});
  EXPECT_EQ(eye(), before);
  send(ToggleCameraMode{});
  EXPECT_EQ(shown().camera.mode, CameraMode::fly);
  workspace_->view().camera.move({}, {.rightX = 1.0f}, 0.1);
  EXPECT_GT(forward().x, 0.0) << "to the right";
  EXPECT_NEAR(glm::distance(eye(), before), 0.0, 1e-9);
  workspace_->view().camera.move({0.0, 0.0, -1.0}, {}, 0.1);
  EXPECT_GT(glm::distance(eye(), before), 0.01) << "keys as well";
}

TEST_F(WindowView, MirrorsAreLookedFromBothSides) {
  send(LookFromMirror{MirrorSide::back});
  EXPECT_LT(eye().z, -2.0);
  EXPECT_NEAR(glm::distance(forward(), glm::dvec3(0.0, 0.0, 1.0)), 0.0, 1e-9);
  EXPECT_TRUE(seesWall());
  EXPECT_TRUE(contains(status(), "Its back does not reflect")) << status();
  send(LookFromMirror{MirrorSide::front});
  EXPECT_TRUE(contains(status(), "Looking out of mirror")) << status();
  EXPECT_NEAR(eye().z, -2.0 + 0.01, 1e-9);
  EXPECT_NEAR(forward().z, 1.0, 1e-9);
}

TEST_F(WindowView, FrameShowsTheSceneOrTheSelection) {
  const glm::dvec3 before = eye();
  send(FrameSelection{});
  EXPECT_GT(glm::distance(eye(), before), 0.1);
  EXPECT_TRUE(seesWall());
  send(SelectNode{ball});
  const glm::dvec3 all = eye();
  send(FrameSelection{});
  EXPECT_LT(glm::distance(eye(), glm::dvec3(0.9, 1.0, 0.0)), glm::distance(all, glm::dvec3(0.9, 1.0, 0.0)));
}

TEST_F(WindowView, BookmarksAreGoneToAndSaved) {
  send(FrameSelection{});
  const CameraPose framed = camera();
  send(AddBookmark{});
  send(LookFromMirror{MirrorSide::back});
  send(AddBookmark{});
  ASSERT_EQ(scene().bookmarks.size(), 2u);
  EXPECT_NE(scene().bookmarks[0].name, scene().bookmarks[1].name);
  send(GoToNextBookmark{});
  EXPECT_EQ(shown().camera.bookmark, 0);
  EXPECT_NEAR(glm::distance(eye(), framed.eye), 0.0, 1e-9);
  EXPECT_NEAR(glm::distance(camera().worldToView[0], framed.worldToView[0]), 0.0, 1e-9);
  send(Save{});
  const Scene saved = onDisk();
  ASSERT_EQ(saved.bookmarks.size(), 2u);
  EXPECT_EQ(saved.bookmarks[0].position, framed.eye);
  send(RemoveBookmark{0});
  EXPECT_EQ(scene().bookmarks.size(), 1u);
  send(GoToBookmark{5});
  EXPECT_EQ(shown().camera.bookmark, 0) << "there is none";
}

class TiltedBookmark : public WorkspaceTest {
 protected:
  TiltedBookmark()
      : WorkspaceTest(corridorScene() +
                      "[[bookmark]]\nname = \"tilted\"\nposition = [0, 1, 1]\ntarget = [0.3, 1, 0]\nup = [1, 2, 0]\n"
                      "vertical_fov = 30\n") {}
};

TEST_F(TiltedBookmark, KeepsItsUpAndFieldOfView) {
  send(GoToBookmark{0});
  send(CopyCommandLine{});
  EXPECT_TRUE(contains(host_.clipboard, "--camera 0,1,1:0.3,1,0:1,2,0:30"));
  send(AddBookmark{});
  ASSERT_EQ(scene().bookmarks.size(), 2u);
  EXPECT_EQ(scene().bookmarks[1].up, scene().bookmarks[0].up);
  EXPECT_EQ(scene().bookmarks[1].verticalFov, scene().bookmarks[0].verticalFov);
}

TEST_F(WindowView, TimeIsPausedSteppedAndScaled) {
  const ShownPlayback& playback = shown().playback;
  frame(2.0);
  EXPECT_EQ(playback.time, 2.0);
  send(TogglePaused{});
  frame(1.0);
  EXPECT_EQ(playback.time, 2.0);
  send(StepTime{2});
  EXPECT_NEAR(playback.time, 2.0 + 2.0 * timeStep, 1e-12);
  send(MultiplyTimeSpeed{0.5});
  EXPECT_EQ(playback.speed, 0.5);
  send(SetTimeSpeed{4.0});
  send(SetPaused{false});
  send(Seek{1.0});
  frame(0.5);
  EXPECT_EQ(playback.time, 3.0);
  send(StepTime{-1});
  EXPECT_TRUE(playback.paused) << "a step pauses";
  send(Seek{-1.0});
  EXPECT_EQ(playback.time, 0.0);
  for (int i = 0; i < 20; ++i) {
    send(MultiplyTimeSpeed{0.5});
  }
  EXPECT_EQ(playback.speed, slowestTime);
}

TEST_F(WindowView, ScreenshotsAreSavedAndReported) {
  send(TakeScreenshot{false});
  EXPECT_TRUE(workspace_->capture().wanted());
  EXPECT_TRUE(workspace_->capture().bare());
  EXPECT_TRUE(shown().status.savesPicture);
  drawFrame(Image8(5, 3));
  ASSERT_EQ(home_.pictures().size(), 1u);
  EXPECT_EQ(readImage8(home_.pictures()[0]).width, 5);
  EXPECT_EQ(status(), "Saved " + home_.pictures()[0].string());
  EXPECT_EQ(shown().log.lines().back().text, status());
  EXPECT_FALSE(workspace_->capture().wanted());
  send(Escape{});
  EXPECT_EQ(status(), "") << "dismissed";
}

TEST_F(WindowView, SavedPicturesSayHowFarTheyAre) {
  for (const bool withPanel : {false, true}) {
    for (const std::string progress : {"not finished: 17 of 64 pictures averaged", ""}) {
      workspace_->setPictureText("17 of 64 pictures averaged, next one 52 %", progress);
      send(TakeScreenshot{withPanel});
      EXPECT_EQ(workspace_->capture().bare(), !withPanel);
      drawFrame(Image8(5, 3));
      EXPECT_TRUE(status().ends_with(progress.empty() ? ".png" : ".png, " + progress)) << status();
    }
  }
}

TEST_F(WindowView, RecordingsAreEvenSequences) {
  send(ToggleRecording{true});
  EXPECT_FALSE(workspace_->capture().bare());
  EXPECT_EQ(workspace_->frameSeconds(1.0), 1.0 / Capture::framesPerSecond) << "however long the frames take";
  drawFrame();
  EXPECT_TRUE(contains(status(), "Recording: 1 frame ") && contains(status(), "F10 stops")) << status();
  drawFrame();
  send(ToggleRecording{true});
  ASSERT_EQ(home_.pictures().size(), 1u);
  EXPECT_TRUE(fs::exists(home_.pictures()[0] / "00001.png"));
  EXPECT_FALSE(fs::exists(home_.pictures()[0] / "00002.png"));
  EXPECT_EQ(status(), "Recorded 2 frames at 30 a second in " + home_.pictures()[0].string());
  EXPECT_EQ(workspace_->frameSeconds(1.0), 1.0);
}

TEST_F(WindowView, PromptsEndRecordingsWithoutPanels) {
  setExposure(2.0);
  for (const bool withPanels : {false, true}) {
    send(ToggleRecording{withPanels});
    send(Quit{});
    EXPECT_EQ(shown().edit.prompt, Prompt::unsavedChanges);
    EXPECT_EQ(shown().recording, withPanels) << "else nobody would see the prompt";
    send(CancelPrompt{});
  }
}

// The window's title is in no recorded picture.
TEST_F(WindowView, TitleSaysThatFramesAreRecorded) {
  for (const bool withPanels : {false, true}) {
    send(ToggleRecording{withPanels});
    EXPECT_EQ(host_.title, "Recording, F10 stops - workspace - Speculum");
    setExposure(withPanels ? 2.0 : 3.0);
    EXPECT_EQ(host_.title, "Recording, F10 stops - workspace* - Speculum");
    send(ToggleRecording{withPanels});
    send(Undo{});
    EXPECT_EQ(host_.title, "workspace - Speculum");
  }
}

TEST_F(WindowView, CapturesThatFailSaySo) {
  std::ofstream(picturesDir()) << "a file in the folder's place";
  send(TakeScreenshot{true});
  drawFrame();
  EXPECT_EQ(status().rfind("Not saved: ", 0), 0u) << status();
  send(ToggleRecording{true});
  EXPECT_EQ(status().rfind("Not recorded: ", 0), 0u) << status();
  EXPECT_FALSE(workspace_->capture().wanted());
}

TEST_F(WindowView, UndoCoversSettingsInOrder) {
  setExposure(2.0);
  send(AddLight{});
  setExposure(4.0);
  setExposure(5.0, true);
  EXPECT_EQ(edit().undo, "change Exposure");
  send(Undo{});
  EXPECT_EQ(workspace_->settings().view.exposure, 2.0) << "a widget that is held makes one step";
  const size_t lights = scene().lights.size();
  send(Undo{});
  EXPECT_EQ(scene().lights.size(), lights - 1);
  send(Undo{});
  EXPECT_EQ(workspace_->settings().view.exposure, 1.0);
  for (int i = 0; i < 3; ++i) {
    send(Redo{});
  }
  EXPECT_EQ(workspace_->settings().view.exposure, 5.0);
  EXPECT_EQ(scene().lights.size(), lights);
  send(Undo{});
  send(AddLight{});
  EXPECT_EQ(edit().redo, "") << "what was undone is gone with a new step";
  send(Undo{});
  send(Redo{});
  EXPECT_EQ(edit().redo, "");
}

class BudgetView : public WorkspaceTest {
 protected:
  BudgetView() : WorkspaceTest(corridorScene(), {.sweepResults = measured()}) {}

  static fs::path measured() {
    SweepResults results;
    for (const auto& [samples, error, ms] : {std::tuple("1", 0.2, 1.0), std::tuple("4", 0.1, 4.0)}) {
      SweepPoint& point = results.points.emplace_back();
      point.name = std::string("samples ") + samples;
      point.changes = {{"view.samples", samples}};
      point.whole.flip = error;
      point.gpuMs = {.median = ms, .minimum = ms, .lowerQuartile = ms, .upperQuartile = ms, .repeats = 15};
    }
    const fs::path file = writeScene("measured", "").replace_extension(".json");
    std::ofstream(file) << sweepJson(results);
    return file;
  }
  void setBudget(double ms) {
    changeSettings([&](Settings& settings) { settings.quality.budgetMs = ms; });
  }
  std::string choice() { return shown().accuracy.choice; }
};

TEST_F(BudgetView, PointsChosenByHandAreSaid) {
  setBudget(1e-3);
  EXPECT_TRUE(contains(choice(), "no measured point fits 0.001 ms"));
  EXPECT_TRUE(shown().accuracy.choiceMisses);
  const Settings before = workspace_->settings();
  send(ApplyPoint{shown().accuracy.front.back()});
  ASSERT_TRUE(shown().accuracy.own);
  EXPECT_EQ(*shown().accuracy.own, before);
  send(ApplyPoint{shown().accuracy.front.front()});
  send(ApplyPoint{shown().accuracy.front.back()});
  EXPECT_EQ(*shown().accuracy.own, before) << "from before all points";
  EXPECT_EQ(choice(), "Set by hand. Change a bound to let it choose again.");
  EXPECT_FALSE(shown().accuracy.choiceMisses);
  setBudget(2e-3);
  EXPECT_TRUE(contains(choice(), "no measured point fits"));
  setBudget(0.0);
  EXPECT_EQ(choice(), "");
}

class SpinningBall : public WorkspaceTest {
 protected:
  SpinningBall() : WorkspaceTest(replaced(corridorScene(), "scale = 0.2", "scale = 0.2, spin = [0, 90, 0]")) {}

  bool otherView() { return isOtherView(measured_, watchedState()); }

  const WatchedState measured_ = watchedState();
};

TEST_F(SpinningBall, TimeAloneMakesNoOtherView) {
  frame(0.5);
  EXPECT_FALSE(otherView()) << "the animation goes on";
  send(SetPaused{true});
  EXPECT_TRUE(otherView()) << "a picture of another time stands";
  send(Seek{measured_.time});
  EXPECT_FALSE(otherView()) << "the measured one";
  send(StepTime{1});
  EXPECT_TRUE(otherView());
  send(SetPaused{false});
  frame(0.5);
  EXPECT_TRUE(otherView()) << "the user set the time";
}

TEST_F(SpinningBall, MovedCameraMakesAnotherView) {
  send(FrameSelection{});
  EXPECT_TRUE(otherView());
  send(ResetCamera{});
  frame(0.5);
  EXPECT_FALSE(otherView());
}

TEST_F(SpinningBall, RecordingsOfAPausedSceneSaySo) {
  send(ToggleRecording{});
  drawFrame();
  EXPECT_FALSE(contains(status(), "Space")) << status();
  send(SetPaused{true});
  drawFrame();
  EXPECT_TRUE(contains(status(), "F10 stops. Space plays")) << status();
}

TEST_F(BudgetView, PlotKnowsThePointThatABoundChose) {
  EXPECT_EQ(shown().accuracy.chosen, -1);
  setBudget(2.0);
  EXPECT_EQ(shown().accuracy.chosen, shown().accuracy.current);
  EXPECT_GE(shown().accuracy.chosen, 0);
  send(ApplyPoint{shown().accuracy.front.back()});
  EXPECT_EQ(shown().accuracy.chosen, -1) << "the user chose";
  setBudget(3.0);
  EXPECT_GE(shown().accuracy.chosen, 0);
  setBudget(0.0);
  EXPECT_EQ(shown().accuracy.chosen, -1);
}

TEST_F(BudgetView, PickedPointsAreShownAlone) {
  const auto pictures = [&] { return workspace_->shownSettings().quality.stillPictures; };
  workspace_->accuracy().show(true, {});
  const int mean = pictures();
  ASSERT_GT(mean, 1);
  for (const int point : {0, 1, 0}) {
    send(ApplyPoint{point});
    EXPECT_EQ(pictures(), 1);
    EXPECT_TRUE(shown().accuracy.alone);
    EXPECT_EQ(shown().accuracy.current, point);
    EXPECT_TRUE(contains(status(), "one picture")) << status();
    EXPECT_EQ(workspace_->settings().quality.stillPictures, mean) << "nothing to be saved";
  }
  workspace_->accuracy().show(false, {});
  frame();
  EXPECT_EQ(pictures(), mean) << "the window is closed, nothing would say so";
  workspace_->accuracy().show(true, {});
  frame();
  EXPECT_EQ(pictures(), 1);
  changeSettings([](Settings& settings) { settings.view.exposure = 3.0; });
  EXPECT_EQ(pictures(), mean);
  send(Undo{});
  EXPECT_EQ(pictures(), 1) << "the picked settings again";
  setBudget(2.0);
  EXPECT_EQ(pictures(), mean) << "a bound chose, nobody picked";
}

TEST_F(BudgetView, PickedPointIsComparedWithTheSettingsBefore) {
  workspace_->accuracy().show(true, {});
  const Settings before = workspace_->settings();
  send(ApplyPoint{1});
  send(ApplyPoint{0});
  const Settings point = workspace_->settings();
  send(ToggleSplit{SplitStart::point});
  ASSERT_TRUE(workspace_->split().on());
  EXPECT_TRUE(workspace_->shownSettings(0) == before) << "from before both points";
  EXPECT_EQ(workspace_->shownSettings(1).view.samples, 1);
  EXPECT_EQ(workspace_->shownSettings(1).quality.stillPictures, 1) << "as it was measured";
  EXPECT_EQ(shown().accuracy.current, 0);
  EXPECT_TRUE(shown().accuracy.alone);
  send(ApplyPoint{1});
  EXPECT_EQ(workspace_->shownSettings(1).view.samples, 4) << "another point becomes B";
  EXPECT_TRUE(workspace_->shownSettings(0) == before);
  send(Escape{});
  EXPECT_FALSE(workspace_->split().on());
  EXPECT_TRUE(workspace_->settings() == point) << "as before A | B";
  EXPECT_TRUE(shown().accuracy.own == before) << "Back still leads there";
}

TEST_F(BudgetView, PickedPointOutlastsSplits) {
  workspace_->accuracy().show(true, {});
  const Settings before = workspace_->settings();
  send(ApplyPoint{1});
  for (const SplitStart start : {SplitStart::current, SplitStart::naive, SplitStart::point}) {
    send(ToggleSplit{start});
    EXPECT_EQ(shown().accuracy.alone, start == SplitStart::point) << "else both halves show a mean";
    send(ApplyPoint{0});
    send(ChooseOtherHalf{});
    send(Escape{});
    EXPECT_TRUE(shown().accuracy.own == before) << "Back still leads there";
    EXPECT_TRUE(shown().accuracy.alone) << "as before A | B";
  }
}

TEST_F(BudgetView, SettingsOfSplitsAreNotPicked) {
  workspace_->accuracy().show(true, {});
  const Settings before = workspace_->settings();
  send(ApplyPoint{1});
  const Settings picked = workspace_->settings();
  ASSERT_FALSE(picked == before);
  send(ToggleSplit{SplitStart::point});
  send(Undo{});  // of the pick: the halves have no steps
  ASSERT_TRUE(workspace_->split().on());
  send(Escape{});
  EXPECT_TRUE(workspace_->settings() == before);
  EXPECT_FALSE(shown().accuracy.alone) << "what undo led back to was not picked";
  send(Redo{});
  ASSERT_TRUE(workspace_->settings() == picked);
  EXPECT_TRUE(shown().accuracy.alone);
  send(ToggleSplit{});
  changeSettings([](Settings& settings) { settings.view.exposure = 3.0; });
  send(KeepHalf{});
  const Settings kept = workspace_->settings();
  EXPECT_FALSE(shown().accuracy.alone) << "changed by hand";
  send(ApplyPoint{0});
  EXPECT_TRUE(shown().accuracy.own == kept) << "Back leads to what the last pick replaced";
}

TEST_F(BudgetView, ChangedScenesSayThatTheResultIsGone) {
  send(AddLight{});
  EXPECT_TRUE(shown().accuracy.points.empty());
  EXPECT_EQ(shown().accuracy.about, "The scene was changed since the measurement.");
}

TEST_F(BudgetView, PricesOfSettingsAreListed) {
  const auto& prices = shown().accuracy.prices;
  ASSERT_EQ(prices.size(), 1u);
  EXPECT_EQ(prices.at("view.samples"), "\nMeasured in this view:\n1: 1 ms, FLIP 0.200\n4: 4 ms, FLIP 0.100");
}

TEST(Measurement, TimeLeftIsEstimatedWhenItIsKnown) {
  EXPECT_EQ(secondsLeft(1.0, 0.5), 0.0);
  EXPECT_EQ(secondsLeft(20.0, 0.02), 0.0);
  EXPECT_DOUBLE_EQ(secondsLeft(20.0, 0.25), 60.0);
  EXPECT_EQ(secondsLeft(20.0, 1.0), 0.0);
}

// Replays reports of all parts, and of some that take everything from the store at once.
TEST(Measurement, StepsCountOnThroughAllParts) {
  std::mt19937 random(5);
  for (int run = 0; run < 20; ++run) {
    double last = 0.0;
    std::string text;
    std::set<std::string> texts;
    for (int part = 0; part < 3; ++part) {
      for (const char* stage : {"starting", "reference", "pictures", "times"}) {
        for (double fraction = 0.0; fraction <= 1.0; fraction += std::uniform_real_distribution(0.1, 1.1)(random)) {
          const auto [step, progress] = measuringStep(part, {stage, fraction});
          EXPECT_GE(progress, last) << part << stage;
          EXPECT_TRUE(step == text || texts.insert(step).second) << "again: " << step;
          last = progress;
          text = step;
        }
      }
    }
    EXPECT_LE(last, 1.0);
    EXPECT_EQ(texts.size(), 7u);
    EXPECT_EQ(text, "Timing settings (7 of 7)");
  }
  EXPECT_EQ(measuringStep(2, {"times", 1.0}).second, 1.0);
}

TEST_F(WindowView, EditsSayThatTheyEndAMeasurement) {
  send(MeasureAccuracy{});
  send(AddLight{});
  EXPECT_EQ(shown().accuracy.about, "The scene was changed, so the measurement was cancelled.");
  send(AddLight{});
  EXPECT_EQ(shown().accuracy.about, "The scene was changed, so the measurement was cancelled.");
  send(MeasureAccuracy{});
  EXPECT_EQ(shown().accuracy.about, "") << "of the last one";
}

TEST_F(BudgetView, EditsSayThatTheyEndAMeasurement) {
  send(MeasureAccuracy{});
  send(AddLight{});
  EXPECT_EQ(shown().accuracy.about, "The scene was changed, so the measurement was cancelled.");
}

TEST_F(WindowView, TitleNamesTheSceneAndItsState) {
  EXPECT_EQ(host_.title, "workspace - Speculum");
  setExposure(2.0);
  EXPECT_EQ(host_.title, "workspace* - Speculum");
}

TEST_F(WindowView, HiddenPanelsSayHowTheyReturn) {
  send(TogglePanel{});
  EXPECT_EQ(status(), "Panels hidden. Tab shows them again.");
  send(TogglePanel{});
  EXPECT_EQ(status(), "") << "it is no longer true";
}

TEST(StatusLine, FadesInItsLastSecond) {
  EXPECT_EQ(statusAlpha(statusSeconds - 1.0), 1.0f);
  EXPECT_FLOAT_EQ(statusAlpha(statusSeconds - 0.25), 0.25f);
  EXPECT_LE(statusAlpha(statusSeconds), 0.0f);
}

TEST_F(WindowView, WarningsReachTheStatusLine) {
  spdlog::warn("this device has no 8 samples\nmore");
  frame();
  EXPECT_EQ(status(), "this device has no 8 samples");
}

TEST_F(WindowView, ResetGoesBackToTheScenesSettings) {
  setExposure(3.0);
  send(ResetSettings{});
  EXPECT_EQ(workspace_->settings().view.exposure, 1.0);
}

class Opening : public WindowView {
 protected:
  std::string model(const char* name) { return sourceFile("models/" + std::string(name)).string(); }
  void drop(const std::vector<fs::path>& files) {
    send(OpenDropped{files});
    waitFor([&] { return !workspace_->working(); });
    frame();
  }
};

TEST_F(Opening, ModelTakesThePlaceOfTheScene) {
  const size_t scenes = shown().browser.scenes.size();
  workspace_->browser().takeListed();
  drop({"/notes.txt", model("queen.obj")});
  EXPECT_EQ(workspace_->problem(), "");
  EXPECT_EQ(shownScene(), "queen.obj");
  EXPECT_EQ(shown().browser.scenes.size(), scenes + 1);
  EXPECT_TRUE(workspace_->browser().takeListed());
  drop({model("queen.obj")});
  EXPECT_EQ(shown().browser.scenes.size(), scenes + 1) << "the same file again";
  EXPECT_EQ(workspace_->time(), 0.0);
}

TEST_F(Opening, ModelsAreFramedBetweenPanels) {
  host_.free = PixelRect{width / 2, 0, width / 2, height};
  drop({model("queen.obj")});
  const glm::dvec3 seen = camera().worldToView * (workspace_->state(0.0).instances.at(0).center - eye());
  const double focal = 0.5 * height / std::tan(0.5 * camera().verticalFov);
  EXPECT_NEAR(focal * seen.x / -seen.z, width / 4.0, 30.0);
}

TEST_F(Opening, ModelsAreFramedWithoutTheirFloor) {
  drop({model("gem.obj")});
  waitFor([&] { return shownScene() == "gem.obj"; });
  const auto eye = [&] { return workspace_->state(0.0).camera.eye; };
  send(FrameSelection{});
  const glm::dvec3 all = eye();
  send(SelectNode{{Selection::Kind::object, 0}});
  send(FrameSelection{});
  EXPECT_NEAR(glm::distance(eye(), all), 0.0, 1e-9);
}

TEST_F(Opening, WarningsLeaveWithTheirScene) {
  const fs::path bounded = home_.path() / "bounded.toml";
  std::ofstream(bounded) << "[camera]\nposition = [0, 0, 4]\ntarget = [0, 0, 0]\n[settings]\n"
                            "\"quality.budget_ms\" = 5\n";
  drop({bounded});
  EXPECT_TRUE(contains(status(), "GPU budget waits"));
  drop({model("queen.obj")});
  EXPECT_EQ(shownScene(), "queen.obj");
  EXPECT_FALSE(contains(status(), "GPU budget waits")) << status();
}

TEST_F(Opening, ModelsStand) {
  for (const char* name : {"queen.obj", "box.obj", "room.obj"}) {
    drop({model(name)});
    EXPECT_FALSE(workspace_->animates()) << name;
    send(ResetCamera{});
    EXPECT_FALSE(workspace_->animates()) << name;
  }
}

TEST_F(Opening, OpenedScenesFolderIsListedFirst) {
  const ShownScenes& browser = shown().browser;
  EXPECT_EQ(browser.scenes.front().file.parent_path(), fs::path(options_.scene).parent_path());
  for (const char* name : {"b_scene", "a_scene"}) {
    std::ofstream(home_.path() / (std::string(name) + ".toml"))
        << "title = 'T'\n[camera]\nposition = [0, 0, 4]\ntarget = [0, 0, 0]\n";
  }
  std::ofstream(home_.path() / "notes.toml") << "something = 1\n";
  drop({home_.path() / "b_scene.toml"});
  ASSERT_GT(browser.scenes.size(), 4u);
  EXPECT_EQ(browser.scenes[0].name, "a_scene");
  EXPECT_EQ(browser.scenes[0].title, "T");
  EXPECT_EQ(browser.scenes[1].file, home_.path() / "b_scene.toml");
  EXPECT_EQ(browser.shown, 1u);
  const auto count = [&](const std::string& name) {
    return std::count_if(browser.scenes.begin(), browser.scenes.end(), [&](const auto& s) { return s.name == name; });
  };
  EXPECT_EQ(count("notes"), 0) << "no scene";
  EXPECT_EQ(count("gallery"), 1);
  EXPECT_EQ(count("workspace"), 1) << "what was open";
}

TEST_F(Opening, FailureShowsALineAndKeepsScene) {
  const fs::path broken = home_.path() / "broken.toml";
  std::ofstream(broken) << "[camera]\nposition = [0, 0, 4]\ntarget = [0, 0, 4]\n";
  drop({broken});
  EXPECT_EQ(workspace_->problem().rfind(broken.string() + ":3: camera.target:", 0), 0u) << workspace_->problem();
  send(Escape{});
  EXPECT_EQ(workspace_->problem(), "") << "dismissed";
  drop({broken});
  send(DismissMessage{});
  EXPECT_EQ(workspace_->problem(), "");
  drop({"/tmp/notes.txt"});
  EXPECT_EQ(workspace_->problem(),
            "/tmp/notes.txt: not a scene (a .toml scene or a Wavefront OBJ or glTF 2.0 model is needed)");
  drop({model("none.obj")});
  EXPECT_TRUE(contains(workspace_->problem(), "none.obj: there is no such file"));
  EXPECT_EQ(shown().log.lines(LogLevel::err, "").size(), 4u) << "each is logged";
  setExposure(2.0);
  send(OpenScene{home_.path() / "none.toml"});
  EXPECT_FALSE(workspace_->prompting()) << "there is nothing to save the changes for";
  send(Undo{});
  host_.failsNext = true;
  drop({model("gem.obj")});
  EXPECT_TRUE(contains(workspace_->problem(), "gem.obj: no memory"));
  EXPECT_EQ(host_.scenesUsed, 2) << "the old scene is used again";
  EXPECT_EQ(shownScene(), "workspace");
  drop({model("gem.obj")});
  EXPECT_EQ(workspace_->problem(), "") << "gone with the next scene";
}

TEST_F(Opening, WithoutADialogTheWindowAsks) {
  askWhatToOpen("");
  EXPECT_EQ(edit().prompt, Prompt::open);
  EXPECT_TRUE(fs::equivalent(edit().proposedFile, fs::path(options_.scene).parent_path()));
  send(OpenScene{sourceFile("models/sphere.obj")});
  EXPECT_EQ(edit().prompt, Prompt::none);
  waitFor([&] { return shownScene() == "sphere.obj"; });
  EXPECT_EQ(shown().browser.recent.at(0).filename(), "sphere.obj");
  options_.scene.clear();
  start();
  EXPECT_EQ(shown().browser.recent.at(0).filename(), "sphere.obj") << "in the next session";
}

TEST_F(Opening, RecentFilesAreThereOnceAndOpenable) {
  const auto recent = [&] {
    std::vector<std::string> names;
    for (const fs::path& file : shown().browser.recent) {
      names.push_back(file.filename().string());
    }
    return names;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(recent(), Names{"workspace.toml"}) << "the file that the program was started with";
  const fs::path own = home_.path() / "own.toml";
  fs::copy_file(options_.scene, own);
  const fs::path link = home_.path() / "link.toml";
  fs::create_symlink(own, link);
  const auto open = [&](const fs::path& file) {
    send(OpenScene{file});
    waitFor([&] { return scene().file == file && !workspace_->working(); });
  };
  open(own);
  open(options_.scene);
  open(link);
  EXPECT_EQ(recent(), (Names{"link.toml", "workspace.toml"})) << "the last one first, each once";
  FakeHost host;
  Workspace other(options_, host);
  other.apply(OpenScene{sourceFile("models/sphere.obj")});
  for (int i = 0; i < 6000 && other.scene().file.extension() != ".obj"; ++i) {
    other.update();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  open(options_.scene);
  EXPECT_EQ(recent(), (Names{"workspace.toml", "sphere.obj", "link.toml"})) << "with those of another window";
  fs::remove(own);
  fs::remove(link);
  send(OpenScene{link});
  EXPECT_TRUE(contains(workspace_->problem(), "there is no such file"));
  EXPECT_EQ(recent(), (Names{"workspace.toml", "sphere.obj"})) << "it is gone";
}

class Dialogs : public Opening {
 protected:
  // Asks with a dialog that runs these commands; returns whether the window's own list opens.
  bool asksItself(const char* name, const std::string& commands) {
    const fs::path dialog = home_.path() / "bin" / name;
    fs::create_directories(dialog.parent_path());
    std::ofstream(dialog) << "#!/bin/sh\necho a warning >&2\n" << commands << "\n";
    fs::permissions(dialog, fs::perms::owner_all);
    askWhatToOpen(dialog.parent_path().string());
    waitFor([&] { return !workspace_->working(); });
    fs::remove(dialog);
    return edit().prompt == Prompt::open;
  }
};

TEST_F(Dialogs, DesktopsDialogNamesTheFile) {
  EXPECT_FALSE(asksItself("zenity", "echo " + sourceFile("models/sphere.obj").string()));
  EXPECT_EQ(shownScene(), "sphere.obj");
  EXPECT_FALSE(asksItself("kdialog", "echo " + sourceFile("scenes/no_mirror.toml").string()));
  EXPECT_EQ(shownScene(), "no_mirror");
}

TEST_F(Dialogs, CancelledDialogsEndAndFailedOnesAreReplaced) {
  EXPECT_FALSE(asksItself("zenity", "exit 1"));
  EXPECT_TRUE(asksItself("kdialog", "exit 2"));
  EXPECT_EQ(shownScene(), "workspace");
}

// An idle window must wake up for a scene that finished loading between two polls.
TEST_F(Opening, LoadedSceneIsWorkUntilTaken) {
  const auto load = [&] {
    workspace_->apply(OpenScene{sourceFile("scenes/no_mirror.toml")});
    while (!workspace_->browser().loaded()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_TRUE(workspace_->working());
  };
  load();
  setExposure(2.0);
  ASSERT_TRUE(workspace_->prompting());
  EXPECT_FALSE(workspace_->working()) << "nothing happens before the answer";
  send(CancelPrompt{});
  send(Undo{});
  load();
  frame();
  EXPECT_EQ(shownScene(), "no_mirror");
  EXPECT_FALSE(workspace_->working());
}

TEST_F(Opening, LoadingIsCancelled) {
  std::string lines;
  for (int i = 0; i < 1000; ++i) {
    lines += "v 0 0 0\n";
  }
  // Takes a second to read, longer than until the next frame.
  std::ofstream large(home_.path() / "large.obj");
  for (int i = 0; i < 2000; ++i) {
    large << lines;
  }
  large << "v 1 0 0\nv 0 1 0\nf -3 -2 -1\n" << std::flush;
  send(OpenScene{home_.path() / "large.obj"});
  EXPECT_EQ(shown().browser.loading, "large.obj");
  EXPECT_EQ(shownScene(), "workspace") << "the scene stays meanwhile";
  send(CancelLoading{});
  frame();
  EXPECT_EQ(shown().browser.loading, "");
  EXPECT_EQ(shownScene(), "workspace");
  EXPECT_EQ(workspace_->problem(), "") << "which is no error";
}

TEST_F(Opening, FirstPictureIsTheThumbnailOfForeignFiles) {
  const auto thumbnail = [&] { return workspace_->browser().thumbnails().at(shown().browser.shown); };
  Image8 picture(960, 400);
  for (int x = 0; x < picture.width; ++x) {
    std::fill_n(picture.at(x, 0), 4, uint8_t(7));
  }
  const auto expectThumbnail = [&](const char* of) {
    EXPECT_EQ(thumbnail().width, 0) << of;
    EXPECT_EQ(workspace_->browser().thumbnail().width, 0) << of;
    workspace_->browser().takeListed();
    drawFrame(picture);
    EXPECT_TRUE(workspace_->browser().takeListed());
    drawFrame(Image8(4, 4));
    EXPECT_FALSE(workspace_->browser().takeListed()) << "once";
    const Image8 small = thumbnail();
    ASSERT_EQ(small.width, 192) << of;
    EXPECT_EQ(workspace_->browser().thumbnail().width, 192) << of;
    EXPECT_LT(*small.at(90, 0), 215) << "the dark row";
    EXPECT_GT(*small.at(90, 50), 245);
  };
  expectThumbnail("the scene of the start");
  drop({model("queen.obj")});
  expectThumbnail("a model");
  send(SaveAs{home_.path() / "saved.toml"});
  expectThumbnail("a saved scene");
  options_.scene = (home_.path() / "saved.toml").string();
  start();
  EXPECT_EQ(thumbnail().width, 192) << "in later sessions";
  const auto frameDrawn = [&](const std::function<Image8()>& read) {
    workspace_->frameDrawn({scene(), workspace_->state(0.0), workspace_->settings(), width, height}, read, nullptr);
  };
  frameDrawn([]() -> Image8 { throw OutOfMemoryError("no memory"); });
  drop({sceneFile("no_mirror")});
  EXPECT_EQ(workspace_->browser().thumbnail().width, 192);
  frameDrawn([&] {
    ADD_FAILURE() << "a scene that comes with a thumbnail needs no picture";
    return picture;
  });
}

TEST_F(Opening, BrokenThumbnailsAreWarnedOfOnce) {
  fs::create_directories(home_.path() / "thumbnails");
  fs::copy_file(options_.scene, home_.path() / "own.toml");
  std::ofstream(home_.path() / "thumbnails" / "own.jpg") << "no picture";
  options_.scene = (home_.path() / "own.toml").string();
  start();
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(workspace_->browser().thumbnail().width, 0);
    EXPECT_EQ(workspace_->browser().thumbnails().at(shown().browser.shown).width, 0);
  }
  EXPECT_EQ(std::ranges::count_if(shown().log.lines(), [](const auto& line) { return contains(line.text, "own.jpg"); }),
            1);
}

TEST_F(Opening, ThumbnailsFollowTheList) {
  const std::vector<Image8> pictures = workspace_->browser().thumbnails();
  const ShownScenes& browser = shown().browser;
  ASSERT_EQ(pictures.size(), browser.scenes.size());
  for (size_t i = 0; i < pictures.size(); ++i) {
    EXPECT_EQ(pictures[i].width, i == browser.shown ? 0 : 192) << browser.scenes[i].name;
  }
}

}  // namespace
}  // namespace speculum
