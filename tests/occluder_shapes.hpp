#pragma once

#include <random>
#include <string>

#include "triangles.hpp"

namespace speculum::testing_support {

// Triangles of about 2 m in size around the origin.
struct OccluderShape : Triangles {
  std::string name;

  std::string obj() const;
};

// Another shape of the same kind for each state of the engine.
OccluderShape wallWithArch(std::mt19937& engine);  // one opening, cut coarsely or finely
OccluderShape stairs(std::mt19937& engine);
OccluderShape bentSheet(std::mt19937& engine);
OccluderShape star(std::mt19937& engine);     // a double pyramid over a star, a notched disc or an ellipse
OccluderShape tapered(std::mt19937& engine);  // two rings of different size and shape, thick or thin
OccluderShape boards(std::mt19937& engine);   // two sheets with a gap between
OccluderShape ball(std::mt19937& engine);     // with coordinates of few decimals

OccluderShape randomShape(std::mt19937& engine);  // of all of these kinds in turn

}  // namespace speculum::testing_support
