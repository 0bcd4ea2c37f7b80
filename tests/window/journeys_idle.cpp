// The window draws when something changes, and only then; what it measures meanwhile.
#include <imgui_internal.h>

#include "platform/files.hpp"
#include "platform/text.hpp"
#include "test_paths.hpp"
#include "ui/panel_support.hpp"
#include "window/journeys_support.hpp"

namespace speculum {
namespace {

using namespace testing_support;

Options idle() {
  Options options;
  options.settings = {{"view.continuous", "false"}, {"reflection.skip_unchanged", "true"}};
  return options;
}

class IdleWindow : public Journey {
 protected:
  IdleWindow() : Journey(wallScene, idle()) { settle(); }

  // Returns the frames drawn and steps made within so many seconds.
  std::pair<int, int> during(double seconds) {
    const int before = demo_->framesDrawn();
    int steps = 0;
    for (const auto end = Clock::now() + std::chrono::duration<double>(seconds); Clock::now() < end; ++steps) {
      EXPECT_TRUE(demo_->step());
    }
    return {demo_->framesDrawn() - before, steps};
  }
  void expectFrames(int frames) {
    const int before = demo_->framesDrawn();
    run(frames);
    EXPECT_GE(demo_->framesDrawn(), before + frames) << "something moves";
  }
  void pointAt(int x, int y) { xdotool({"mousemove", "--window", window_, std::to_string(x), std::to_string(y)}); }
  // Turns the camera, and returns the scale that it is drawn with meanwhile.
  double drag(int to) {
    pointAt(width - 100, 80);
    settle();
    xdotool({"mousedown", "1"});
    run(2);
    pointAt(to, 100);
    run(2);
    const double scale = demo_->frameSettings().view.scale;
    xdotool({"mouseup", "1"});
    settle();
    EXPECT_EQ(demo_->frameSettings().view.scale, 1.0);
    return scale;
  }
  PassRow mainView() {
    const std::vector<PassRow>& passes = shown().frame.passes;
    return *std::ranges::find(passes, PassKind::main, &PassRow::kind);
  }
  // Returns the picture without the panel, whose figures differ from frame to frame, and without the messages below,
  // which go after some seconds.
  std::vector<uint8_t> rightOfThePanel() {
    const Image8 image = picture();
    constexpr int messages = 100;
    std::vector<uint8_t> right;
    for (int y = 0; y < image.height - messages; ++y) {
      right.insert(right.end(), image.at(450, y), image.at(450, y) + static_cast<size_t>(4) * (image.width - 450));
    }
    return right;
  }
};

TEST_F(IdleWindow, DrawsNothingUntilSomethingHappens) {
  const auto [frames, steps] = during(0.5);
  EXPECT_EQ(frames, 0);
  EXPECT_LE(steps, 15) << "it must sleep, not spin";
  const PixelRect box = widget("view.wireframe");
  const std::vector<uint8_t> before = rightOfThePanel();
  pointAt(box.x + 5, box.y + 5);
  run(2);
  EXPECT_GT(mainView().framesAgo, 0) << "only the panel is drawn";
  EXPECT_GT(mainView().gpuMs, 0.0) << "its price is known all the same";
  pointAt(width - 100, 80);
  settle();
  EXPECT_TRUE(rightOfThePanel() == before);
  xdotool({"keydown", "--window", window_, "d"});
  expectFrames(12);
  xdotool({"keyup", "--window", window_, "d"});
  settle();
  EXPECT_FALSE(rightOfThePanel() == before) << "the camera moves as long as the key is held";
  std::optional<GamepadState> pad = GamepadState{};
  demo_->setGamepadSource([&] { return pad; });
  EXPECT_EQ(during(0.3).first, 0) << "a gamepad at rest";
  pad->leftX = 1.0f;
  expectFrames(12);
  pad.reset();
  settle();
  demo_->setGamepadSource([] { return std::nullopt; });
  demo_->apply(OpenScene{writeScene("turning", wallScene + "spin = [0, 90, 0]\n")});
  ASSERT_TRUE(waitFor([&] { return shownScene().name == "turning"; }));
  expectFrames(15);
  press("space");
  ASSERT_TRUE(shown().playback.paused);
  settle();
}

TEST_F(IdleWindow, TargetsShowTexels) {
  click("panel.Targets");
  run(3);
  click("targets.one");
  const PixelRect canvas = widget("targets.canvas");
  const auto valueAt = [&](int left) {
    pointAt(canvas.x + canvas.width / 2 - left, canvas.y + canvas.height / 2);
    run(4);
    EXPECT_TRUE(shown().frame.target.complete);
    EXPECT_TRUE(shown().frame.target.value);
    return shown().frame.target.value.value_or(TexelValue{});
  };
  const TexelValue color = valueAt(0);
  EXPECT_FALSE(color.depth);
  EXPECT_EQ(shown().frame.target.size, glm::ivec2(width, height));
  EXPECT_EQ(shown().frame.target.mirrors.size(), 1u);
  click("targets.depth");
  for (const int left : {0, 10, 20}) {
    const TexelValue depth = valueAt(left);
    EXPECT_TRUE(depth.depth);
    EXPECT_NEAR(shown().frame.target.near / depth.storedDepth, 6.0, 0.01) << "without the scene there is no depth";
  }
  EXPECT_GT(mainView().framesAgo, 0) << "the finished picture stays";
  click("panel.Targets");
  moveTo(width - 5, height - 5);  // away from what has a tooltip
  settle();
  hidePanels();
  settle();
  for (int i = 0; i < 3; ++i) {
    const double shown = 255.0 * srgbEncode(std::clamp(color.value[i], 0.0f, 1.0f));
    EXPECT_NEAR(picture().at(color.texel.x, color.texel.y)[i], shown, 0.6);
  }
}

TEST_F(IdleWindow, GalleryShowsAndOpensScenes) {
  click("panel.Scenes");
  settle();
  PixelRect tile = widget("gallery.bounced_light");
  tile.height = tile.width * 108 / 192;  // without the title
  const Image8 gallery = picture();
  const auto meanDifference = [&](const char* name) {
    const Image8 thumbnail = readImage8(sourceFile("scenes/thumbnails/" + std::string(name) + ".jpg"));
    double sum = 0.0;
    for (int y = 0; y < tile.height; ++y) {
      for (int x = 0; x < tile.width; ++x) {
        const uint8_t* a = gallery.at(tile.x + x, tile.y + y);
        const uint8_t* b = thumbnail.at(x * thumbnail.width / tile.width, y * thumbnail.height / tile.height);
        sum += std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]);
      }
    }
    return sum / (3.0 * tile.width * tile.height);
  };
  EXPECT_LT(meanDifference("bounced_light"), 10.0);
  EXPECT_GT(meanDifference("facing_mirrors"), 20.0);
  demo_->apply(SetPaused{true});
  click("gallery.facing_mirrors");
  ASSERT_TRUE(waitFor([&] { return shownScene().name == "facing_mirrors"; }));
  EXPECT_EQ(shownScene().title, "Facing mirrors");
  hidePanels();
  constexpr PictureSize other{500, 400};
  demo_->window().resize(other.width, other.height);
  ASSERT_TRUE(waitFor([&] { return demo_->renderer().displayExtent().width == uint32_t(other.width); }));
  settle();
  Options options = headless(sceneFile("facing_mirrors"), other, {{"view.samples", "1"}, {"reflection.samples", "1"}});
  EXPECT_TRUE(picture().rgba == draw(options, shown().playback.time).rgba);
}

