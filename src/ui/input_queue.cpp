#include "ui/input_queue.hpp"

#include <utility>

namespace speculum {

constexpr std::chrono::milliseconds doubleClickTime{300};

void InputQueue::push(const InputEvent& event, Clock::time_point now) {
  const bool moves = event.kind == InputEvent::Kind::pointer;
  if (moves && !events_.empty() && events_.back().kind == InputEvent::Kind::pointer) {
    events_.back() = event;
  } else {
    events_.push_back(event);
  }
  if (event.kind == InputEvent::Kind::button && event.down) {
    const bool same = std::exchange(pressedButton_, event.code) == event.code;
    const Clock::duration since = now - std::exchange(pressedAt_, now);
    events_.back().again = same && since < doubleClickTime;
  }
}

std::vector<InputEvent> InputQueue::take() {
  using Kind = InputEvent::Kind;
  std::vector<InputEvent> taken;
  bool keyReleased = false;
  bool buttonReleased = false;
  bool moved = false;
  while (!events_.empty()) {
    const InputEvent event = events_.front();
    // Letters also come as text, so a frame may skip their keys.
    const bool pressed = event.down && (event.kind == Kind::button || (event.kind == Kind::key && event.command));
    const bool drops = moved && event.kind == Kind::button && !event.down;
    if ((pressed && (keyReleased || buttonReleased)) || (event.kind == Kind::pointer && buttonReleased) || drops) {
      break;
    }
    moved = moved || event.kind == Kind::pointer;
    taken.push_back(event);
    events_.pop_front();
    if (pressed) {
      break;
    }
    keyReleased = keyReleased || (event.kind == Kind::key && !event.down);
    buttonReleased = buttonReleased || (event.kind == Kind::button && !event.down);
  }
  return taken;
}

}  // namespace speculum
