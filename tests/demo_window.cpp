// The window as a person uses it: real X events under a window manager, pictures compared.
#include <random>

#include "core/handle.hpp"
#include "demo_window_support.hpp"
#include "image/color.hpp"

namespace speculum {
namespace {

using namespace testing_support;

TEST_F(DemoWindow, DrawsTwoHundredFrames) {
  run(200);
  EXPECT_GE(demo_->framesDrawn(), 200);
  expectQuiet();
}

TEST_F(DemoWindow, ClearColorEditedInThePanelReachesPictureAndReflections) {
  const auto before = background();
  const Pixels reflectedBefore = picture();
  drag("view.clear_color", 0.1, 120);
  const auto after = background();
  EXPECT_GT(after[0], before[0] + 20) << "the red field was dragged to the right";
  EXPECT_EQ(after[1], before[1]);
  const auto& color = demo_->model().settings.view.clearColor;
  ASSERT_TRUE(color);
  EXPECT_NEAR(after[0], 255.0 * srgbEncode(color->x), 1.0);
  // The middle of the wall mirror reflects the background as well.
  const Pixels reflectedAfter = picture();
  const size_t middle = 4 * (static_cast<size_t>(height / 2 - 60) * width + width - 160);
  EXPECT_GT(reflectedAfter.rgba[middle], reflectedBefore.rgba[middle] + 10);
  expectQuiet();
}

TEST_F(DemoWindow, PassesSayWhatDepthResolves) {
  const auto passes = [&] { return demo_->model().passes; };
  ASSERT_EQ(passes().size(), 3u);
  ASSERT_TRUE(passes()[0].resolution);
  EXPECT_GT(passes()[0].resolution->distance, 6.0) << "the light, seen in the mirror";
  EXPECT_GT(passes()[0].resolution->clipDistance, 0.0);
  EXPECT_FALSE(passes()[1].resolution) << "not a mirror's";
  expectQuiet();
}

TEST_F(DemoWindow, SettingsEditedInThePanelChangeThePicture) {
  ASSERT_GT(demo_->model().passes.size(), 2u);
  const int grip = static_cast<int>(widget("reflection.max_depth").width * 0.3);
  drag("reflection.max_depth", 0.3, 3 - grip);
  EXPECT_EQ(demo_->model().settings.reflection.maxDepth, 0);
  run(3);
  EXPECT_EQ(demo_->model().passes.size(), 2u) << "main view and display pass only";
  ASSERT_FALSE(demo_->model().skipped.empty());
  EXPECT_EQ(demo_->model().skipped[0].reason, "max_depth");

  const auto before = background();
  drag("view.exposure", 0.5, 60);
  EXPECT_GT(background()[2], before[2]);
  expectQuiet();
}

TEST_F(DemoWindow, KeysHideThePanelAndQuit) {
  const Pixels with = picture();
  xdotool({"key", "--window", windowId(), "Tab"});
  run(5);
  const Pixels without = picture();
  EXPECT_NE(with.rgba, without.rgba);
  const size_t inPanel = 4 * (static_cast<size_t>(300) * width + 30);
  EXPECT_NE(with.rgba[inPanel], without.rgba[inPanel]);
  xdotool({"key", "--window", windowId(), "Tab"});
  run(5);
  EXPECT_EQ(picture().rgba[inPanel], with.rgba[inPanel]);
  press("Escape");
  xdotool({"key", "--window", windowId(), "ctrl+q"});
  const auto end = Clock::now() + std::chrono::seconds(10);
  while (demo_->step() && Clock::now() < end) {
  }
  EXPECT_TRUE(demo_->window().shouldClose());
  expectQuiet();
}

TEST_F(DemoWindow, DraggingThePictureTurnsTheCamera) {
  const Pixels before = picture();
  moveTo(width - 100, 80);
  xdotool({"mousedown", "1"});
  run(2);
  moveTo(width - 220, 110);
  xdotool({"mouseup", "1"});
  run(3);
  EXPECT_NE(before.rgba, picture().rgba);
  expectQuiet();
}

TEST_F(DemoWindow, TwoHundredRandomResizesLeakNothing) {
  std::mt19937 random(42);
  std::uniform_int_distribution<int> side(1, 700);
  const auto resizeTo = [&](int w, int h) {
    demo_->window().resize(w, h);
    for (int i = 0; i < 2; ++i) {
      ASSERT_TRUE(demo_->step());
    }
  };
  demo_->setCapture(false);
  resizeTo(1, 1);  // where mirrors are too small for passes, which is another pipeline
  resizeTo(400, 300);
  run(40);
  demo_->renderer().waitIdle();
  const auto objects = liveObjects();
  for (int i = 0; i < 200; ++i) {
    resizeTo(i % 20 == 0 ? 1 : side(random), i % 20 == 0 ? 1 : side(random));
  }
  resizeTo(400, 300);
  run(40);
  demo_->renderer().waitIdle();
  EXPECT_EQ(liveObjects(), objects);
  expectQuiet();
}

TEST_F(DemoWindow, ImagesAreHeldWhileTheCameraMovesAndTheWindowIsResized) {
  moveTo(25, 400);
  for (int i = 0; i < 3; ++i) {
    xdotool({"click", "5"});
    run(2);
  }
  drag("reflection.update_interval", 0.05, 200);
  ASSERT_GT(demo_->model().settings.reflection.updateInterval, 1);
  const auto heldMirrors = [&] {
    const auto& skipped = demo_->model().skipped;
    return std::count_if(skipped.begin(), skipped.end(), [](const UiSkipped& s) { return s.reason == "unchanged"; });
  };
  int held = 0;
  for (int frame = 0; frame < 8; ++frame) {
    ASSERT_TRUE(demo_->step());
    held += heldMirrors() > 0 ? 1 : 0;
    ASSERT_EQ(demo_->model().passes.size(), 3u) << "a held mirror's pass stays in the list";
  }
  EXPECT_GE(held, 4);
  moveTo(width - 100, 80);
  xdotool({"mousedown", "1"});
  for (int i = 1; i <= 5; ++i) {
    moveTo(width - 100 - 8 * i, 80 + 2 * i);
  }
  xdotool({"mouseup", "1"});
  for (int i = 0; i < 12; ++i) {
    demo_->window().resize(width - 30 * i, height - 20 * (i % 5));
    for (int frame = 0; frame < 3; ++frame) {
      ASSERT_TRUE(demo_->step());
    }
  }
  expectQuiet();
}

TEST_F(DemoWindow, IconifiedDrawsNoFrameAndComesBack) {
  demo_->window().iconify();
  auto end = Clock::now() + std::chrono::seconds(5);
  while (!demo_->window().paused() && Clock::now() < end) {
    demo_->step();
  }
  ASSERT_TRUE(demo_->window().paused());
  const int drawn = demo_->framesDrawn();
  for (int i = 0; i < 10; ++i) {
    demo_->step();
  }
  EXPECT_EQ(demo_->framesDrawn(), drawn);
  demo_->window().restore();
  end = Clock::now() + std::chrono::seconds(5);
  while (demo_->window().paused() && Clock::now() < end) {
    demo_->step();
  }
  run(5);
  EXPECT_GT(demo_->framesDrawn(), drawn);
  expectQuiet();
}

struct NegativeLight {
  NegativeLight() { writeShaders(shaders.path(), "scene_shading.glsl", "  color.b = -1.0;\n"); }
  Options options() const {
    Options options;
    options.shaderDir = shaders.path();
    return options;
  }
  TemporaryDirectory shaders;
};

class DemoWindowWithNegativeLight : protected NegativeLight, public DemoWindow {
 protected:
  DemoWindowWithNegativeLight() : DemoWindow(windowScene, options()) {}
};

TEST_F(DemoWindowWithNegativeLight, SaysWhereItIsUntilItIsGone) {
  EXPECT_EQ(demo_->model().message.rfind("mirror wall: pixel ", 0), 0u) << demo_->model().message;
  EXPECT_GT(demo_->nonFinite(), 0u);
  const std::filesystem::path shader = shaders.path() / "scene_shading.glsl";
  const auto written = std::filesystem::last_write_time(shader);
  std::filesystem::copy_file(sourceFile("shaders/scene_shading.glsl"), shader,
                             std::filesystem::copy_options::overwrite_existing);
  std::filesystem::last_write_time(shader, written + std::chrono::seconds(1));
  run(6);
  EXPECT_EQ(demo_->model().message, "");
  const uint64_t found = demo_->nonFinite();
  run(3);
  EXPECT_EQ(demo_->nonFinite(), found);
  EXPECT_EQ(demo_->device().validationMessages(), 0);
}

TEST_F(DemoWindow, CloseButtonCloses) {
  const ProcessResult closed = runProcess({"wmctrl", "-c", "Speculum"});
  ASSERT_EQ(closed.exitCode, 0) << closed.output;
  const auto end = Clock::now() + std::chrono::seconds(10);
  while (demo_->step() && Clock::now() < end) {
  }
  EXPECT_TRUE(demo_->window().shouldClose());
  expectQuiet();
}

}  // namespace
}  // namespace speculum
