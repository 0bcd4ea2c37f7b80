#pragma once

#include <glm/glm.hpp>

#include "settings/settings.hpp"

namespace speculum {

// Means of at least this many pictures draw each at one sample a pixel: offsets across a whole pixel are a filter
// already, which multisampling would widen.
inline constexpr int singleSamplePictures = 16;

// Returns the settings for the pictures of a mean: one sample a pixel from singleSamplePictures on, and no cached
// images. Returns `settings` without a mean (view.accumulate = 1).
Settings pictureSettings(const Settings& settings);

// Returns the offset from the pixel's centre at which picture `index` of a mean is sampled, in pixels; `settings` are
// pictureSettings(). The first 64 offsets, from 0 on, fill the 8x8 grid of `speculum reference` in the order of Sobol's
// sequence, so that any number of them is spread evenly. Each further 64 fill the same grid, moved within its cells. At
// one sample a pixel the grid spans the whole pixel, at S samples S^-3/4 of its side, which errs least at edges.
glm::dvec2 pictureOffset(int index, const Settings& settings);

}  // namespace speculum
