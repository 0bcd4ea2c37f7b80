#pragma once

#include <filesystem>

#include "scene/obj_loader.hpp"
#include "scene/scene.hpp"

namespace speculum {

// Makes a scene that shows a model of any size by itself: it stands still over a round mirror, below a sky, and two
// lights leave no side of it dark. Throws InputError, also for a bounding sphere whose radius is not within
// 1e-9 .. 1e12 m.
Scene modelScene(const std::filesystem::path& file, const LoadProgress& progress = {});

}  // namespace speculum
