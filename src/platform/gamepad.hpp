#pragma once

#include <array>
#include <cstddef>

namespace speculum {

// As on an Xbox controller.
enum class GamepadButton { a, b, x, y, leftBumper, rightBumper, back, start, leftStick, rightStick, count };

// What a gamepad's person holds at one moment.
struct GamepadState {
  // -1 .. 1, right and down positive; 0 in the rest of a stick.
  float leftX = 0.0f;
  float leftY = 0.0f;
  float rightX = 0.0f;
  float rightY = 0.0f;
  float leftTrigger = 0.0f;  // 0 .. 1
  float rightTrigger = 0.0f;
  std::array<bool, static_cast<size_t>(GamepadButton::count)> buttons{};
  bool directionPad = false;  // any of its four

  bool down(GamepadButton button) const { return buttons[static_cast<size_t>(button)]; }
  bool used() const;  // anything is
  bool operator==(const GamepadState&) const = default;
};

// Of a stick's axis, -1 .. 1: 0 within the rest that worn sticks come back to, and from there on without a jump.
float outOfRest(float axis);

}  // namespace speculum
