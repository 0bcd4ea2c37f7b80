#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "geometry/projection.hpp"
#include "image/image.hpp"
#include "settings/settings.hpp"

namespace speculum {

// Side in texels of the tiles of a mean that are drawn on or not. A multiple of 4, the side of lavapipe's blocks.
inline constexpr int refinedSide = 8;

// The tiles of a mean of pictures that further pictures are drawn for: those that have not converged.
struct RefinedTiles {
  int decidedAfter = 0;         // pictures
  glm::ivec2 texels{0};         // size of the main view
  std::vector<uint32_t> tiles;  // 1: refined, 0: converged; row by row

  glm::ivec2 grid() const { return (texels + refinedSide - 1) / refinedSide; }
  double share() const;  // of the tiles that are refined
  bool none() const { return share() == 0.0; }
};

// Says whether tiles are decided after so many pictures: after 16, 32, 48, 64, 96 and so on, where the mean of the
// first half can be compared with that of the second, and both are spread evenly over the pixel.
bool decidesTiles(int pictures);
// Says whether the sum of so many pictures is needed to decide later: it is the first half of a decision.
bool startsHalf(int pictures);

// Sums of the pictures of a mean, as Accumulation has them: four floats a texel, row by row, of which the fourth does
// not count.
struct PictureSum {
  int pictures = 0;
  std::span<const float> texels;
};

// Decides which tiles of a mean go on. `half` is the sum of the first half of the pictures in `whole`, `before` the
// last decision of the same mean or nothing at the first; what has converged stays so. A tile has converged if the
// error of the mean is estimated to be below `step` steps of 8 bits, as a root mean square over the tile and half a
// tile around it.
//
// The estimate at a texel, for each channel after `curve`: A and B, the means of both halves, have the errors of
// independent sets of n/2 samples each, so the mean of all has half the error of A - B. (The offsets of both halves
// complement each other, so it has less.) The neighbourhood counts because one texel may have A = B by chance, and
// because what few samples hit, such as a thin wire or the edge of a highlight, is found in one texel of several. The
// largest channel counts. Deterministic.
RefinedTiles refineTiles(const PictureSum& half, const PictureSum& whole, const glm::ivec2& texels,
                         const DisplayCurve& curve, double step, const RefinedTiles* before);

// Returns rectangles, in texels of the main view, that lie at least `margin` texels from every refined tile. They are
// made of the runs of two and more converged tiles in each row.
std::vector<PixelRect> convergedRects(const RefinedTiles& refined, int margin);

// Means of at least this many pictures draw each at one sample a pixel: offsets across a whole pixel are a filter
// already, which multisampling would widen.
inline constexpr int singleSamplePictures = 16;

// Returns the settings for the pictures of a mean: one sample a pixel from singleSamplePictures on, and no cached
// images. Returns `settings` without a mean (view.accumulate = 1).
Settings pictureSettings(const Settings& settings);

// Returns the offset from the pixel's centre at which picture `index` of a mean is sampled, in pixels; `settings` are
// pictureSettings(). The first 64 offsets, from 0 on, fill the 8x8 grid of `speculum reference` in an order in
// which any number of them is spread evenly. Each further 64 fill the same grid, moved within its cells. At
// one sample a pixel the grid spans the whole pixel, at S samples S^-3/4 of its side, which errs least at edges.
glm::dvec2 pictureOffset(int index, const Settings& settings);

}  // namespace speculum
