// The scene edited in the window, as a person does it: with X events, by what the pictures show.
#include "demo_edit_support.hpp"

namespace speculum {
namespace {

using namespace testing_support;

TEST_F(EditWindow, AClickSelectsWhatIsSeenDirectlyAndInMirrors) {
  clickBall();
  EXPECT_EQ(edit().selected, ball);
  EXPECT_TRUE(edit().through.empty());
  click(pixel({0.3, 1.0, -4.5}).x + 4, 350);
  EXPECT_EQ(edit().selected, ball);
  EXPECT_EQ(edit().through, std::vector<std::string>({"mirror 'ahead'"}));
  click(pixel({0.3, 1.0, -7.5}).x - 4, 350);
  EXPECT_EQ(edit().selected, ball);
  EXPECT_EQ(edit().through, std::vector<std::string>({"mirror 'ahead'", "mirror 'behind'"}));
  press("Tab");
  click("edit.through.1");
  EXPECT_EQ(edit().selected, behind) << "the buttons select the mirrors";
  press("Tab");
  click(pixel({-0.5, 1.5, 0.0}).x, pixel({-0.5, 1.5, 0.0}).y);
  EXPECT_EQ(edit().selected, lamp);
  click(width - 5, 5);
  EXPECT_FALSE(edit().selected) << "the background";
  expectQuiet();
}

TEST_F(EditWindow, FurtherClicksGoOutwards) {
  const glm::ivec2 at(pixel({0.3, 1.0, -7.5}).x - 4, 350);
  click(at.x, at.y);
  EXPECT_EQ(edit().selected, ball);
  click(at.x + 1, at.y);
  EXPECT_EQ(edit().selected, behind);
  EXPECT_EQ(edit().through, std::vector<std::string>({"mirror 'ahead'"}));
  click(at.x, at.y);
  EXPECT_EQ(edit().selected, ahead);
  EXPECT_TRUE(edit().through.empty());
  click(at.x, at.y);
  EXPECT_EQ(edit().selected, ball) << "and round";
  expectQuiet();
}

TEST_F(EditWindow, DraggingAnAxisMovesByTheMetresOfThePixels) {
  const std::vector<uint8_t> before = bare();
  clickBall();
  const glm::ivec2 center = pixel({0.3, 1.0, 0.5});
  constexpr int by = 80;
  dragPointer(center.x + 60, center.y, by, 0);
  EXPECT_NEAR(object().position.x, 0.3 + by / focalPixels, 2e-4) << "one metre from the eye";
  EXPECT_EQ(object().position.y, 1.0);
  EXPECT_EQ(object().position.z, 0.5);
  EXPECT_EQ(edit().undo, "move object 'ball'");
  dragPointer(center.x + by, center.y - 60, 0, -50);
  EXPECT_NEAR(object().position.y, 1.0 + 50 / focalPixels, 2e-4);
  const std::vector<uint8_t> moved = bare();
  EXPECT_NE(before, moved);
  press("ctrl+z");
  press("ctrl+z");
  EXPECT_EQ(before, bare());
  press("ctrl+shift+z");
  press("ctrl+y");
  EXPECT_EQ(moved, bare());
  EXPECT_EQ(edit().redo, "");
  expectQuiet();
}

TEST_F(EditWindow, ControlGoesByTheLetterThatIsPrinted) {
  ASSERT_EQ(runProcess({"setxkbmap", "de"}).exitCode, 0);
  run(5);
  clickBall();
  press("Delete");
  const auto left = [&] { return edit().things.size(); };
  const size_t without = left();
  press("ctrl+z");  // where an American keyboard has Y
  EXPECT_EQ(left(), without + 1);
  press("ctrl+y");
  EXPECT_EQ(left(), without);
  expectQuiet();
}

TEST_F(EditWindow, AnImageInAMirrorIsDraggedInTheMirror) {
  const glm::ivec2 image = pixel({0.3, 1.0, -4.5});
  click(image.x + 4, image.y);
  ASSERT_EQ(edit().through.size(), 1u);
  // Upwards in the image as well; six metres away a pixel is more.
  dragPointer(image.x, image.y - 60, 0, -30);
  EXPECT_NEAR(object().position.y, 1.0 + 6.0 * 30 / focalPixels, 2e-3);
  EXPECT_EQ(object().position.x, 0.3);
  expectQuiet();
}

TEST_F(EditWindow, RingsTurnAndControlSnaps) {
  clickBall();
  press("g");
  EXPECT_EQ(edit().mode, GizmoMode::turn);
  const glm::ivec2 center = pixel({0.3, 1.0, 0.5});
  xdotool({"keydown", "--window", windowId(), "Control_L"});
  // A quarter and a little of the ring that faces the eye, from the lower right to the upper right.
  const auto onRing = [&](double degrees) {
    return center +
           glm::ivec2(glm::round(92.0 * glm::dvec2(std::cos(glm::radians(degrees)), -std::sin(glm::radians(degrees)))));
  };
  const glm::ivec2 start = onRing(-40.0);
  moveTo(start.x, start.y);
  xdotool({"mousedown", "1"});
  run(2);
  for (const double degrees : {-10.0, 20.0, 53.0}) {
    moveTo(onRing(degrees).x, onRing(degrees).y);
  }
  xdotool({"mouseup", "1"});
  xdotool({"keyup", "--window", windowId(), "Control_L"});
  run(3);
  EXPECT_EQ(object().rotation, glm::dvec3(0.0, 0.0, 90.0)) << "93 degrees in steps of 15";
  EXPECT_EQ(edit().undo, "turn object 'ball'");
  expectQuiet();
}

TEST_F(EditWindow, AnotherButtonDuringADragChangesNothing) {
  clickBall();
  const glm::ivec2 center = pixel({0.3, 1.0, 0.5});
  moveTo(center.x + 60, center.y);
  xdotool({"mousedown", "1"});
  run(2);
  moveTo(center.x + 80, center.y);
  xdotool({"click", "3"});
  run(2);
  moveTo(center.x + 93, center.y);
  xdotool({"mouseup", "1"});
  run(3);
  EXPECT_NEAR(object().position.x, 0.3 + 33 / focalPixels, 2e-4);
  dragPointer(center.x + 93, center.y, 20, 0);
  EXPECT_NEAR(object().position.x, 0.3 + 53 / focalPixels, 3e-4) << "the pointer is free again";
  expectQuiet();
}

TEST_F(EditWindow, EscapeStopsTheDragThenDeselects) {
  const std::vector<uint8_t> before = bare();
  clickBall();
  const glm::ivec2 center = pixel({0.3, 1.0, 0.5});
  moveTo(center.x + 60, center.y);
  xdotool({"mousedown", "1"});
  run(2);
  moveTo(center.x + 120, center.y);
  EXPECT_GT(object().position.x, 0.35);
  press("Escape");
  EXPECT_EQ(object().position.x, 0.3);
  xdotool({"mouseup", "1"});
  run(2);
  EXPECT_EQ(edit().selected, ball);
  press("Escape");
  EXPECT_FALSE(edit().selected);
  EXPECT_EQ(edit().undo, "");
  EXPECT_EQ(before, bare());
  press("Escape");
  press("Escape");
  EXPECT_FALSE(demo_->window().shouldClose());
  xdotool({"key", "--window", windowId(), "ctrl+q"});
  EXPECT_TRUE(stepUntilClosed()) << "nothing was changed";
  expectQuiet();
}

TEST_F(EditWindow, ThingsAreDuplicatedAndDeleted) {
  const std::vector<uint8_t> before = bare();
  clickBall();
  const size_t things = edit().things.size();
  press("ctrl+d");
  EXPECT_EQ(edit().things.size(), things + 1);
  EXPECT_EQ(edit().selected, (Selection{Selection::Kind::object, 1}));
  const std::vector<uint8_t> two = bare();
  EXPECT_NE(before, two);
  press("ctrl+z");
  EXPECT_EQ(before, bare());
  // Mirrors take their images with them.
  press("n");
  ASSERT_EQ(edit().selected, ahead);
  press("Delete");
  EXPECT_EQ(edit().things.size(), things - 1);
  EXPECT_FALSE(edit().selected);
  EXPECT_EQ(demo_->model().passes.size(), 2u) << "main view and display pass only";
  EXPECT_EQ(edit().undo, "remove mirror 'ahead'");
  press("ctrl+z");
  EXPECT_EQ(before, bare());
  expectQuiet();
}

TEST_F(EditWindow, NumbersOfTheInspectorChangeThePictureInOneStep) {
  const std::vector<uint8_t> before = bare();
  clickBall();
  press("Tab");
  drag("edit.position", 0.1, 40);
  const double x = object().position.x;
  EXPECT_GT(x, 0.5);
  EXPECT_EQ(edit().undo, "edit object 'ball'");
  press("ctrl+z");
  EXPECT_EQ(object().position.x, 0.3) << "the whole drag is one step";
  EXPECT_EQ(edit().undo, "");
  click("edit.color");
  EXPECT_TRUE(object().color);
  press("Tab");
  const std::vector<uint8_t> colored = bare();
  press("ctrl+z");
  EXPECT_EQ(before, bare());
  press("ctrl+y");
  EXPECT_EQ(colored, bare());
  expectQuiet();
}

TEST_F(EditWindow, ThingsAreAddedAndChosenFromTheList) {
  press("Tab");
  press("F2");
  ASSERT_TRUE(edit().open);
  const size_t things = edit().things.size();
  for (const char* button : {"edit.add_mirror", "edit.add_light", "edit.add_object"}) {
    click(button);
  }
  EXPECT_EQ(edit().things.size(), things + 3);
  EXPECT_EQ(edit().selected, (Selection{Selection::Kind::object, 1}));
  click("edit.thing.1");
  EXPECT_EQ(edit().selected, behind);
  press("shift+n");
  EXPECT_EQ(edit().selected, ahead);
  for (int i = 0; i < 3; ++i) {
    click("edit.undo");
  }
  EXPECT_EQ(edit().things.size(), things);
  EXPECT_FALSE(edit().unsaved);
  expectQuiet();
}

TEST_F(EditWindow, ADragOfThePictureStillTurnsTheCamera) {
  const glm::dvec3 eye = demo_->camera().eye;
  moveTo(700, 500);
  xdotool({"mousedown", "1"});
  run(2);
  moveTo(702, 502);
  EXPECT_EQ(demo_->camera().eye, eye) << "it may still become a click";
  moveTo(760, 500);
  xdotool({"mouseup", "1"});
  run(3);
  EXPECT_NE(demo_->camera().eye, eye);
  EXPECT_FALSE(edit().selected);
  expectQuiet();
}

Options heldImages() {
  Options options;
  options.settings.emplace_back("reflection.update_interval", "8");
  return options;
}

class EditWindowWithHeldImages : public EditWindow {
 protected:
  EditWindowWithHeldImages() : EditWindow(heldImages()) {}
};

TEST_F(EditWindowWithHeldImages, MirrorsShowWhatWasMovedAtOnce) {
  run(10);
  const std::vector<uint8_t> before = bare();
  clickBall();
  press("Delete");
  const std::vector<uint8_t> without = picture().rgba;
  const glm::ivec2 image = pixel({0.3, 1.0, -4.5});
  const size_t at = 4 * (static_cast<size_t>(image.y) * width + static_cast<size_t>(image.x));
  EXPECT_FALSE(std::equal(before.begin() + at, before.begin() + at + 3, without.begin() + at));
  run(20);
  EXPECT_EQ(without, picture().rgba);
  expectQuiet();
}

class LimitedWindow : public EditWindow {
 protected:
  LimitedWindow() : EditWindow(limited()) {}
  static Options limited() {
    Options options;
    options.frames = 100000;
    return options;
  }
};

TEST_F(LimitedWindow, WithFramesItNeverAsks) {
  clickBall();
  press("Delete");
  ASSERT_TRUE(edit().unsaved);
  const ProcessResult closed = runProcess({"wmctrl", "-c", "Speculum"});
  ASSERT_EQ(closed.exitCode, 0) << closed.output;
  EXPECT_TRUE(stepUntilClosed());
  EXPECT_FALSE(edit().asksSave);
  expectQuiet();
}

}  // namespace
}  // namespace speculum
