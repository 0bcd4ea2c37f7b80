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
// Returns by how many pixels rounding may turn the planes of a mirror image's cone. Near a mirror its corners are
// rounded as the eye's position is: by more than a pixel if the eye is far from the origin and micrometres from the
// mirror.
double roundingOfCone(const View& view, const Projection& projection);
// Returns how many texels beyond its cone the view is seen, lookups apart, if the view that shows it is read `reach`
// texels beyond its own: by as much, where it shows more of the mirror than the cone bounds, and by roundingOfCone().
double seenBeyond(const View& view, const Projection& projection, const View& shownIn, double reach);
// Returns lookupReach() for an image that is cached, or has another resolution than the pass that shows it.
double cachedLookupReach(const ImageQuality& quality);

// Returns the mask of a pass, the pixels that it shades: at least what the view's cone bounds, widened by `reach`
// pixels along each axis. A convex polygon in the picture's device coordinates ([-1, 1], y down) without short edges or
// flat corners; empty if the mask is the view's whole rectangle.
std::vector<glm::dvec2> passMask(const View& view, const Projection& projection, double reach);

// Says whether a pixel reads a box of the pass's image, not one texel.
bool isReadByBoxes(const Pass& pass);
// Returns convex polygons that together cover what lies outside the view's cone; they overlap. In the picture's device
// coordinates, as those of passMask(). A part without area on the GPU's grid is left out.
std::vector<std::vector<glm::dvec2>> outsideParts(const View& view, const Projection& projection);

// Returns for each pass the rectangles that it need not draw because no refined tile of the main view shows them, in
// texels of the view's whole picture; none if plan.refined is null. Blurred and rippled images are read anywhere, so
// they and all that is seen in them have none; other images are read at the pixel that shows them, or beside it if they
// have another resolution.
std::vector<std::vector<PixelRect>> convergedParts(const FramePlan& plan);

}  // namespace speculum
