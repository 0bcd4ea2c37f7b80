// Input between two frames, and how the next frames receive it.
#include <GLFW/glfw3.h>

#include "test_headers.hpp"
#include "ui/glfw_input.hpp"

namespace speculum {
namespace {

using Kind = InputEvent::Kind;

InputEvent command(int code, bool down) {
  return {.kind = Kind::key, .code = code, .down = down, .command = true};
}
InputEvent letter(int code, bool down) {
  return {.kind = Kind::key, .code = code, .down = down};
}
InputEvent button(bool down) {
  return {.kind = Kind::button, .down = down};
}
InputEvent pointer(double x) {
  return {.kind = Kind::pointer, .x = x};
}
InputEvent text(int character) {
  return {.kind = Kind::text, .code = character};
}

InputQueue queueOf(std::initializer_list<InputEvent> events) {
  InputQueue queue;
  for (const InputEvent& event : events) {
    queue.push(event);
  }
  return queue;
}

TEST(InputQueue, TapsLastOneFrame) {
  InputQueue queue = queueOf(
      {command(1, true), command(1, false), command(1, true), command(1, false), command(1, true), command(1, false)});
  for (int tap = 0; tap < 3; ++tap) {
    const std::vector<InputEvent> first = queue.take();
    ASSERT_FALSE(first.empty());
    EXPECT_TRUE(first.back().down);
    if (tap == 0) {
      EXPECT_EQ(first.size(), 1u);
    }
    EXPECT_FALSE(queue.empty());
    const std::vector<InputEvent> second = queue.take();
    ASSERT_EQ(second.size(), 1u);
    EXPECT_FALSE(second[0].down);
  }
  EXPECT_TRUE(queue.empty());
  EXPECT_TRUE(queue.take().empty());
}

TEST(InputQueue, TapOfAltLastsOneFrame) {
  InputQueue queue;
  for (int tap = 0; tap < 2; ++tap) {
    queue.push(letter(GLFW_KEY_LEFT_ALT, true));
    queue.push(letter(GLFW_KEY_LEFT_ALT, false));
  }
  for (const bool down : {true, false, true, false}) {
    const std::vector<InputEvent> taken = queue.take();
    ASSERT_EQ(taken.size(), 1u);
    EXPECT_EQ(taken[0].down, down);
  }
  EXPECT_TRUE(queue.empty());
}

TEST(InputQueue, TypedTextTakesOneFrame) {
  InputQueue queue;
  for (const int c : {'a', 'b', 'c'}) {
    queue.push(letter(c, true));
    queue.push(text(c));
    queue.push(letter(c, false));
  }
  EXPECT_EQ(queue.take().size(), 9u);
  EXPECT_TRUE(queue.empty());
}

TEST(InputQueue, TextAfterACommandWaits) {
  InputQueue queue = queueOf({text('a'), command(1, true), command(1, false), text('b')});
  const std::vector<InputEvent> first = queue.take();
  ASSERT_EQ(first.size(), 2u);
  EXPECT_EQ(first[0].code, 'a');
  EXPECT_TRUE(first[1].command);
  EXPECT_EQ(queue.take().size(), 2u);
}

TEST(InputQueue, ControlAfterTextWaits) {
  InputQueue queue = queueOf({text('a'), letter(GLFW_KEY_LEFT_CONTROL, true), command(1, true)});
  EXPECT_EQ(queue.take().size(), 1u) << "text is ignored while it is down";
  EXPECT_EQ(queue.take().size(), 2u);
}

TEST(InputQueue, ClicksKeepTheirPointerPosition) {
  InputQueue queue = queueOf({pointer(1.0), pointer(2.0), button(true), button(false), pointer(3.0)});
  const std::vector<InputEvent> press = queue.take();
  ASSERT_EQ(press.size(), 2u);
  EXPECT_EQ(press[0].x, 2.0) << "the last of the movements";
  EXPECT_TRUE(press[1].down);
  const std::vector<InputEvent> release = queue.take();
  ASSERT_EQ(release.size(), 1u) << "before the pointer goes on";
  EXPECT_FALSE(release[0].down);
  EXPECT_EQ(queue.take().size(), 1u);
}

TEST(InputQueue, DoubleClickWithinAFrameCountsAsOne) {
  using namespace std::chrono_literals;
  InputQueue queue;
  const InputQueue::Clock::time_point start;
  const auto click = [&](int code, InputQueue::Clock::duration at) {
    queue.push({.kind = Kind::button, .code = code, .down = true}, start + at);
    queue.push({.kind = Kind::button, .code = code}, start + at);
  };
  click(0, 1s);
  click(0, 1s);
  click(0, 1400ms);
  click(1, 1500ms);
  click(0, 1600ms);
  std::vector<bool> again;
  while (!queue.empty()) {
    const std::vector<InputEvent> press = queue.take();
    ASSERT_TRUE(press.back().down);
    again.push_back(press.back().again);
    EXPECT_FALSE(queue.take().back().down) << "each press has a frame";
  }
  EXPECT_EQ(again, (std::vector{false, true, false, false, false}));
}

TEST(InputQueue, DragMovesBeforeReleaseWithinAFrame) {
  InputQueue queue = queueOf({pointer(1.0), button(true), pointer(5.0), button(false)});
  EXPECT_TRUE(queue.take().back().down);
  const std::vector<InputEvent> moved = queue.take();
  ASSERT_EQ(moved.size(), 1u);
  EXPECT_EQ(moved[0].x, 5.0);
  EXPECT_FALSE(queue.take().back().down);
}

}  // namespace
}  // namespace speculum
