// What the window remembers of how it looks, and what it takes from the monitor.
#include <algorithm>

#include "demo_window_support.hpp"

namespace speculum {
namespace {

using namespace testing_support;

class DemoLook : public DemoWindow {
 protected:
  // Of the panel's background, between its border and its widgets.
  int panelBrightness() {
    const Pixels pixels = picture();
    const uint8_t* p = &pixels.rgba[4 * (static_cast<size_t>(400) * pixels.extent.width + 15)];
    return p[0] + p[1] + p[2];
  }
};

TEST_F(DemoLook, TheLayoutIsTheUsersAndNotTheDirectorys) {
  const PixelRect before = widget("time");
  moveTo(200, 22);
  xdotool({"mousedown", "1"});
  run(3);
  moveTo(260, 62);
  moveTo(330, 102);
  xdotool({"mouseup", "1"});
  run(3);
  const PixelRect moved = widget("time");
  EXPECT_EQ(moved.x - before.x, 130);
  EXPECT_EQ(moved.y - before.y, 80);
  click("panel.Performance");
  const PixelRect pause = widget("performance.pause");
  moveTo(pause.x + 4, pause.y - 18);  // the arrow of its title
  xdotool({"mousedown", "1"});
  run(3);
  xdotool({"mouseup", "1"});
  run(3);
  const auto shown = [&](const std::string& key) {
    const auto& widgets = demo_->model().widgets;
    return std::any_of(widgets.begin(), widgets.end(), [&](const auto& w) { return w.first == key; });
  };
  EXPECT_FALSE(shown("performance.pause")) << "collapsed";
  click("panel.Log");
  demo_.reset();
  EXPECT_TRUE(std::filesystem::exists(config_.path() / "speculum" / "layout.ini"));
  EXPECT_FALSE(std::filesystem::exists("imgui.ini"));
  start();
  EXPECT_EQ(widget("time"), moved);
  EXPECT_FALSE(shown("performance.pause")) << "still";
  EXPECT_TRUE(shown("log.copy")) << "the other is not";
  expectQuiet();
}

TEST_F(DemoLook, TheThemeIsChosenAndRemembered) {
  EXPECT_LT(panelBrightness(), 200);
  click("section.window");
  click("theme.light");
  EXPECT_GT(panelBrightness(), 500);
  demo_.reset();
  start();
  EXPECT_GT(panelBrightness(), 500);
  click("section.window");
  click("theme.dark");
  EXPECT_LT(panelBrightness(), 200);
  demo_.reset();
  start();
  EXPECT_LT(panelBrightness(), 200);
  expectQuiet();
}

TEST_F(DemoLook, SizesFollowTheScaleOfTheMonitor) {
  const PixelRect before = widget("time");
  demo_.reset();
  std::filesystem::remove(config_.path() / "speculum" / "layout.ini");
  const ProcessResult set =
      runProcess({"xprop", "-root", "-f", "RESOURCE_MANAGER", "8s", "-set", "RESOURCE_MANAGER", "Xft.dpi:\t192\n"});
  ASSERT_EQ(set.exitCode, 0) << set.output;
  start();
  ASSERT_EQ(demo_->window().contentScale(), 2.0f);
  EXPECT_NEAR(widget("time").height, 2 * before.height, 2);
  demo_->window().followContentScale(1.0f);  // to another monitor
  run(3);
  EXPECT_EQ(widget("time").height, before.height);
  expectQuiet();
}

}  // namespace
}  // namespace speculum
