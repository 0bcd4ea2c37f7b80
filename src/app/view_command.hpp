#pragma once

#include <string>
#include <vector>

#include "app/options.hpp"
#include "frame/settings.hpp"
#include "scene/scene.hpp"

namespace speculum {

// Returns the options that were given about the device and its shaders.
std::vector<std::string> deviceArguments(const Options& options);

// Returns a shell command of `speculum render` that draws the view of `options` with `settings` to the same bytes. It
// has scene, size, time, camera, device, and every setting that is not the scene's own, but neither quality.*, whose
// choice is among the other settings already, nor view.continuous, which only the window uses. `file` holds the scene
// that the picture shows: the scene's own file or a copy with the same [settings].
std::string viewCommand(const Options& options, const std::filesystem::path& file, const Scene& scene,
                        const Settings& settings);

}  // namespace speculum
