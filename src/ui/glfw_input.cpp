#include "ui/glfw_input.hpp"

#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_impl_glfw.h>

#include <cfloat>

namespace speculum {

// Tells focus at once. Leaves repeated keys out, because the panels repeat by themselves.
void GlfwInput::push(const InputEvent& event) {
  if (event.kind == InputEvent::Kind::focus) {
    ImGui_ImplGlfw_WindowFocusCallback(window_, event.down);
  } else if (event.kind == InputEvent::Kind::enter) {
    ImGui_ImplGlfw_CursorEnterCallback(window_, event.down);
  } else if (event.kind != InputEvent::Kind::drop && !event.key.repeat) {
    queue_.push(event);
  }
}

void GlfwInput::give(const InputEvent& event) {
  switch (event.kind) {
    case InputEvent::Kind::key:
      return ImGui_ImplGlfw_KeyCallback(window_, event.code, 0, event.down ? GLFW_PRESS : GLFW_RELEASE, 0);
    case InputEvent::Kind::text:
      return ImGui_ImplGlfw_CharCallback(window_, static_cast<unsigned>(event.code));
    case InputEvent::Kind::button:
      if (static_cast<size_t>(event.code) < buttons_.size()) {
        buttons_[static_cast<size_t>(event.code)] = event.down;
      }
      return ImGui_ImplGlfw_MouseButtonCallback(window_, event.code, event.down ? GLFW_PRESS : GLFW_RELEASE, 0);
    case InputEvent::Kind::pointer:
      moved_ = true;
      x_ = event.x;
      y_ = event.y;
#if IMGUI_VERSION_NUM >= 18700
      ImGui_ImplGlfw_CursorPosCallback(window_, event.x, event.y);
#endif
      return;
    case InputEvent::Kind::wheel:
      return ImGui_ImplGlfw_ScrollCallback(window_, event.x, event.y);
    case InputEvent::Kind::focus:
    case InputEvent::Kind::enter:
    case InputEvent::Kind::drop:
      return;  // push() queues none
  }
}

void GlfwInput::newFrame() {
  for (const InputEvent& event : queue_.take()) {
    give(event);
  }
  ImGui_ImplGlfw_NewFrame();
#if IMGUI_VERSION_NUM < 18700
  // The backend read the pointer from GLFW, which is ahead of the queue.
  ImGuiIO& io = ImGui::GetIO();
  for (size_t i = 0; i < buttons_.size(); ++i) {
    io.MouseDown[i] = buttons_[i];
  }
  if (moved_ && io.MousePos.x != -FLT_MAX) {
    io.MousePos = {static_cast<float>(x_), static_cast<float>(y_)};
  }
#endif
}

}  // namespace speculum
