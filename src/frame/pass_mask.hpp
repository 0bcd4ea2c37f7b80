#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "frame/settings.hpp"
#include "frame/view.hpp"

namespace speculum {

// Texels along each axis by which lookups may reach beyond the edge of a mirror's visible region. With
// `standardLocations` samples lie where Vulkan's standardSampleLocations puts them, otherwise anywhere in their texel.
double lookupReach(const Settings& settings, bool standardLocations);

// Mask of a pass: at least what the view's cone bounds, widened by `reach` pixels along each axis. A convex polygon in
// the picture's device coordinates ([-1, 1], y down) without short edges or flat corners; empty if it is the view's
// whole rectangle.
std::vector<glm::dvec2> passMask(const View& view, const Projection& projection, double reach);

}  // namespace speculum
