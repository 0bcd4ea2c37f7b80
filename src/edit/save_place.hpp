#pragma once

#include <filesystem>

namespace speculum {

// The scene file that a person means who names this one: ".toml" is added unless it is there. Names of models stay, for
// SceneDocument::save to refuse. Throws SaveError if there is no name.
std::filesystem::path sceneFileNamed(const std::filesystem::path& file);

// Throws SaveError that names the outermost folder on the way to the file that does not exist.
void requireFolder(const std::filesystem::path& file);

}  // namespace speculum
