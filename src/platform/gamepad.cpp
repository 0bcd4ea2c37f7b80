#include "platform/gamepad.hpp"

namespace speculum {

namespace {

constexpr float deadZone = 0.25f;

}  // namespace

bool GamepadState::used() const {
  return *this != GamepadState{};
}

float withoutDeadZone(float axis) {
  return std::copysign(std::clamp((std::abs(axis) - deadZone) / (1.0f - deadZone), 0.0f, 1.0f), axis) + 0.0f;
}

}  // namespace speculum
