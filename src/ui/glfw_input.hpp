#pragma once

#include <array>

#include "ui/input_queue.hpp"

struct GLFWwindow;

namespace speculum {

// Brings what GLFW tells of a window to Dear ImGui's GLFW backend, one step a frame: version 1.86 reads keys, buttons
// and pointer as they are when the frame begins. The backend must have installed no callbacks. One instance a process.
class GlfwInput {
 public:
  // Callbacks that the window has already are called first, and at once.
  explicit GlfwInput(GLFWwindow* window);
  ~GlfwInput();
  GlfwInput(const GlfwInput&) = delete;
  GlfwInput& operator=(const GlfwInput&) = delete;

  // Calls the backend's ImGui_ImplGlfw_NewFrame.
  void newFrame();
  bool waiting() const { return !queue_.empty(); }  // for a frame

 private:
  void give(const InputEvent& event);

  GLFWwindow* window_;
  InputQueue queue_;
  std::array<bool, 3> buttons_{};
  double x_ = 0.0;
  double y_ = 0.0;
  bool moved_ = false;  // the pointer, since the beginning
};

}  // namespace speculum
