#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "plan/frame_plan.hpp"

namespace speculum {

// Texels along each axis by which lookups of the pass's image may reach beyond the edge of the mirror's visible region.
// With `standardLocations` samples lie where Vulkan's standardSampleLocations puts them, otherwise anywhere in their
// texel.
double lookupReach(const Pass& pass, const Settings& settings, bool standardLocations);
// Returns for each pass how far its image is read beyond the view's cone, in its texels: lookupReach() and
// seenBeyond().
std::vector<double> lookupReaches(const FramePlan& plan, const Settings& settings, bool standardLocations);
// Returns how many texels beyond its cone the view is seen, lookups apart, if the view that shows it is read `reach`
// texels beyond its own: by as much, where it shows more of the mirror than the cone bounds, and by the rounding of
// that cone.
double seenBeyond(const View& view, const Projection& projection, const View& shownIn, double reach);
// Returns lookupReach() for an image that is cached, or has another resolution than the pass that shows it.
double cachedLookupReach(const ImageQuality& quality);

// Returns the mask of a pass, the pixels that it shades: at least what the view's cone bounds, widened by `reach`
// pixels along each axis. A convex polygon in the picture's device coordinates ([-1, 1], y down) without short edges or
// flat corners; empty if the mask is the view's whole rectangle.
std::vector<glm::dvec2> passMask(const View& view, const Projection& projection, double reach);

// Says whether a pixel reads a box of the pass's image, not one texel.
bool mixesTexels(const Pass& pass);
// Returns convex polygons that together cover what lies outside the view's cone; they overlap. In the picture's device
// coordinates, as those of passMask(). A part without area on the GPU's grid is left out.
std::vector<std::vector<glm::dvec2>> outsideParts(const View& view, const Projection& projection);

// Returns for each pass the rectangles that it need not draw because no refined tile of the main view shows them, in
// texels of the view's whole picture; an empty list if plan.refined is null. Blurred and rippled images are read
// anywhere, so they and all that is seen in them have none; other images are read at the pixel that shows them, or
// beside it if they have another resolution.
std::vector<std::vector<PixelRect>> convergedParts(const FramePlan& plan);

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
