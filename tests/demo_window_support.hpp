#pragma once

#include <gtest/gtest.h>

#include <chrono>

#include "app/demo.hpp"
#include "picture_support.hpp"
#include "platform/files.hpp"
#include "platform/folders.hpp"
#include "platform/process.hpp"
#include "virtual_display.hpp"

namespace speculum::testing_support {

using Clock = std::chrono::steady_clock;

inline constexpr int width = 900;
inline constexpr int height = 700;

inline const std::string windowScene = R"(
[environment]
background = [0.2, 0.3, 0.4]
ambient = [0.3, 0.3, 0.3]
[camera]
position = [0, 1, 4]
target = [0, 1, 0]
[settings]
"view.samples" = 1
"reflection.samples" = 1
[[object]]
model = "MODELS/sphere.obj"
position = [0.9, 1, 0]
[[light]]
position = [0, 3, 3]
intensity = 10
[[mirror]]
name = "wall"
position = [0, 1, -2]
size = [5, 3]
)";

// A demo window on a virtual display, driven by X events.
class DemoWindow : public testing::Test {
 protected:
  explicit DemoWindow(const std::string& toml = windowScene, const Options& more = {}, int frames = 10)
      : configHome_(environment("XDG_CONFIG_HOME")) {
    // A layout that somebody saved must not move the widgets.
    setEnvironment("XDG_CONFIG_HOME", config_.path().string());
    Options& options = options_;
    options = more;
    options.scene = writeScene("demo_window", toml).string();
    options.size = {width, height};
    options.validation = true;
    options.presentMode = PresentMode::immediate;
    // The first so that run() can count frames.
    options.settings.insert(options.settings.begin(), {{"view.continuous", "true"}, {"debug.check_finite", "true"}});
    start(frames);
  }
  ~DemoWindow() override {
    demo_.reset();
    setEnvironment("XDG_CONFIG_HOME", configHome_);
  }

  void start(int frames = 10) {
    demo_ = std::make_unique<Demo>(options_);
    demo_->setCapture(true);
    run(frames);
  }

  void run(int frames) {
    const int last = demo_->framesDrawn() + frames;
    const auto end = Clock::now() + std::chrono::seconds(60);  // only what hangs takes that long
    while (demo_->framesDrawn() < last && Clock::now() < end) {
      ASSERT_TRUE(demo_->step());
    }
  }

  Pixels picture() { return demo_->renderer().readback(); }

  // A pixel of the background, right of the panel and above the mirror.
  std::array<int, 3> background() {
    const Pixels pixels = picture();
    const uint8_t* p = &pixels.rgba[4 * (static_cast<size_t>(20) * pixels.extent.width + pixels.extent.width - 20)];
    return {p[0], p[1], p[2]};
  }

  void xdotool(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "xdotool");
    const ProcessResult result = runProcess(arguments);
    ASSERT_EQ(result.exitCode, 0) << result.output;
  }

  std::string windowId() {
    const ProcessResult found = runProcess({"xdotool", "search", "--name", "^Speculum$"});
    return found.output.substr(0, found.output.find('\n'));
  }

  void press(const std::string& key) {
    xdotool({"key", "--window", windowId(), key});
    run(4);
  }

  void moveTo(int x, int y) {
    xdotool({"mousemove", "--window", windowId(), std::to_string(x), std::to_string(y)});
    run(3);
  }

  PixelRect widget(const std::string& key) {
    for (const auto& [name, rect] : demo_->model().widgets) {
      if (name == key) {
        return rect;
      }
    }
    ADD_FAILURE() << "the panel has no widget for " << key;
    return {};
  }

  void click(const std::string& key) {
    const PixelRect rect = widget(key);
    moveTo(rect.x + rect.width / 2, rect.y + rect.height / 2);
    xdotool({"mousedown", "1"});
    run(3);
    xdotool({"mouseup", "1"});
    run(3);
  }

  // Presses at a part of the widget's width, moves by `dx` pixels, releases.
  void drag(const std::string& key, double part, int dx) {
    const PixelRect rect = widget(key);
    const int x = rect.x + static_cast<int>(rect.width * part);
    const int y = rect.y + rect.height / 2;
    moveTo(x, y);
    xdotool({"mousedown", "1"});
    run(3);
    for (int i = 1; i <= 4; ++i) {
      moveTo(x + dx * i / 4, y);
    }
    xdotool({"mouseup", "1"});
    run(3);
  }

  void expectQuiet() {
    EXPECT_EQ(demo_->device().validationMessages(), 0);
    EXPECT_EQ(demo_->nonFinite(), 0u);
  }

  test::VirtualDisplay display_{1280, 900};
  TemporaryDirectory config_;
  std::string configHome_;
  Options options_;
  std::unique_ptr<Demo> demo_;
};

}  // namespace speculum::testing_support
