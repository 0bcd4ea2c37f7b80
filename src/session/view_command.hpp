#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "scene/scene.hpp"
#include "session/options.hpp"
#include "settings/settings.hpp"

namespace speculum {

// Adds --set for each of the settings.
void addSettings(std::span<const std::pair<std::string, std::string>> settings, std::vector<std::string>& arguments);

// Adds those of the options that are about the device and its shaders, if they were given.
void addDevice(const Options& options, std::vector<std::string>& arguments);

// Returns a shell command of `speculum render` that draws the view of `options` with `settings` to the same bytes. The
// command has scene, size, time, camera, device, and every setting that is not the scene's own, but neither quality.*,
// whose choice is among the other settings already, nor view.continuous, which only the window uses. `file` holds the
// scene that the picture shows: the scene's own file or a copy with the same [settings].
std::string viewCommand(const Options& options, const std::filesystem::path& file, const Scene& scene,
                        const Settings& settings);

}  // namespace speculum
