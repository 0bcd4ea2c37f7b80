#include "ui/glfw_input.hpp"

#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_impl_glfw.h>

#include <cfloat>

namespace speculum {

namespace {

// The instance for GLFW's callbacks, which receive the window only.
struct Chain {
  InputQueue* queue = nullptr;
  GLFWkeyfun key = nullptr;
  GLFWcharfun text = nullptr;
  GLFWmousebuttonfun button = nullptr;
  GLFWcursorposfun pointer = nullptr;
  GLFWscrollfun wheel = nullptr;
  GLFWwindowfocusfun focus = nullptr;
  GLFWcursorenterfun enter = nullptr;
};
Chain chain;

template <typename Callback, typename... Arguments>
void passOn(Callback callback, Arguments... arguments) {
  if (callback) {
    callback(arguments...);
  }
}

bool isCommand(int key, int modifiers) {
  const bool modifier = key >= GLFW_KEY_LEFT_SHIFT && key <= GLFW_KEY_RIGHT_SUPER;
  const bool character = key >= GLFW_KEY_SPACE && key <= GLFW_KEY_WORLD_2;
  return !modifier && (!character || (modifiers & (GLFW_MOD_CONTROL | GLFW_MOD_ALT | GLFW_MOD_SUPER)) != 0);
}

// Returns the key for shortcuts of text fields, by its printed letter. Typed text comes as characters.
int meantCode(int key, int scancode) {
  const char* name = key >= GLFW_KEY_SPACE && key <= GLFW_KEY_WORLD_2 ? glfwGetKeyName(key, scancode) : nullptr;
  const bool letter = name && name[0] >= 'a' && name[0] <= 'z' && name[1] == '\0';
  return letter ? GLFW_KEY_A + (name[0] - 'a') : key;
}

void onKey(GLFWwindow* window, int key, int scancode, int action, int modifiers) {
  passOn(chain.key, window, key, scancode, action, modifiers);
  if (action != GLFW_REPEAT) {  // ImGui repeats by itself
    chain.queue->push({.kind = InputEvent::Kind::key,
                       .code = meantCode(key, scancode),
                       .down = action == GLFW_PRESS,
                       .command = isCommand(key, modifiers)});
  }
}

void onText(GLFWwindow* window, unsigned character) {
  passOn(chain.text, window, character);
  chain.queue->push({.kind = InputEvent::Kind::text, .code = static_cast<int>(character)});
}

void onButton(GLFWwindow* window, int button, int action, int modifiers) {
  passOn(chain.button, window, button, action, modifiers);
  chain.queue->push({.kind = InputEvent::Kind::button, .code = button, .down = action == GLFW_PRESS});
}

void onPointer(GLFWwindow* window, double x, double y) {
  passOn(chain.pointer, window, x, y);
  chain.queue->push({.kind = InputEvent::Kind::pointer, .x = x, .y = y});
}

void onWheel(GLFWwindow* window, double dx, double dy) {
  passOn(chain.wheel, window, dx, dy);
  chain.queue->push({.kind = InputEvent::Kind::wheel, .x = dx, .y = dy});
}

void onFocus(GLFWwindow* window, int focused) {
  passOn(chain.focus, window, focused);
  ImGui_ImplGlfw_WindowFocusCallback(window, focused);
}

void onEnter(GLFWwindow* window, int entered) {
  passOn(chain.enter, window, entered);
  ImGui_ImplGlfw_CursorEnterCallback(window, entered);
}

}  // namespace

GlfwInput::GlfwInput(GLFWwindow* window) : window_(window) {
  chain = {.queue = &queue_,
           .key = glfwSetKeyCallback(window, onKey),
           .text = glfwSetCharCallback(window, onText),
           .button = glfwSetMouseButtonCallback(window, onButton),
           .pointer = glfwSetCursorPosCallback(window, onPointer),
           .wheel = glfwSetScrollCallback(window, onWheel),
           .focus = glfwSetWindowFocusCallback(window, onFocus),
           .enter = glfwSetCursorEnterCallback(window, onEnter)};
}

GlfwInput::~GlfwInput() {
  glfwSetKeyCallback(window_, chain.key);
  glfwSetCharCallback(window_, chain.text);
  glfwSetMouseButtonCallback(window_, chain.button);
  glfwSetCursorPosCallback(window_, chain.pointer);
  glfwSetScrollCallback(window_, chain.wheel);
  glfwSetWindowFocusCallback(window_, chain.focus);
  glfwSetCursorEnterCallback(window_, chain.enter);
  chain = {};
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
