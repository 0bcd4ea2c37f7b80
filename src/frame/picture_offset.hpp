#pragma once

#include <glm/glm.hpp>

#include "frame/settings.hpp"

namespace speculum {

// With view.accumulate above 1 a picture is the mean of several, each with an offset of its own.

// From so many pictures on each is drawn at one sample: offsets across a pixel would widen the filter that the samples
// of multisampling are.
inline constexpr int singleSamplePictures = 16;

// Settings that the pictures of a mean are drawn with: the sample counts above, and nothing reused from one to another.
// Without a mean, the settings themselves.
Settings pictureSettings(const Settings& settings);

// From the pixel's centre to where picture `index` of a mean is sampled, in pixels; `settings` are pictureSettings().
// The first is 0. With the others up to 63 it fills the 8x8 grid of the reference, in the order of Sobol's sequence,
// every part of which is spread evenly; each further 64 fill that grid moved within its cells. At one sample the grid
// is the pixel; several samples leave S^-3/4 of its side open, which errs least at edges.
glm::dvec2 pictureOffset(int index, const Settings& settings);

}  // namespace speculum