TEST_F(IdleWindow, StillPicturesConvergeAndMotionIsLowered) {
  hidePanels();
  settle();
  Settings settings = shown().settings;
  settings.quality.stillPictures = 5;
  demo_->apply(SetSettings{settings});
  pointAt(width - 100, 90);  // wakes the window
  run(2);
  EXPECT_FALSE(contains(shown().status.picture, "5 of")) << "one picture in each frame";
  settle();
  EXPECT_EQ(shown().status.picture, "5 of 5 pictures averaged");
  const Image8 shown = picture();
  demo_->apply(CopyCommandLine{});
  const std::string command = demo_->window().clipboard();
  EXPECT_TRUE(contains(command, "view.accumulate=5"));
  const ProcessResult result = runProcess(
      {"bash", "-c", "cd '" + home_.path().string() + "' && PATH=" + binaryDir().string() + ":$PATH && " + command});
  ASSERT_EQ(result.exitCode, 0) << command << "\n" << result.output;
  EXPECT_TRUE(readImage8(home_.path() / "journey.view.png").rgba == shown.rgba) << command;
  settings.quality.stillPictures = 1;
  demo_->apply(SetSettings{settings});
  EXPECT_EQ(drag(width - 160), 1.0) << "never, with 0";
  const std::vector<uint8_t> exact = rightOfThePanel();
  demo_->apply(ResetCamera{});
  settings.quality.motionMs = 0.01;
  demo_->apply(SetSettings{settings});
  EXPECT_LT(drag(width - 160), 0.27);
  EXPECT_TRUE(rightOfThePanel() == exact);
}

