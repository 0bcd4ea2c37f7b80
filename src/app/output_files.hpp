#pragma once

#include "app/options.hpp"
#include "scene/scene.hpp"

namespace speculum {

// Refuse an output that would replace another output or a file that the command reads. The first checks files that
// options name, the second the file of the loaded scene, its models, materials and textures. Devices and pipes may be
// named twice. Throw UsageError.
void requireFilesOfTheirOwn(const Options& options);
void requireFilesOfTheirOwn(const Options& options, const Scene& scene);

}  // namespace speculum
