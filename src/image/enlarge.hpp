#pragma once

#include "image/image.hpp"

namespace speculum {

// Stretches the image to `width` x `height` pixels, no fewer than it has, as the shader display_enlarge.frag does:
// bilinearly, because that never rings nor falls below zero, and a spline through sixteen texels took half of a moving
// frame's time on a CPU. Equal sizes change nothing.
LinearImage enlarged(const LinearImage& image, int width, int height);

}  // namespace speculum
