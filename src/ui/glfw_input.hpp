#pragma once

#include <array>
#include <chrono>
#include <deque>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "platform/window.hpp"

namespace speculum {

// Queues input for panels that look at the state of keys and buttons once a frame. A key or button that goes down and
// up between two frames is down in one frame and up in the next, with the pointer where it was then. A drag between two
// frames moves the pointer in one frame while the button is down.
class InputQueue {
 public:
  using Clock = std::chrono::steady_clock;

  // `now`: when the window got the event. This time decides whether a press belongs to a double click, because presses
  // between two frames reach the panels frames apart.
  void push(const InputEvent& event, Clock::time_point now = Clock::now());
  // Takes the events that the next frame may handle together.
  std::vector<InputEvent> take();
  bool empty() const { return events_.empty(); }

 private:
  std::deque<InputEvent> events_;
  int pressedButton_ = -1;  // button that was pressed last; -1: none yet
  Clock::time_point pressedAt_;
};

// Passes the window's events on to Dear ImGui's GLFW backend, one step a frame, because version 1.86 reads keys,
// buttons and pointer only once, when a frame begins. The backend must not install callbacks. Call readWindow() before
// the first frame.
class GlfwInput {
 public:
  explicit GlfwInput(const Window& window) : window_(window) {}

  void push(const InputEvent& event);
  // Calls the backend's ImGui_ImplGlfw_NewFrame, which waits for answers of the window system: pointer shape, gamepad.
  void readWindow();
  // Gives ImGui the events and what the window knows of itself, without waiting.
  void newFrame();
  bool waiting() const { return !queue_.empty(); }  // events wait for a frame

 private:
  void give(const InputEvent& event);

  const Window& window_;
  InputQueue queue_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
  std::array<bool, 3> buttons_{};
  std::optional<glm::vec2> pointer_;  // screen coordinates; none until the pointer has moved
};

}  // namespace speculum
