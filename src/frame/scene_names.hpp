#pragma once

#include <span>
#include <string>

#include "scene/scene.hpp"

namespace speculum {

// A thing of a scene as people see it: "mirror 'floor'", or "mirror 2" for one without a name.
std::string nameOf(const std::string& kind, const std::string& name, int index);

// The name of a mirror as people see it: its `name`, or its index.
std::string mirrorName(const Scene& scene, int mirror);
// The mirrors of a path from the eye, as "floor > wall".
std::string mirrorPathName(const Scene& scene, std::span<const int> path);

}  // namespace speculum
