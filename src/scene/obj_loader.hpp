#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "geometry/mesh.hpp"

namespace speculum {

// Called now and then with the file that is being read and the finished share of all files, 0 .. 1. An exception from
// the callback ends the loading.
using LoadProgress = std::function<void(const std::filesystem::path& file, double done)>;

// Reads a Wavefront OBJ file with its MTL files by tinyobjloader; appends the textures that its materials name to
// `textures`. A defect costs only the elements that it touches: Mesh::defects lists each kind of defect, which is
// logged as a warning. Throws InputError if nothing is left to draw or the file cannot be read.
Mesh loadObj(const std::filesystem::path& file, std::vector<Texture>& textures, const LoadProgress& progress = {});

}  // namespace speculum
