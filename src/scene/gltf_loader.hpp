#pragma once

#include <filesystem>
#include <vector>

#include "scene/model_files.hpp"
#include "scene/scene.hpp"

namespace speculum {

// Reads a glTF 2.0 file (.gltf or .glb) by tinygltf: the triangles of its default scene as one mesh, its first
// perspective camera, and its lights. Appends the textures of materials that are used to `textures`. A defect costs
// only what it touches: Mesh::defects lists each kind of defect, which is logged as a warning. Throws InputError if
// nothing is left to draw or the file cannot be read.
Model loadGltf(const std::filesystem::path& file, std::vector<Texture>& textures, const LoadProgress& progress = {});

}  // namespace speculum