// A window that has this time for moving frames.
class PacedWindow : public Journey {
 protected:
  explicit PacedWindow(const char* motionMs = "0.01") : Journey(wallScene, paced(motionMs)) {}

  static Options paced(const char* motionMs) {
    Options options = idle();
    options.settings.emplace_back("quality.motion_ms", motionMs);
    return options;
  }
  // Returns the mean color of a square.
  static glm::dvec3 meanOf(const Image8& image, const glm::ivec2& middle, int half) {
    glm::dvec3 sum(0.0);
    for (int i = 0; i < 4 * half * half; ++i) {
      const uint8_t* code = image.at(middle.x - half + i % (2 * half), middle.y - half + i / (2 * half));
      sum += glm::dvec3(code[0], code[1], code[2]);
    }
    return sum / (4.0 * half * half);
  }
};

TEST_F(PacedWindow, SlowScenesOpenStillBelowTheirThumbnail) {
  demo_->apply(OpenScene{sceneFile("no_mirror")});
  ASSERT_TRUE(waitFor([&] { return shownScene().name == "no_mirror"; }));
  const Image8 thumbnail = readImage8(sourceFile("scenes/thumbnails/no_mirror.jpg"));
  int covered = 0;
  EXPECT_TRUE(waitFor([&] {
    if (shown().browser.poster && ++covered == 3) {
      EXPECT_TRUE(startsWith(shown().status.picture, "Preview. ")) << shown().status.picture;
      const double scale = std::max(width / 192.0, height / 108.0);
      const Image8 window = picture();
      for (const glm::ivec2 at : {glm::ivec2(130, 54), glm::ivec2(170, 20), glm::ivec2(170, 90)}) {
        const glm::dvec2 middle = 0.5 * glm::dvec2(width, height) + scale * glm::dvec2(at - glm::ivec2(96, 54));
        const glm::dvec3 shown = meanOf(window, glm::ivec2(middle), static_cast<int>(10 * scale));
        EXPECT_LT(glm::distance(shown, meanOf(thumbnail, at, 10)), 8.0) << at.x << " " << at.y;
      }
    }
    return shown().playback.paused;
  }));
  EXPECT_GE(covered, 3);
  EXPECT_EQ(shown().playback.time, 0.0);
  EXPECT_TRUE(startsWith(shown().playback.cost, "Play (about "));
  settle();
  EXPECT_FALSE(shown().browser.poster);
  EXPECT_EQ(demo_->frameSettings().view.scale, 1.0) << "the whole picture";
  click("play");
  run(10);
  EXPECT_FALSE(shown().playback.paused);
  EXPECT_GT(shown().playback.time, 0.0);
}

TEST_F(PacedWindow, PanelsMayBeUsedBelowTheThumbnail) {
  demo_->apply(OpenScene{sceneFile("no_mirror")});
  ASSERT_TRUE(waitFor([&] { return shownScene().name == "no_mirror" && shown().playback.paused; }));
  ASSERT_TRUE(shown().browser.poster);
  const auto noDraftIsSeen = [&] { return shown().browser.poster || !contains(shown().status.picture, "Draft"); };
  click("panel.Targets");
  EXPECT_TRUE(noDraftIsSeen());
  click("panel.Targets");
  EXPECT_TRUE(noDraftIsSeen()) << "the whole picture alone may end the cover";
  clickAt(width - 100, 80);
  EXPECT_FALSE(shown().browser.poster) << "the picture is clicked";
}

