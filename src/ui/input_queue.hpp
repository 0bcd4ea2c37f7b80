#pragma once

#include <chrono>
#include <deque>
#include <vector>

#include "platform/window.hpp"

namespace speculum {

// Input in the order in which it came, for panels that look at the state of keys and buttons once a frame: a key or
// button that goes down and up between two frames is down in one and up in the next, where the pointer was then, and a
// drag between two frames moves in one while the button is down.
class InputQueue {
 public:
  using Clock = std::chrono::steady_clock;

  // `now`: when the window got the event. A press becomes one of a double click by that time, because presses between
  // two frames reach the panels frames apart.
  void push(const InputEvent& event, Clock::time_point now = Clock::now());
  // Takes the events that the next frame may handle together.
  std::vector<InputEvent> take();
  bool empty() const { return events_.empty(); }

 private:
  std::deque<InputEvent> events_;
  int pressedButton_ = -1;  // last one; -1: none yet
  Clock::time_point pressedAt_;
};

}  // namespace speculum
