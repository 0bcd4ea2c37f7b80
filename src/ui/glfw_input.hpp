#pragma once

#include <array>

#include "ui/input_queue.hpp"

namespace speculum {

// Passes the window's events on to Dear ImGui's GLFW backend, one step a frame, because version 1.86 reads keys,
// buttons and pointer only once, when a frame begins. The backend must not install callbacks.
class GlfwInput {
 public:
  explicit GlfwInput(GLFWwindow* window) : window_(window) {}

  void push(const InputEvent& event);
  // Calls the backend's ImGui_ImplGlfw_NewFrame.
  void newFrame();
  bool waiting() const { return !queue_.empty(); }  // events wait for a frame

 private:
  void give(const InputEvent& event);

  GLFWwindow* window_;
  InputQueue queue_;
  std::array<bool, 3> buttons_{};
  double x_ = 0.0;
  double y_ = 0.0;
  bool moved_ = false;  // the pointer has moved since the start
};

}  // namespace speculum
