#pragma once

#include <span>

#include "scene/scene_state.hpp"

namespace speculum {

// Sets plane and layers of all mirrors, whose layers are 0 before. Mirrors count as being in one plane if rounding
// explains how far they are apart.
void findLayers(std::span<const Mirror> mirrors, std::span<MirrorState> states);

}  // namespace speculum
