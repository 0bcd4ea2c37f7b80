#pragma once

#include "ui/views.hpp"

namespace speculum {

// Says what the images of a mirror (index into Scene::mirrors) cost, on the screen and in other mirrors, or why it has
// none.
std::string mirrorCost(const FrameView& frame, int mirror);

}  // namespace speculum
