#include "window/window_input.hpp"

#include <utility>

#include "ui/input_map.hpp"

namespace speculum {

namespace {

// Says whether a text field leaves the command's keys to the window.
bool isOfFiles(const Command& command) {
  return std::holds_alternative<Save>(command) || std::holds_alternative<AskWhereToSave>(command) ||
         std::holds_alternative<AskWhatToOpen>(command) || std::holds_alternative<NewScene>(command) ||
         std::holds_alternative<Quit>(command);
}

}  // namespace

void WindowInput::take(const InputEvent& event) {
  using Kind = InputEvent::Kind;
  if (event.kind == Kind::key) {
    takeKey(event.key);
  } else if (event.kind == Kind::button && event.code <= static_cast<int>(MouseButton::middle)) {
    workspace_.pointerButton({static_cast<MouseButton>(event.code), event.down, event.shift}, overPanels());
  } else if (event.kind == Kind::pointer) {
    const VkExtent2D size = window_.size();
    workspace_.pointerMoved({event.x, event.y}, {size.width, size.height}, controlHeld());
  } else if (event.kind == Kind::wheel && !overPanels()) {
    workspace_.view().camera.zoom(event.y);
  } else if (event.kind == Kind::drop) {
    workspace_.apply(OpenDropped{event.dropped});
  }
  const bool presses = isAction(event) || event.kind == Kind::text;
  if (!presses || !workspace_.capture().hidesPanels()) {
    ui_.push(event);
  }
}

bool WindowInput::overPanels() const {
  const glm::dvec2& position = workspace_.pointer().position();
  return !workspace_.capture().hidesPanels() && ui_.takesPointer(position.x, position.y);
}

// Applies the command of a key, unless a prompt or a text field has the keyboard.
void WindowInput::takeKey(const KeyEvent& event) {
  const std::optional<Command> command = event.pressed ? commandOf(event) : std::nullopt;
  if (!command) {
    return;
  }
  if (workspace_.prompting()) {
    return std::holds_alternative<Escape>(*command) ? workspace_.apply(CancelPrompt{}) : void();
  }
  if (ui_.menuOpen() && !std::holds_alternative<Quit>(*command) && !std::holds_alternative<TakeScreenshot>(*command)) {
    return;
  }
  if (ui_.wantsKeyboard()) {
    afterField_ = isOfFiles(*command) ? command : afterField_;
  } else if (!ui_.navigating() || !std::holds_alternative<TogglePaused>(*command)) {
    workspace_.apply(*command);
  }
}

void WindowInput::takeWaiting() {
  if (workspace_.prompting()) {
    afterField_.reset();
  } else if (afterField_ && !ui_.hasEvents()) {
    workspace_.apply(*std::exchange(afterField_, std::nullopt));
  }
}

// Applies the commands of gamepad buttons. The direction pad navigates the panels (by Dear ImGui), which then have
// sticks and buttons too.
void WindowInput::takeGamepad(const GamepadState& gamepad) {
  const GamepadState before = std::exchange(gamepad_, gamepad);
  gamepadChanged_ = gamepad_ != before;
  for (int i = 0; i < static_cast<int>(GamepadButton::count); ++i) {
    const auto button = static_cast<GamepadButton>(i);
    const GamepadCommand bound = commandOf(button);
    if (gamepad_.down(button) && !before.down(button) && !workspace_.prompting() &&
        (bound.inPanels || !ui_.navigating())) {
      workspace_.apply(bound.command);
    }
  }
}

void WindowInput::moveCamera(double seconds) {
  const bool sticks = !ui_.navigating() && !workspace_.prompting();
  workspace_.view().camera.move(direction(), sticks ? gamepad_ : GamepadState{}, seconds);
}

bool WindowInput::controlHeld() const {
  return window_.keyDown(Key::leftControl) || window_.keyDown(Key::rightControl);
}

// Returns the direction of the held fly keys, along right, up and backwards of the view. A shortcut's letter does not
// fly if it is released after Ctrl.
glm::dvec3 WindowInput::direction() const {
  if (ui_.wantsKeyboard() || controlHeld() || workspace_.prompting()) {
    return glm::dvec3(0.0);
  }
  const auto axis = [&](Key positive, Key negative) {
    return static_cast<double>(window_.keyDownAlone(positive)) - static_cast<double>(window_.keyDownAlone(negative));
  };
  return {axis(Key::d, Key::a), axis(Key::e, Key::q), axis(Key::s, Key::w)};
}

}  // namespace speculum
