#include "ui/glfw_input.hpp"

#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_impl_glfw.h>

#include <algorithm>
#include <cfloat>
#include <utility>

namespace speculum {

namespace {

constexpr std::chrono::milliseconds doubleClickTime{300};

glm::vec2 vectorOf(VkExtent2D extent) {
  return {static_cast<float>(extent.width), static_cast<float>(extent.height)};
}

bool isKey(const InputEvent& event, std::initializer_list<int> codes) {
  return event.kind == InputEvent::Kind::key && std::ranges::find(codes, event.code) != codes.end();
}

}  // namespace

// Tells ImGui of focus at once; other events wait for a frame. Leaves out repeated keys, because the panels repeat by
// themselves.
void GlfwInput::push(const InputEvent& event) {
  if (event.kind == InputEvent::Kind::focus) {
    ImGui_ImplGlfw_WindowFocusCallback(window_.native(), event.down);
  } else if (event.kind == InputEvent::Kind::enter) {
    ImGui_ImplGlfw_CursorEnterCallback(window_.native(), event.down);
  } else if (event.kind != InputEvent::Kind::drop && !event.key.repeat) {
    queue_.push(event);
  }
}

void GlfwInput::give(const InputEvent& event) {
  GLFWwindow* window = window_.native();
  switch (event.kind) {
    case InputEvent::Kind::key:
      // Ctrl+Tab switches windows. Tab alone hides the panels; the arrow keys move the focus.
      if (event.code == GLFW_KEY_TAB && event.down && !ImGui::GetIO().KeyCtrl) {
        return;
      }
      return ImGui_ImplGlfw_KeyCallback(window, event.code, 0, event.down ? GLFW_PRESS : GLFW_RELEASE, 0);
    case InputEvent::Kind::text:
      return ImGui_ImplGlfw_CharCallback(window, static_cast<unsigned>(event.code));
    case InputEvent::Kind::button:
      if (static_cast<size_t>(event.code) < buttons_.size()) {
        buttons_[static_cast<size_t>(event.code)] = event.down;
      }
      // The window's time decides what a double click is. ImGui would take the time between the frames.
      if (event.down) {
        ImGui::GetIO().MouseDoubleClickTime = event.again ? FLT_MAX : 0.0f;
      }
      return ImGui_ImplGlfw_MouseButtonCallback(window, event.code, event.down ? GLFW_PRESS : GLFW_RELEASE, 0);
    case InputEvent::Kind::pointer:
      pointer_ = glm::vec2(event.x, event.y);
#if IMGUI_VERSION_NUM >= 18700
      ImGui_ImplGlfw_CursorPosCallback(window, event.x, event.y);
#endif
      return;
    case InputEvent::Kind::wheel:
      return ImGui_ImplGlfw_ScrollCallback(window, event.x, event.y);
    case InputEvent::Kind::focus:
    case InputEvent::Kind::enter:
    case InputEvent::Kind::drop:
      return;  // push() queues none of these
  }
}

void GlfwInput::readWindow() {
  ImGui_ImplGlfw_NewFrame();
}

void GlfwInput::newFrame() {
  for (const InputEvent& event : queue_.take()) {
    give(event);
  }
  // Sets time and size anew: the backend read them when the last frame ended.
  ImGuiIO& io = ImGui::GetIO();
  const auto now = std::chrono::steady_clock::now();
  io.DeltaTime = std::max(std::chrono::duration<float>(now - std::exchange(last_, now)).count(), 1e-6f);
  const glm::vec2 size = vectorOf(window_.size());
  io.DisplaySize = {size.x, size.y};
  if (size.x > 0.0f && size.y > 0.0f) {
    const glm::vec2 scale = vectorOf(window_.framebufferExtent()) / size;
    io.DisplayFramebufferScale = {scale.x, scale.y};
  }
#if IMGUI_VERSION_NUM < 18700
  // The backend read the pointer from GLFW, which is ahead of the queue.
  for (size_t i = 0; i < buttons_.size(); ++i) {
    io.MouseDown[i] = buttons_[i];
  }
  if (pointer_ && io.MousePos.x != -FLT_MAX) {
    io.MousePos = {pointer_->x, pointer_->y};
  }
#endif
}

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
  bool typed = false;
  bool alt = false;
  while (!events_.empty()) {
    const InputEvent event = events_.front();
    // Letters also come as text, so a frame need not show that their keys are down.
    const bool pressed = event.down && (event.kind == Kind::button || (event.kind == Kind::key && event.command));
    const bool drops = moved && event.kind == Kind::button && !event.down;
    // A text field ignores text of a frame in which Control is down.
    const bool controls = typed && event.down && isKey(event, {GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL});
    const bool isAlt = isKey(event, {GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT});
    if ((pressed && (keyReleased || buttonReleased)) || (event.kind == Kind::pointer && buttonReleased) || drops ||
        controls || (isAlt && alt)) {
      break;
    }
    alt = alt || isAlt;
    moved = moved || event.kind == Kind::pointer;
    typed = typed || event.kind == Kind::text;
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
