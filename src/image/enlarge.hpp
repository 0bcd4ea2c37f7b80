#pragma once

#include "image/image.hpp"

namespace speculum {

// The image stretched to `width` x `height` pixels, no fewer than it has, as the shader display_enlarge.frag does: by a
// Catmull-Rom spline, kept within the four nearest texels so that it never rings, nor falls below zero. Equal sizes
// change nothing.
LinearImage enlarged(const LinearImage& image, int width, int height);

}  // namespace speculum