struct DrawnPanels : PanelTest {
  using PanelTest::shownText;
};

TEST_F(PacedWindow, CompilingIsNotSaidBesideAPicture) {
  std::filesystem::copy_file(options_.scene, home_.path() / "bare.toml");
  for (const std::filesystem::path& scene : {sceneFile("no_mirror"), home_.path() / "bare.toml"}) {
    demo_->apply(OpenScene{scene});
    int drawn = demo_->framesDrawn();
    int uncovered = 0;
    bool poster = false;
    bool said = false;
    ASSERT_TRUE(waitFor([&] {
      const bool covered = std::exchange(poster, shown().browser.poster) || poster;
      const bool draws = std::exchange(drawn, demo_->framesDrawn()) != drawn && shownScene().file == scene;
      const bool says = contains(DrawnPanels::shownText(), "Compiling");
      said = said || says;
      EXPECT_FALSE(draws && says && !covered) << scene;
      uncovered += draws && !covered;
      return uncovered > 3;
    }));
    EXPECT_EQ(said, scene.stem() == "no_mirror") << "below the thumbnail";
  }
}

TEST_F(PacedWindow, NothingCoversLessons) {
  const std::vector<ShownSplit::LessonEntry> lessons = shown().split.lessons;
  demo_->apply(OpenScene{.file = lessons.at(0).scene, .lesson = 0});
  int frames = 0;
  ASSERT_TRUE(waitFor([&] {
    EXPECT_FALSE(shown().split.on && shown().browser.poster);
    frames += shown().split.on;
    return frames >= 6;
  }));
}

TEST_F(PacedWindow, NothingCoversScenesWithoutThumbnails) {
  const std::filesystem::path file = home_.path() / "bare.toml";
  std::filesystem::copy_file(options_.scene, file);
  demo_->apply(OpenScene{file});
  ASSERT_TRUE(waitFor([&] { return shownScene().name == "bare"; }));
  const int drawn = demo_->framesDrawn();
  ASSERT_TRUE(waitFor([&] { return demo_->framesDrawn() >= drawn + 2; }));
  EXPECT_FALSE(shown().browser.poster) << "a draft is more than a title";
}

TEST_F(PacedWindow, NewScenesAreCoveredFromTheirFirstFrame) {
  demo_->apply(OpenScene{sceneFile("no_mirror")});
  int drawn = demo_->framesDrawn();
  ASSERT_TRUE(waitFor([&] {
    const bool isNew = shownScene().name == "no_mirror";
    drawn = isNew ? drawn : demo_->framesDrawn();
    return isNew;
  }));
  EXPECT_TRUE(shown().browser.poster || demo_->framesDrawn() == drawn);
}

class FastWindow : public PacedWindow {
 protected:
  FastWindow() : PacedWindow("100000") {}
};

TEST_F(FastWindow, ScenesOpenMoving) {
  demo_->apply(OpenScene{sceneFile("no_mirror")});
  ASSERT_TRUE(waitFor([&] { return shownScene().name == "no_mirror"; }));
  run(12);
  EXPECT_FALSE(shown().playback.paused || shown().browser.poster);
  EXPECT_EQ(shown().playback.cost, "");
  EXPECT_GT(shown().playback.time, 0.0);
}

// Without a mirror there is little to vary, and the measurement is soon done. It runs while nothing else does, and so
// the window does not draw all the time.
class AccuracyJourney : public Journey {
 protected:
  // A small picture is soon traced; it has room for two columns of panels.
  AccuracyJourney() : Journey(wallScene.substr(0, wallScene.find("[[mirror]]")), idle()) {
    demo_->window().resize(640, small);
    run(3);
    click("panel.Accuracy");
  }

  static constexpr int small = 640;
};

