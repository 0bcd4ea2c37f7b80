#pragma once

#include <chrono>

#include "driver.hpp"
#include "image/picture_files.hpp"
#include "picture_support.hpp"
#include "platform/process.hpp"
#include "scene_text.hpp"
#include "test_headers.hpp"
#include "user_folders.hpp"
#include "virtual_display.hpp"
#include "window/demo.hpp"

namespace speculum::testing_support {

using Clock = std::chrono::steady_clock;

inline constexpr int width = 900;
inline constexpr int height = 520;

// A window on a virtual display, driven by X events.
class Journey : public testing::Test {
 protected:
  explicit Journey(const std::string& toml = wallScene, const Options& more = {}) : options_(more) {
    keepDriverLoaded();
    runProcess({"xdotool", "mousemove", "640", "450"});  // where the pointer is when a session begins
    options_.scene = writeScene("journey", toml).string();
    options_.size = {width, height};
    options_.validation = true;
    options_.window.presentMode = PresentMode::immediate;
    // The window draws everything in every frame, so that run() can count frames, and moving pictures in full quality,
    // however slow the machine is.
    options_.settings.insert(options_.settings.begin(), {{"view.continuous", "true"},
                                                         {"reflection.skip_unchanged", "false"},
                                                         {"view.samples", "1"},
                                                         {"reflection.samples", "1"},
                                                         {"quality.motion_ms", "0"},
                                                         {"quality.still_pictures", "1"}});
    start();
  }
  ~Journey() override {
    demo_.reset();
    if (otherKeyboard_) {
      runProcess({"setxkbmap", "us"});
    }
  }

  void TearDown() override {
    ASSERT_TRUE(demo_);
    EXPECT_EQ(demo_->device().validationMessages(), 0);
    EXPECT_EQ(demo_->nonFinite() > 0, showsNonFinite_);
  }

  void start() {
    demo_ = std::make_unique<Demo>(options_);
    demo_->setCapture(true);
    ASSERT_TRUE(waitFor([&] { return demo_->framesDrawn() >= 4; }));
    window_ = runProcess({"xdotool", "search", "--name", "Speculum$"}).output;
    window_ = window_.substr(0, window_.find('\n'));
  }
  // Draws so many frames. In a window that draws only changes, stops once the window sleeps.
  void run(int frames) {
    int drawn = demo_->framesDrawn();
    const int last = drawn + frames;
    int sleeps = -1;
    ASSERT_TRUE(waitFor([&] {
      const bool slept = demo_->framesDrawn() == drawn && !shown().settings.view.continuous;
      sleeps = slept ? sleeps + 1 : 0;
      drawn = demo_->framesDrawn();
      return drawn >= last || sleeps > 2;
    }));
  }
  // Waits until nothing changes any more.
  void settle() { run(1'000'000); }
  template <typename Done>
  bool waitFor(const Done& done) {
    const auto end = Clock::now() + std::chrono::seconds(300);  // only a program that hangs takes that long
    while (!done() && Clock::now() < end) {
      EXPECT_TRUE(demo_->step());
    }
    return done();
  }
  bool waitForClose() {
    const auto end = Clock::now() + std::chrono::seconds(60);
    while (Clock::now() < end) {
      if (!demo_->step()) {
        return true;
      }
    }
    return false;
  }

  void xdotool(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "xdotool");
    const ProcessResult result = runProcess(arguments);
    ASSERT_EQ(result.exitCode, 0) << result.output;
  }
  void press(const std::string& key) {
    xdotool({"key", "--window", window_, key});
    run(3);
  }
  void moveTo(double x, double y) {
    xdotool({"mousemove", "--window", window_, std::to_string(std::lround(x)), std::to_string(std::lround(y))});
    run(2);
  }
  void button(bool down) {
    xdotool({down ? "mousedown" : "mouseup", "1"});
    run(3);
  }
  void clickAt(double x, double y) {
    moveTo(x, y);
    button(true);
    button(false);
  }
  void dragFrom(double x, double y, double dx, double dy) {
    moveTo(x, y);
    button(true);
    moveTo(x + 0.5 * dx, y + 0.5 * dy);
    moveTo(x + dx, y + dy);
    button(false);
  }
  PixelRect widget(const std::string& name) {
    for (const auto& [known, rect] : demo_->panels().widgets) {
      if (known == name) {
        return rect;
      }
    }
    ADD_FAILURE() << "no widget " << name;
    return {};
  }
  void click(const std::string& name) {
    const PixelRect rect = widget(name);
    clickAt(rect.x + std::min(rect.width / 2, 40), rect.y + rect.height / 2);
  }
  // Changes a setting without a widget.
  void setSetting(const std::string& key, const std::string& value) {
    Settings settings = shown().settings;
    ASSERT_FALSE(speculum::setSetting(settings, key, value));
    demo_->apply(SetSettings{settings});
    run(3);
  }

  // Changes the keyboard layout for this test.
  void setKeyboard(const std::vector<std::string>& layout) {
    std::vector<std::string> command = {"setxkbmap"};
    command.insert(command.end(), layout.begin(), layout.end());
    ASSERT_EQ(runProcess(command).exitCode, 0);
    otherKeyboard_ = true;
  }

  UiInput shown() const { return demo_->shown(); }
  const SceneEntry& shownScene() const { return shown().browser.scenes[shown().browser.shown]; }
  Image8 picture() { return pictureOf(demo_->renderer().readback()); }
  // Hides panels and messages.
  void hidePanels() {
    demo_->apply(TogglePanel{});
    while (!shown().status.text.empty()) {
      demo_->apply(Escape{});
    }
    run(3);
  }
  // Returns the picture without panels and messages.
  Image8 barePicture() {
    hidePanels();
    Image8 image = picture();
    demo_->apply(TogglePanel{});
    run(3);
    return image;
  }
  UserFolders home_{"XDG_CONFIG_HOME", "XDG_PICTURES_DIR", "XDG_DOCUMENTS_DIR", "XDG_DATA_HOME", "HOME"};
  test::VirtualDisplay display_;
  Options options_;
  std::unique_ptr<Demo> demo_;
  std::string window_;  // X11 id of the window
  bool otherKeyboard_ = false;
  bool showsNonFinite_ = false;  // set by a test that draws values that are not finite
};

}  // namespace speculum::testing_support
