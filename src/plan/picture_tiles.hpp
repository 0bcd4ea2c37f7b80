#pragma once

#include <optional>
#include <vector>

#include "plan/frame_plan.hpp"

namespace speculum {

// Side in texels of the tiles of a picture that several frames or submissions draw. A multiple of 4, the side of
// lavapipe's blocks, so that even there a pass that is drawn in parts has the same bytes; small, because one core may
// take 1 ms for a pixel.
inline constexpr int tileSide = 16;

// Returns the number of tiles of a picture: the tiles of all passes that are drawn, in the order of recording. A face
// of a shadow or environment map is drawn as one tile, with the layer that it is drawn over.
size_t tileCount(const FramePlan& plan);
// Returns the number of tiles that are faces of maps. They come first.
size_t faceCount(const FramePlan& plan);
// Returns the tiles of each pass that this frame draws, counted within the pass.
std::vector<TileRange> tilesOfPasses(const FramePlan& plan);
// Returns few rectangles that together are these tiles of an image, in the order to draw them: tiles are counted row by
// row from the last to the first. With several samples, lavapipe of Mesa 22.3 also writes to the row above a scissor
// rectangle and to the column left of it, which in this order are drawn later.
std::vector<PixelRect> tileRects(int width, int height, const TileRange& tiles);
// Returns the number of tiles whose commands are submitted together, at least 1, so that no system takes the GPU for
// hung: tiles that trace up to about 130 million rays together. A picture without traced rays needs no limit
// (SIZE_MAX). `raysToLights`: TracedEffects::raysToLights().
size_t tilesAtOnce(const FramePlan& plan, const Settings& settings, size_t raysToLights);
// Returns the number of tiles that cover a rectangle of this size.
size_t tilesIn(const PixelRect& rect);
// Say whether this frame draws the first tile of its picture, the last face of a map (or, without any, the first tile),
// and the last tile.
bool beginsPicture(const FramePlan& plan);
bool endsFaces(const FramePlan& plan);
bool endsPicture(const FramePlan& plan);

}  // namespace speculum