TEST_F(AccuracyJourney, MeasuresTheViewAndShowsTheDifference) {
  click("accuracy.measure");
  ASSERT_TRUE(waitFor([&] { return shown().accuracy.measuring; }));
  demo_->apply(CancelMeasurement{});
  ASSERT_TRUE(waitFor([&] { return !shown().accuracy.measuring; }));
  EXPECT_TRUE(shown().accuracy.points.empty());
  run(2);
  Settings settings = shown().settings;
  settings.quality.maxError = 0.9;
  demo_->apply(SetSettings{settings});
  settings.view.exposure = 2.0;
  demo_->apply(SetSettings{settings});
  demo_->apply(Undo{});
  run(2);
  const int before = demo_->framesDrawn();
  click("accuracy.measure");
  ASSERT_TRUE(waitFor([&] { return !shown().accuracy.points.empty(); })) << shown().accuracy.about;
  ASSERT_TRUE(waitFor([&] { return !shown().accuracy.measuring; })) << "roughly first";
  EXPECT_GT(demo_->framesDrawn(), before + 5) << "the window goes on meanwhile";
  run(3);
  const ShownAccuracy& measured = shown().accuracy;
  ASSERT_EQ(measured.points.size(), 2u) << "one sample and four";
  ASSERT_FALSE(measured.front.empty());
  EXPECT_GT(measured.noiseFloor, 0.0);
  EXPECT_GT(measured.points[0].ms, 0.0);
  EXPECT_EQ(measured.current, measured.front.front()) << "the bound chose it";
  EXPECT_EQ(shown().edit.undo, "change Max. mean FLIP");
  EXPECT_EQ(shown().edit.redo, "change Exposure") << "no step of the user's";
  // The most accurate point takes four samples. A busy machine may measure it as the cheapest, and it is chosen
  // already.
  const int best = measured.front.back();
  click("accuracy.point " + measured.points[static_cast<size_t>(best)].name);
  EXPECT_EQ(measured.current, best);
  EXPECT_EQ(shown().settings.view.samples, 4);
  setSetting("quality.max_error", "0.5");
  run(2);
  EXPECT_TRUE(contains(measured.choice, "mean FLIP"));
  EXPECT_EQ(measured.current, measured.front.front()) << "the cheapest that keeps the bound";

  EXPECT_FALSE(std::filesystem::is_empty(userCacheDir() / "sweeps")) << "kept for the next time";
  EXPECT_FALSE(measured.otherView);
  press("f");
  EXPECT_TRUE(measured.otherView) << "the plot is of another view";
  demo_->apply(ResetCamera{});
  moveTo(180, 300);  // wakes the window
  EXPECT_FALSE(measured.otherView) << "nothing moves, though time goes on";
  demo_->apply(SetPaused{true});
  run(1);
  const Image8 plain = picture();
  click("accuracy.difference");
  ASSERT_TRUE(waitFor([&] { return measured.difference.find("Mean FLIP") == 0; })) << measured.difference;
  run(3);
  // The background is right: the darkest color of the map, at the window's left edge below the panel.
  const Image8 heat = picture();
  const uint8_t* corner = heat.at(3, small - 3);
  EXPECT_NE(corner[0], plain.at(3, small - 3)[0]);
  EXPECT_LT(corner[0] + corner[1] + corner[2], 90);
  // The plot and the map show one error of one point.
  setSetting("quality.still_pictures", "12");  // too few for a decision whether they have converged
  EXPECT_TRUE(waitFor([&] { return contains(measured.difference, "Mean FLIP of the mean of 12 pictures: "); }))
      << measured.difference;
  click("accuracy.point " + measured.points[static_cast<size_t>(best)].name);
  const std::string error = significant(measured.points[static_cast<size_t>(best)].error, 3);
  EXPECT_TRUE(waitFor([&] { return contains(measured.difference, "Mean FLIP of one picture: " + error + "."); }))
      << error << ", but " << measured.difference;
  const std::string first = measured.difference;
  setSetting("view.exposure", "0.5");
  EXPECT_TRUE(waitFor([&] { return measured.difference != first; })) << "another setting, another difference";
  click("accuracy.difference");
  run(3);
  EXPECT_GT(picture().at(3, small - 3)[2], 60) << "the picture is back";
}

}  // namespace
}  // namespace speculum
