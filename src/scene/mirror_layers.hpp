#pragma once

#include <span>

#include "scene/scene_state.hpp"

namespace speculum {

// Sets the planes and layers of mirrors that have none yet. Mirrors count as being in one plane if rounding explains
// how far they are apart.
void findLayers(std::span<const Mirror> mirrors, std::span<MirrorState> states);

}  // namespace speculum
