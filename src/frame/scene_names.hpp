#pragma once

#include <span>
#include <string>

#include "scene/scene.hpp"

namespace speculum {

// Name of a node for users: "mirror 'floor'", or "mirror 2" if it has none.
std::string nameOf(const std::string& kind, const std::string& name, int index);

// Name of a mirror for users: its `name`, or its index.
std::string mirrorName(const Scene& scene, int mirror);
// Name of a path for users: "floor > wall", from the eye on.
std::string mirrorPathName(const Scene& scene, std::span<const int> path);

}  // namespace speculum
