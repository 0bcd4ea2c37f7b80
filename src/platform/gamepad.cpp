#include "platform/gamepad.hpp"

#include <algorithm>
#include <cmath>

namespace speculum {

constexpr float deadZone = 0.25f;

float withoutDeadZone(float axis) {
  return std::copysign(std::clamp((std::abs(axis) - deadZone) / (1.0f - deadZone), 0.0f, 1.0f), axis) + 0.0f;
}

}  // namespace speculum
