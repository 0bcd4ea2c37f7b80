#pragma once

#include <filesystem>
#include <set>
#include <vector>

#include "geometry/mesh.hpp"
#include "scene/model_files.hpp"

namespace speculum {

// Reads a Wavefront OBJ file with its MTL files by tinyobjloader; appends the textures that its materials name to
// `textures`. A defect costs only the elements that it touches: Mesh::defects lists each kind of defect, which is
// logged as a warning. Throws InputError if nothing is left to draw or the file cannot be read.
Mesh loadObj(const std::filesystem::path& file, std::vector<Texture>& textures, const LoadProgress& progress = {});

// Adds the file, and the files that its lines or those of its MTL files may name, as far as they exist. Reads no more
// than these lines, and throws nothing for damaged files.
void addFilesOfObj(const std::filesystem::path& file, std::set<std::filesystem::path>& files);

}  // namespace speculum
