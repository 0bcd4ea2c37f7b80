// What the inspector offers beside dragging: numbers that are typed, and where a mirror can be looked from.
#include "demo_edit_support.hpp"

namespace speculum {
namespace {

using namespace testing_support;

class Inspector : public EditWindow {
 protected:
  Inspector() {
    press("Tab");
    press("F2");
  }
  void tap(const std::string& key) {
    xdotool({"keydown", "--window", windowId(), key});
    run(2);
    xdotool({"keyup", "--window", windowId(), key});
    run(2);
  }
  glm::dvec3 eye() { return demo_->camera().eye; }
  glm::dvec3 forward() { return -glm::dvec3(glm::transpose(demo_->camera().worldToView)[2]); }
};

TEST_F(Inspector, AClickOnANumberTypesIntoIt) {
  press("shift+n");
  ASSERT_EQ(edit().selected, ball);
  const PixelRect position = widget("edit.position");
  moveTo(position.x + position.width / 3, position.y + position.height / 2);  // the second number, before the label
  xdotool({"mousedown", "1"});
  run(2);
  xdotool({"mouseup", "1"});
  run(3);
  xdotool({"type", "--window", windowId(), "1.75"});
  run(5);
  tap("Return");
  EXPECT_EQ(object().position, glm::dvec3(0.3, 1.75, 0.5)) << "what was there is replaced";
  press("ctrl+z");
  EXPECT_EQ(object().position, glm::dvec3(0.3, 1.0, 0.5)) << "one step";
  EXPECT_EQ(edit().undo, "");
  drag("edit.position", 0.1, 30);
  EXPECT_GT(object().position.x, 0.4) << "it is still dragged";
  expectQuiet();
}

TEST_F(Inspector, AMirrorIsLookedOutOfAndFromBehind) {
  press("n");
  press("n");
  ASSERT_EQ(edit().selected, behind);
  const glm::dvec3 before = eye();
  click("edit.look_behind");
  EXPECT_GT(eye().z, 2.0) << "it stands at z = 2 and faces -z";
  EXPECT_NEAR(glm::distance(forward(), glm::dvec3(0.0, 0.0, -1.0)), 0.0, 1e-9);
  EXPECT_NE(eye(), before);
  click("edit.look_out");
  EXPECT_NEAR(eye().z, 2.0 - 0.01, 1e-9);
  EXPECT_NEAR(glm::distance(forward(), glm::dvec3(0.0, 0.0, -1.0)), 0.0, 1e-9);
  EXPECT_EQ(edit().selected, behind);
  press("n");
  ASSERT_EQ(edit().selected, lamp);
  const auto& widgets = demo_->model().widgets;
  EXPECT_TRUE(std::none_of(widgets.begin(), widgets.end(), [](const auto& w) { return w.first == "edit.look_out"; }));
  expectQuiet();
}

}  // namespace
}  // namespace speculum
