#pragma once

#include <tiny_gltf.h>

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string_view>

#include "scene/model_files.hpp"

namespace speculum {

inline constexpr std::string_view validGltf = "a valid glTF 2.0 file is needed";  // remedy of an InputError

// Attribute of a primitive in a repaired model that names the accessor of its indices. Primitive::indices is not set.
inline constexpr const char* indicesAttribute = "indices";

inline constexpr const char* noLight = "none";  // type of a light that could not be read

// Reads the JSON of `file` by tinygltf. That library refuses a file for one object that it cannot read, and for indices
// of a primitive that it cannot find. Here such an object costs only what uses it, and counts as a defect. `root` has
// asset.version, and no buffers, images, skins and animations. Throws InputError if it cannot be read nevertheless.
tinygltf::Model readRepaired(const std::filesystem::path& file, nlohmann::json root, ModelDefects& defects);

}  // namespace speculum
