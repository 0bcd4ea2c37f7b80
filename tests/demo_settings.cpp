// Settings in the panel: the arrow that goes back to the scene's value.
#include <algorithm>

#include "demo_window_support.hpp"

namespace speculum {
namespace {

using namespace testing_support;

class PanelSettings : public DemoWindow {
 protected:
  bool has(const std::string& key) {
    const auto& widgets = demo_->model().widgets;
    return std::any_of(widgets.begin(), widgets.end(), [&](const auto& widget) { return widget.first == key; });
  }
};

TEST_F(PanelSettings, AnArrowGoesBackToTheScenesValue) {
  const auto before = background();
  ASSERT_FALSE(has("reset.view.exposure"));
  drag("view.exposure", 0.5, 60);
  EXPECT_GT(demo_->model().settings.view.exposure, 1.5);
  EXPECT_GT(background()[2], before[2]);
  ASSERT_TRUE(has("reset.view.exposure"));
  drag("view.clear_color", 0.1, 60);
  ASSERT_TRUE(demo_->model().settings.view.clearColor);
  ASSERT_TRUE(has("reset.view.clear_color"));
  click("reset.view.exposure");
  EXPECT_EQ(demo_->model().settings.view.exposure, 1.0);
  EXPECT_TRUE(demo_->model().settings.view.clearColor) << "only one is reset";
  EXPECT_FALSE(has("reset.view.exposure"));
  click("reset.view.clear_color");
  EXPECT_FALSE(demo_->model().settings.view.clearColor);
  run(3);
  EXPECT_EQ(background(), before);
  expectQuiet();
}

TEST_F(PanelSettings, TheArrowStandsWithinThePanelBesideItsSetting) {
  drag("reflection.max_depth", 0.2, 60);
  const PixelRect slider = widget("reflection.max_depth");
  const PixelRect arrow = widget("reset.reflection.max_depth");
  EXPECT_EQ(arrow.y, slider.y);
  EXPECT_GT(arrow.x, slider.x + slider.width);
  EXPECT_LT(arrow.x + arrow.width, 12 + 420);
  expectQuiet();
}

TEST_F(PanelSettings, TheArrowIsReachedByKeyboard) {
  drag("reflection.max_depth", 0.2, 60);
  ASSERT_NE(demo_->model().settings.reflection.maxDepth, 4);
  // The slider was chosen by the pointer; the arrow stands to its right.
  for (const char* key : {"Right", "Right", "space"}) {
    xdotool({"keydown", "--window", windowId(), key});
    run(2);
    xdotool({"keyup", "--window", windowId(), key});
    run(2);
  }
  EXPECT_EQ(demo_->model().settings.reflection.maxDepth, 4);
  EXPECT_FALSE(demo_->model().paused) << "the space bar pressed the arrow";
  expectQuiet();
}

}  // namespace
}  // namespace speculum
