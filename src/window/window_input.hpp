#pragma once

#include "ui/simple_ui.hpp"
#include "window/workspace.hpp"

namespace speculum {

// Says whether the user presses a key or a button, or turns the wheel.
inline bool isAction(const InputEvent& event) {
  using Kind = InputEvent::Kind;
  return event.kind == Kind::wheel || (event.down && (event.kind == Kind::key || event.kind == Kind::button));
}

// Passes the user's input on: events to the panels and, where these do not take them, as commands to the workspace.
class WindowInput {
 public:
  WindowInput(Window& window, SimpleUI& ui, Workspace& workspace) : window_(window), ui_(ui), workspace_(workspace) {}

  void take(const InputEvent& event);             // of the window
  void takeWaiting();                             // once a step
  void takeGamepad(const GamepadState& gamepad);  // once a step
  // Says whether frames are needed without an event: a key or stick is held, or a stick changed in the last step.
  bool held() const { return gamepadChanged_ || gamepad_.used() || direction() != glm::dvec3(0.0); }
  void moveCamera(double seconds);  // by keys and sticks that are held
  bool overPanels() const;          // says whether the pointer is

 private:
  void takeKey(const KeyEvent& event);
  bool controlHeld() const;
  glm::dvec3 direction() const;

  Window& window_;
  SimpleUI& ui_;
  Workspace& workspace_;
  std::optional<Command> afterField_;  // waits until the text field has what was typed before
  GamepadState gamepad_;
  bool gamepadChanged_ = false;
};

}  // namespace speculum
