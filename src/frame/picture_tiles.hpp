#pragma once

#include <optional>
#include <vector>

#include "frame/frame_plan.hpp"

namespace speculum {

// Side in texels of the tiles of a picture that several frames draw. A multiple of 4, the side of lavapipe's blocks, so
// that even there a pass that is drawn in parts has the same bytes; small, because one core may take 1 ms for a pixel.
inline constexpr int tileSide = 16;

// Returns the number of tiles of a picture: faces of shadow and environment maps, each drawn as one tile, then all
// tiles of the passes of mirrors, in the order of recording, and of the main view.
size_t tileCount(const FramePlan& plan);
size_t faceCount(const FramePlan& plan);
// Returns the faces that this frame draws.
TileRange facesOf(const FramePlan& plan);
// Returns the tiles that this frame draws of each pass of a mirror and of the main view, counted within the pass.
std::vector<TileRange> tilesOfPasses(const FramePlan& plan);
// Returns few rectangles that together are these tiles of an image, in the order to draw them: tiles are counted row by
// row from the last to the first. With several samples, lavapipe of Mesa 22.3 also writes to the row above a scissor
// rectangle and to the column left of it, which in this order are drawn later.
std::vector<PixelRect> tileRects(int width, int height, const TileRange& tiles);
// Divides the picture among frames, for commands: returns the tiles of each. A picture without traced rays is one
// frame. With them, each frame traces about two million paths, without those of environment maps, so that no system
// takes the GPU for hung. debug.check_finite looks at whole pictures, which are not divided.
std::vector<std::optional<TileRange>> partsOf(const FramePlan& plan, const Settings& settings);
// Say whether this frame draws the first tile of its picture, and the last one.
bool beginsPicture(const FramePlan& plan);
bool endsPicture(const FramePlan& plan);

}  // namespace speculum
