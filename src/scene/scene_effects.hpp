#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace speculum {

// One line per key among casts_shadow, roughness, ripple and casts_light that the scene uses and this version does not
// draw, naming the first light or mirror that does; in that order.
std::vector<std::string> ignoredEffects(const Scene& scene);

}  // namespace speculum
