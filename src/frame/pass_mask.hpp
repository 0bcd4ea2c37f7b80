#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "frame/settings.hpp"
#include "frame/view.hpp"

namespace speculum {

// How far from the edge of a mirror's visible part a texel of its image may lie that is read nevertheless, in texels.
double lookupReach(const ReflectionSettings& settings);

// The part of the view's rectangle that those who look its image up can read: within `reach` pixels of what the cone
// bounds. A convex polygon in the picture's device coordinates ([-1, 1], y down); empty if it is the whole rectangle.
std::vector<glm::dvec2> passMask(const View& view, const Projection& projection, double reach);

}  // namespace speculum
