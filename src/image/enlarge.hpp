#pragma once

#include "image/image.hpp"

namespace speculum {

// The image stretched to `width` x `height` pixels, no fewer than it has, as the shader display_enlarge.frag does:
// bilinear, which never rings nor falls below zero. A spline through sixteen texels took half of a moving frame's time
// on a CPU. Equal sizes change nothing.
LinearImage enlarged(const LinearImage& image, int width, int height);

}  // namespace speculum
