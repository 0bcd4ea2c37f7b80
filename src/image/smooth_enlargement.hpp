#pragma once

#include "image/image.hpp"

namespace speculum {

// Stretches a small picture smoothly, by the cubic filter of Mitchell and Netravali, "Reconstruction Filters in
// Computer Graphics" (1988), on its 8-bit codes. Neither size may be below the picture's. The result is opaque.
Image8 smoothlyEnlarged(const Image8& picture, int width, int height);

}  // namespace speculum
