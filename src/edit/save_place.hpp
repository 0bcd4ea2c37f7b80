#pragma once

#include <filesystem>

namespace speculum {

// Scene file for a name that the user typed: ".toml" is added unless it is there. Names of models stay as they are, and
// SceneDocument::save refuses them. Throws SaveError if there is no name.
std::filesystem::path sceneFileNamed(const std::filesystem::path& file);

// Throws a SaveError with the outermost missing folder of the file's path.
void requireFolder(const std::filesystem::path& file);

}  // namespace speculum
