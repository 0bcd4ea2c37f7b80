// Several things that are selected together: a mirror and what frames it.
#include "demo_edit_support.hpp"

namespace speculum {
namespace {

using namespace testing_support;

class EditSeveral : public EditWindow {
 protected:
  void withKey(const std::string& key, const std::function<void()>& act) {
    xdotool({"keydown", "--window", windowId(), key});
    run(2);
    act();
    xdotool({"keyup", "--window", windowId(), key});
    run(2);
  }
  void shiftClick(const glm::ivec2& at) {
    withKey("Shift_L", [&] { click(at.x, at.y); });
  }
  void expectNear(const glm::dvec3& a, const glm::dvec3& b) {
    EXPECT_LT(glm::distance(a, b), 1e-3) << a.x << " " << a.y;
  }
  // As it would be loaded.
  Scene saved() {
    press("ctrl+s");
    return onDisk();
  }
  const std::vector<Selection>& others() const { return edit().others; }

  const glm::ivec2 ballAt_ = pixel({0.3, 1.0, 0.5});
  const glm::ivec2 lampAt_ = pixel({-0.5, 1.5, 0.0});
};

TEST_F(EditSeveral, ShiftAddsAndTakesOut) {
  const std::vector<uint8_t> before = bare();
  shiftClick(ballAt_);
  EXPECT_EQ(edit().selected, ball);
  const std::vector<uint8_t> one = picture().rgba;
  shiftClick(lampAt_);
  EXPECT_EQ(edit().selected, ball);
  EXPECT_EQ(others(), std::vector<Selection>{lamp});
  EXPECT_NE(one, picture().rgba) << "its outline";
  // In a mirror it is the mirror that stands there.
  const glm::ivec2 image(pixel({0.3, 1.0, -4.5}).x + 4, 350);
  shiftClick(image);
  EXPECT_EQ(others(), (std::vector<Selection>{lamp, ahead}));
  shiftClick(lampAt_);
  EXPECT_EQ(others(), std::vector<Selection>{ahead});
  shiftClick(glm::ivec2(ballAt_.x, ballAt_.y + 20));
  EXPECT_EQ(edit().selected, ahead);
  EXPECT_TRUE(others().empty());
  shiftClick({width - 5, 5});
  EXPECT_EQ(edit().selected, ahead) << "the background";
  shiftClick(ballAt_);
  press("Escape");
  EXPECT_FALSE(edit().selected);
  EXPECT_TRUE(others().empty());
  EXPECT_EQ(before, bare());
  expectQuiet();
}

TEST_F(EditSeveral, ShiftCountsWhereTheButtonGoesDown) {
  clickBall();
  moveTo(lampAt_.x, lampAt_.y);
  withKey("Shift_L", [&] { xdotool({"mousedown", "1"}); });
  xdotool({"mouseup", "1"});
  run(3);
  EXPECT_EQ(edit().selected, ball);
  EXPECT_EQ(others(), std::vector<Selection>{lamp});
  xdotool({"mousedown", "1"});
  run(2);
  withKey("Shift_L", [&] { xdotool({"mouseup", "1"}); });
  EXPECT_EQ(edit().selected, lamp);
  EXPECT_TRUE(others().empty());
  expectQuiet();
}

TEST_F(EditSeveral, TheyMoveTogetherInOneStep) {
  const std::vector<uint8_t> before = bare();
  clickBall();
  shiftClick(lampAt_);
  dragPointer(ballAt_.x + 60, ballAt_.y, 33, 0);
  EXPECT_EQ(edit().undo, "move 2 things");
  const double by = 33 / focalPixels;
  Scene scene = saved();
  expectNear(scene.objects[0].position, {0.3 + by, 1.0, 0.5});
  expectNear(scene.lights[0].position, {-0.5 + by, 1.5, 0.0});
  press("ctrl+z");
  EXPECT_EQ(edit().undo, "");
  EXPECT_EQ(others(), std::vector<Selection>{lamp}) << "still selected";
  scene = saved();
  EXPECT_EQ(scene.objects[0].position, glm::dvec3(0.3, 1.0, 0.5));
  EXPECT_EQ(scene.lights[0].position, glm::dvec3(-0.5, 1.5, 0.0));
  EXPECT_EQ(before, bare());
  expectQuiet();
}

TEST_F(EditSeveral, EscapePutsAllBack) {
  const std::vector<uint8_t> before = bare();
  clickBall();
  shiftClick(lampAt_);
  moveTo(ballAt_.x + 60, ballAt_.y);
  xdotool({"mousedown", "1"});
  run(2);
  moveTo(ballAt_.x + 120, ballAt_.y);
  EXPECT_GT(object().position.x, 0.35);
  press("Escape");
  xdotool({"mouseup", "1"});
  run(2);
  EXPECT_EQ(edit().undo, "");
  EXPECT_EQ(before, bare());
  expectQuiet();
}

TEST_F(EditSeveral, TheyTurnAboutTheFirst) {
  press("n");
  ASSERT_EQ(edit().selected, ahead);
  shiftClick(ballAt_);
  shiftClick(lampAt_);
  ASSERT_EQ(others().size(), 2u);
  press("g");
  const auto onRing = [&](double degrees) {
    return glm::ivec2(width / 2, height / 2) +
           glm::ivec2(glm::round(92.0 * glm::dvec2(std::cos(glm::radians(degrees)), -std::sin(glm::radians(degrees)))));
  };
  withKey("Control_L", [&] {
    moveTo(onRing(-40.0).x, onRing(-40.0).y);
    xdotool({"mousedown", "1"});
    run(2);
    for (const double degrees : {-10.0, 20.0, 53.0}) {
      moveTo(onRing(degrees).x, onRing(degrees).y);
    }
    xdotool({"mouseup", "1"});
    run(2);
  });
  EXPECT_EQ(edit().undo, "turn 3 things");
  const Scene scene = saved();
  // By 90 degrees about the mirror's middle, (0, 1, -2).
  expectNear(scene.mirrors[0].position, {0.0, 1.0, -2.0});
  expectNear(scene.mirrors[0].rotation, {0.0, 0.0, 90.0});
  expectNear(scene.objects[0].position, {0.0, 1.3, 0.5});
  expectNear(scene.objects[0].rotation, {0.0, 0.0, 90.0});
  expectNear(scene.lights[0].position, {-0.5, 0.5, 0.0});
  EXPECT_EQ(scene.mirrors[1].rotation, glm::dvec3(0.0, 180.0, 0.0)) << "not selected";
  expectQuiet();
}

TEST_F(EditSeveral, TheyAreDuplicatedAndDeletedTogether) {
  const std::vector<uint8_t> before = bare();
  press("n");
  press("n");
  ASSERT_EQ(edit().selected, behind);
  shiftClick(ballAt_);
  shiftClick(pixel({0.3, 1.0, -4.5}) + glm::ivec2(4, 0));
  ASSERT_EQ(others(), (std::vector<Selection>{ball, ahead}));
  press("ctrl+d");
  EXPECT_EQ(edit().undo, "duplicate 3 things");
  EXPECT_EQ(edit().selected, (Selection{Selection::Kind::mirror, 2}));
  EXPECT_EQ(others(), (std::vector<Selection>{{Selection::Kind::object, 1}, {Selection::Kind::mirror, 3}}));
  const Scene scene = saved();
  ASSERT_EQ(scene.mirrors.size(), 4u);
  ASSERT_EQ(scene.objects.size(), 2u);
  const glm::dvec3 step = scene.objects[1].position - scene.objects[0].position;
  EXPECT_GT(step.x, 3.0) << "beside the mirrors, which are 3 m wide";
  expectNear(scene.mirrors[2].position - scene.mirrors[1].position, step);
  expectNear(scene.mirrors[3].position - scene.mirrors[0].position, step);
  EXPECT_EQ(scene.mirrors[2].rotation, scene.mirrors[1].rotation);
  EXPECT_EQ(scene.mirrors[2].name, "behind 2");
  press("Delete");
  EXPECT_EQ(edit().undo, "remove 3 things");
  EXPECT_EQ(saved().mirrors.size(), 2u);
  EXPECT_EQ(before, bare());
  press("ctrl+z");
  press("ctrl+z");
  EXPECT_EQ(edit().undo, "");
  EXPECT_TRUE(others().empty()) << "the copies are gone";
  EXPECT_EQ(before, bare());
  expectQuiet();
}

TEST_F(EditSeveral, FromTheListTheSame) {
  press("Tab");
  press("F2");
  click("edit.thing.0");
  ASSERT_EQ(edit().selected, ahead);
  withKey("Control_L", [&] { click("edit.thing.3"); });
  EXPECT_EQ(edit().selected, ahead);
  EXPECT_EQ(others(), std::vector<Selection>{ball});
  withKey("Shift_L", [&] { click("edit.thing.2"); });
  EXPECT_EQ(others(), (std::vector<Selection>{ball, lamp}));
  click("edit.delete");
  EXPECT_EQ(edit().things.size(), 1u);
  click("edit.undo");
  EXPECT_EQ(edit().things.size(), 4u);
  click("edit.thing.1");
  EXPECT_EQ(edit().selected, behind);
  EXPECT_TRUE(others().empty());
  expectQuiet();
}

}  // namespace
}  // namespace speculum
