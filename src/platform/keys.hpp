#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>

namespace speculum {

// Keys with a meaning in the program, by GLFW's codes; keys that print something have the code of that character.
enum class Key {
  unknown = -1,
  space = ' ',
  comma = ',',
  period = '.',
  a = 'A',
  b,
  c,
  d,
  e,
  f,
  g,
  m = 'M',
  n,
  o,
  q = 'Q',
  r,
  s,
  w = 'W',
  x,
  y,
  z,
  leftBracket = '[',
  rightBracket = ']',
  escape = 256,
  enter,
  tab,
  del = 261,
  f1 = 290,
  f2,
  f10 = 299,
  f11,
  f12,
  leftShift = 340,
  leftControl,
  rightShift = 344,
  rightControl
};
// Returns the meaning of the key at `place` of an American keyboard with the character `printed` on it (empty: none or
// unknown). The six keys that fly are identified by their place; all others, and all keys with Control, by their
// character, or by their place if the character is not Latin. `printedWhereFlying` are the characters on the six fly
// keys: a shortcut whose character is one of them has the key that it has on an American keyboard, unless another
// shortcut is printed on that key.
Key meaningOfKey(Key place, std::string_view printed, bool control, std::string_view printedWhereFlying);

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
