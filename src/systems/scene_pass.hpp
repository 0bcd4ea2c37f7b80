#pragma once

#include <string>

#include "core/pass.hpp"
#include "frame/view.hpp"

namespace speculum {

// Places the picture so that the target's corner shows the corner of the view's rectangle.
Viewport viewportOf(const View& view);
// Describes a pass that draws the scene into `area` of its targets.
PassDesc scenePass(std::string name, const PassTargets& targets, const VkRect2D& area, const Viewport& viewport,
                   const View& view, const Environment& environment);

}  // namespace speculum
