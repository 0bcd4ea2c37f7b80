#pragma once

#include <deque>
#include <vector>

#include "platform/window.hpp"

namespace speculum {

// Input in the order in which it came, for panels that look at the state of keys and buttons once a frame: a key or
// button that goes down and up between two frames is down in one and up in the next, where the pointer was then, and a
// drag between two frames moves in one while the button is down.
class InputQueue {
 public:
  void push(const InputEvent& event);
  // Takes the events that the next frame may handle together.
  std::vector<InputEvent> take();
  bool empty() const { return events_.empty(); }

 private:
  std::deque<InputEvent> events_;
};

}  // namespace speculum
