#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace speculum {

// Named as on an Xbox controller.
enum class GamepadButton { a, b, x, y, leftBumper, rightBumper, back, start, leftStick, rightStick, count };

// Sticks, triggers and buttons of a gamepad at one moment.
struct GamepadState {
  // -1 .. 1, right and down positive; 0 within the dead zone.
  float leftX = 0.0f;
  float leftY = 0.0f;
  float rightX = 0.0f;
  float rightY = 0.0f;
  float leftTrigger = 0.0f;  // 0 .. 1
  float rightTrigger = 0.0f;
  std::array<bool, static_cast<size_t>(GamepadButton::count)> buttons{};
  bool directionPad = false;  // any of its four

  bool down(GamepadButton button) const { return buttons[static_cast<size_t>(button)]; }
  bool used() const { return *this != GamepadState{}; }  // anything is pressed or pushed
  bool operator==(const GamepadState&) const = default;
};

// Returns the value of a stick's axis, -1 .. 1, as 0 within the dead zone where worn sticks rest, and without a jump at
// its edge.
inline float withoutDeadZone(float axis) {
  constexpr float deadZone = 0.25f;
  return std::copysign(std::clamp((std::abs(axis) - deadZone) / (1.0f - deadZone), 0.0f, 1.0f), axis) + 0.0f;
}

}  // namespace speculum
