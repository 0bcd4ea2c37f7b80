#pragma once

#include <string>

#include "app/options.hpp"
#include "frame/settings.hpp"
#include "scene/scene.hpp"

namespace speculum {

// Returns a shell command of `speculum render` that draws the view of `options` with `settings` to the same bytes: with
// scene, size, time, camera, device, and every setting that is not the scene's own. quality.* is left out, because it
// has been applied to the others already, and view.continuous, because it is the window's. `file` has what the picture
// shows: the scene's own file or a copy with the same [settings].
std::string viewCommand(const Options& options, const std::filesystem::path& file, const Scene& scene,
                        const Settings& settings);

}  // namespace speculum
