#pragma once

#include <string>

#include "app/options.hpp"
#include "frame/settings.hpp"
#include "scene/scene.hpp"

namespace speculum {

// The call of `speculum render`, for a shell, that draws the view of `options` with `settings` to the same bytes:
// scene, size, time, camera, device, and every setting that is not the scene's own. quality.* is left out, which has
// done its work on the others; so is view.continuous, which is the window's. `file` holds what the picture shows: the
// scene's own or a copy with the same [settings].
std::string viewCommand(const Options& options, const std::filesystem::path& file, const Scene& scene,
                        const Settings& settings);

}  // namespace speculum
