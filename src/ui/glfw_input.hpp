#pragma once

#include <array>
#include <chrono>
#include <glm/glm.hpp>
#include <optional>

#include "ui/input_queue.hpp"

namespace speculum {

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
  std::optional<glm::vec2> pointer_;  // once it has moved
};

}  // namespace speculum
