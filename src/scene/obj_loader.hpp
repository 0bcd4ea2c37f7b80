#pragma once

#include <filesystem>
#include <vector>

#include "geometry/mesh.hpp"
#include "scene/load_progress.hpp"

namespace speculum {

// Reads a Wavefront OBJ file with its MTL files; appends the textures that its materials name to `textures`. Logs
// warnings about missing materials and dropped triangles. Throws InputError.
Mesh loadObj(const std::filesystem::path& file, std::vector<Texture>& textures, const LoadProgress& progress = {});

}  // namespace speculum
