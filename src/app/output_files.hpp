#pragma once

#include "app/options.hpp"
#include "scene/scene.hpp"

namespace speculum {

// Refuse an output that would replace another or what the command reads: files that options name, then models,
// materials and textures of the scene. Devices and pipes may be named twice. Throw UsageError.
void requireFilesOfTheirOwn(const Options& options);
void requireFilesOfTheirOwn(const Options& options, const Scene& scene);

}  // namespace speculum
