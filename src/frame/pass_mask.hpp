#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "frame/settings.hpp"
#include "frame/view.hpp"

namespace speculum {

// How far outside the edge of a mirror's visible part samples of its image may lie that count for what is read of it,
// in texels along each axis. `standardLocations`: samples lie where Vulkan's standardSampleLocations puts them, else
// anywhere in their texel.
double lookupReach(const Settings& settings, bool standardLocations);

// The part of the view's rectangle that those who look its image up can read: within `reach` pixels along each axis of
// what the cone bounds. A convex polygon in the picture's device coordinates ([-1, 1], y down); empty if it is the
// whole rectangle.
std::vector<glm::dvec2> passMask(const View& view, const Projection& projection, double reach);

}  // namespace speculum
