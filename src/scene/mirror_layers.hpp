#pragma once

#include <span>

#include "scene/scene_state.hpp"

namespace speculum {

// Sets plane and layers of all mirrors; the layers must be 0 before. Mirrors count as lying in one plane if they are no
// farther apart than rounding can put them.
void findLayers(std::span<const Mirror> mirrors, std::span<MirrorState> states);

}  // namespace speculum
