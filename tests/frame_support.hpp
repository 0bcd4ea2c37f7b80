#pragma once

#include "scene/scene.hpp"

namespace speculum::testing_support {

// A mirror that faces +z, turned by `yaw` degrees.
inline Mirror wall(const glm::dvec3& position, double yaw, const glm::dvec2& size = {2, 2}) {
  Mirror mirror;
  mirror.position = position;
  mirror.rotation = {0, yaw, 0};
  mirror.size = size;
  return mirror;
}

}  // namespace speculum::testing_support
