#pragma once

#include <random>
#include <string>

#include "systems/triangles.hpp"

namespace speculum::testing_support {

// Triangles of about 2 m in size around the origin.
struct OccluderShape : Triangles {
  std::string name;

  std::string obj() const;
};

// Another shape for each state of the engine.
OccluderShape randomShape(std::mt19937& engine);

}  // namespace speculum::testing_support
