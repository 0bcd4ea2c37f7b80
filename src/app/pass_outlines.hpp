#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "frame/frame_plan.hpp"

namespace speculum {

// Where a pass's mirror is seen in the picture, in pixels of a picture of `width` x `height`: the part of it that the
// view it is seen in can see. Views in mirrors line up with the picture, so this holds for mirrors in mirrors too.
// Empty for a plan without such a pass.
std::vector<glm::vec2> outlineOf(const FramePlan& plan, const std::vector<int>& path, int width, int height);

}  // namespace speculum
