// The window draws when something changes, and only then.
#include <algorithm>
#include <fstream>

#include "app/screenshot.hpp"
#include "demo_window_support.hpp"
#include "frame/settings.hpp"

namespace speculum {
namespace {

using namespace testing_support;

Options idleOptions(Options options = {}) {
  options.settings.emplace_back("view.continuous", "false");
  return options;
}

class IdleWindow : public DemoWindow {
 protected:
  explicit IdleWindow(const std::string& toml = windowScene, const Options& more = {})
      : DemoWindow(toml, idleOptions(more), 1) {}

  // Frames drawn within so many seconds, and how often the loop went round.
  struct Drawn {
    int frames = 0;
    int steps = 0;
  };
  Drawn during(double seconds) {
    const int before = demo_->framesDrawn();
    Drawn drawn;
    const auto end = Clock::now() + std::chrono::duration<double>(seconds);
    while (Clock::now() < end) {
      EXPECT_TRUE(demo_->step());
      ++drawn.steps;
    }
    drawn.frames = demo_->framesDrawn() - before;
    return drawn;
  }
  // Whether it goes on drawing: so many frames more, however slow the machine is. What changes once draws fewer
  // than 10.
  bool draws(int frames) {
    const int last = demo_->framesDrawn() + frames;
    const auto end = Clock::now() + std::chrono::seconds(20);
    while (demo_->framesDrawn() < last && Clock::now() < end) {
      EXPECT_TRUE(demo_->step());
    }
    return demo_->framesDrawn() >= last;
  }
  // Until half a second has gone by without a frame.
  void settle() {
    const auto end = Clock::now() + std::chrono::seconds(20);
    while (during(0.5).frames > 0) {
      ASSERT_LT(Clock::now(), end) << "something goes on drawing";
    }
  }
  // Without the figures of the panel, which differ from frame to frame.
  std::vector<uint8_t> rightOfThePanel() {
    const Pixels pixels = picture();
    std::vector<uint8_t> right;
    for (size_t y = 0; y < pixels.extent.height; ++y) {
      const auto row = pixels.rgba.begin() + static_cast<std::ptrdiff_t>(4 * y * pixels.extent.width);
      right.insert(right.end(), row + 4 * 450, row + 4 * static_cast<std::ptrdiff_t>(pixels.extent.width));
    }
    return right;
  }
  const UiPass& mainView() {
    const std::vector<UiPass>& passes = demo_->model().passes;
    return *std::find_if(passes.begin(), passes.end(), [](const auto& pass) { return pass.kind == PassKind::main; });
  }
  void pointAt(int x, int y) { xdotool({"mousemove", "--window", windowId(), std::to_string(x), std::to_string(y)}); }
};

TEST_F(IdleWindow, AHeldStickKeepsItDrawing) {
  settle();
  std::optional<GamepadState> pad = GamepadState{};
  demo_->setGamepadSource([&] { return pad; });
  EXPECT_EQ(during(0.5).frames, 0) << "a gamepad at rest";
  pad->leftX = 1.0f;
  EXPECT_TRUE(draws(15));
  pad.reset();
  settle();
  demo_->setGamepadSource([] { return std::nullopt; });
}

Options withoutChecks() {
  Options options;
  options.settings.emplace_back("debug.check_finite", "false");
  return options;
}

// Of every frame's picture nothing is checked, so that not every frame has to draw it.
class UncheckedWindow : public IdleWindow {
 protected:
  UncheckedWindow() : IdleWindow(windowScene, withoutChecks()) {}
};

// The panel is drawn anew over the picture that is there.
TEST_F(UncheckedWindow, ThePictureIsDrawnOnlyWhenItChanges) {
  settle();
  const std::vector<uint8_t> before = rightOfThePanel();
  for (int y = 60; y < 400; y += 40) {
    pointAt(60, y);
    ASSERT_TRUE(draws(2));
    EXPECT_GT(mainView().framesAgo, 0) << "pointing at " << y;
    EXPECT_GT(mainView().gpuMs, 0.0) << "its price is known all the same";
  }
  pointAt(width - 100, 80);
  settle();
  EXPECT_TRUE(rightOfThePanel() == before);
  const int last = mainView().framesAgo;
  xdotool({"keydown", "--window", windowId(), "w"});
  EXPECT_TRUE(draws(3));
  xdotool({"keyup", "--window", windowId(), "w"});
  settle();
  EXPECT_LT(mainView().framesAgo, last);
  EXPECT_FALSE(rightOfThePanel() == before);
  expectQuiet();
}

TEST_F(UncheckedWindow, ThePictureIsDrawnWhileItsDepthIsLookedAt) {
  settle();
  click("panel.Targets");
  click("targets.depth");
  const PixelRect canvas = widget("targets.canvas");
  pointAt(canvas.x + canvas.width / 2, canvas.y + canvas.height / 2);
  settle();
  const std::optional<UiTexel>& value = demo_->model().targets.value;
  ASSERT_TRUE(value && value->depth);
  const double middle = value->metres;
  EXPECT_NEAR(middle, 6.0, 0.01) << "the mirror, 6 m from the eye";
  for (const int left : {10, 20, 30}) {
    pointAt(canvas.x + canvas.width / 2 - left, canvas.y + canvas.height / 2);
    ASSERT_TRUE(draws(4));
    EXPECT_EQ(mainView().framesAgo, 0);
    ASSERT_TRUE(value && value->depth);
    EXPECT_NEAR(value->metres, middle, 1e-5) << "of a frame without the scene there is no depth";
  }
  click("panel.Targets");
  settle();
  pointAt(60, 60);
  ASSERT_TRUE(draws(2));
  EXPECT_GT(mainView().framesAgo, 0) << "nobody looks at it any more";
  expectQuiet();
}

TEST_F(UncheckedWindow, AnotherSizeAndAnotherSceneAreDrawn) {
  settle();
  press("Tab");
  settle();
  const auto expectAsRendered = [&](const std::filesystem::path& file, PictureSize size) {
    Options options = headless(file, size);
    set(options, {{"view.exposure", settingValue(demo_->model().settings, "view.exposure")}});
    EXPECT_TRUE(pictureOf(picture()).rgba == draw(options).rgba) << file << " at " << size.width;
  };
  expectAsRendered(options_.scene, {width, height});
  demo_->window().resize(500, 400);
  ASSERT_TRUE(draws(1));
  settle();
  expectAsRendered(options_.scene, {500, 400});
  std::string toml = windowScene;
  toml.replace(toml.find("[0.9, 1, 0]"), 11, "[-0.9, 1, 0]");
  const std::filesystem::path other = writeScene("other", toml);
  const int shown = demo_->model().scene;
  demo_->openFile(other);
  ASSERT_TRUE(draws(3));
  settle();
  ASSERT_NE(demo_->model().scene, shown);
  press("Escape");
  settle();
  expectAsRendered(other, {500, 400});
  expectQuiet();
}

TEST_F(IdleWindow, DrawsNothingUntilThePointerMoves) {
  settle();
  const Drawn idle = during(1.5);
  EXPECT_EQ(idle.frames, 0);
  EXPECT_LE(idle.steps, 40) << "it must sleep, not spin";
  pointAt(width - 100, 80);
  EXPECT_TRUE(draws(3));
  settle();
  EXPECT_EQ(during(1.0).frames, 0);
  expectQuiet();
}

TEST_F(IdleWindow, ThePanelFollowsThePointer) {
  settle();
  const Pixels before = picture();
  const PixelRect box = widget("view.wireframe");
  pointAt(box.x + 5, box.y + 5);
  during(0.5);
  settle();
  const Pixels hovered = picture();
  EXPECT_NE(before.rgba, hovered.rgba) << "the tooltip is shown";
  xdotool({"mousedown", "1"});
  during(0.3);
  xdotool({"mouseup", "1"});
  during(0.3);
  EXPECT_TRUE(demo_->model().settings.view.wireframe);
  settle();
  EXPECT_EQ(demo_->model().passes.size(), 3u);
  expectQuiet();
}

TEST_F(IdleWindow, KeysAndSizeAreFollowed) {
  settle();
  const Pixels before = picture();
  xdotool({"keydown", "--window", windowId(), "d"});
  EXPECT_TRUE(draws(15)) << "the camera moves as long as the key is held";
  xdotool({"keyup", "--window", windowId(), "d"});
  settle();
  EXPECT_NE(before.rgba, picture().rgba);
  demo_->window().resize(500, 400);
  EXPECT_TRUE(draws(1));
  settle();
  EXPECT_EQ(picture().extent.width, 500u);
  expectQuiet();
}

TEST_F(IdleWindow, HeldImagesAreRenewedBeforeItRests) {
  settle();
  demo_->setCapture(true);
  pointAt(25, 400);
  for (int i = 0; i < 3; ++i) {
    xdotool({"click", "5"});
    during(0.3);
  }
  settle();
  const PixelRect interval = widget("reflection.update_interval");
  pointAt(interval.x + 5, interval.y + 5);
  during(0.3);
  xdotool({"mousedown", "1"});
  during(0.3);
  pointAt(interval.x + interval.width / 2, interval.y + 5);
  during(0.3);
  xdotool({"mouseup", "1"});
  settle();
  ASSERT_GT(demo_->model().settings.reflection.updateInterval, 4);
  pointAt(width - 100, 80);
  xdotool({"mousedown", "1"});
  during(0.2);
  pointAt(width - 160, 100);
  xdotool({"mouseup", "1"});
  settle();
  const std::vector<uint8_t> rested = rightOfThePanel();
  pointAt(width - 161, 100);
  settle();
  EXPECT_EQ(rested, rightOfThePanel()) << "the mirror's image was not the newest";
  expectQuiet();
}

class IdleWindowThatMoves : public IdleWindow {
 protected:
  IdleWindowThatMoves()
      : IdleWindow(std::string(windowScene).replace(windowScene.find("[[light]]"), 0, "spin = [0, 90, 0]\n")) {}
};

TEST_F(IdleWindowThatMoves, DrawsUntilItIsPaused) {
  EXPECT_TRUE(draws(15));
  const PixelRect pause = widget("pause");
  pointAt(pause.x + 5, pause.y + 5);
  during(0.2);
  xdotool({"mousedown", "1"});
  during(0.2);
  xdotool({"mouseup", "1"});
  during(0.2);
  ASSERT_TRUE(demo_->model().paused);
  settle();
  EXPECT_EQ(during(1.0).frames, 0);
  expectQuiet();
}

struct OwnShaders {
  OwnShaders() { writeShaders(shaders.path(), "scene_shading.glsl", ""); }
  Options options() const {
    Options options;
    options.shaderDir = shaders.path();
    return options;
  }
  TemporaryDirectory shaders;
};

class IdleWindowWithShaders : protected OwnShaders, public IdleWindow {
 protected:
  IdleWindowWithShaders() : IdleWindow(windowScene, options()) {}
};

TEST_F(IdleWindowWithShaders, AShaderThatBreaksIsReported) {
  settle();
  const auto before = background();
  const std::filesystem::path file = shaders.path() / "scene.frag";
  std::ofstream(file, std::ios::app) << "\nthis is not GLSL\n";
  std::filesystem::last_write_time(file, std::filesystem::last_write_time(file) + std::chrono::seconds(1));
  EXPECT_GT(during(3.0).frames, 0);
  EXPECT_NE(demo_->model().message.find("scene.frag"), std::string::npos) << demo_->model().message;
  EXPECT_EQ(background(), before);
  settle();
  EXPECT_EQ(demo_->device().validationMessages(), 0);
}

}  // namespace
}  // namespace speculum
