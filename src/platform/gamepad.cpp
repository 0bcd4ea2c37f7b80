#include "platform/gamepad.hpp"

#include <algorithm>
#include <cmath>

namespace speculum {

namespace {

constexpr float rest = 0.25f;  // of a stick's way

}  // namespace

bool GamepadState::used() const {
  return *this != GamepadState{};
}

float outOfRest(float axis) {
  return std::copysign(std::clamp((std::abs(axis) - rest) / (1.0f - rest), 0.0f, 1.0f), axis) + 0.0f;
}

}  // namespace speculum
