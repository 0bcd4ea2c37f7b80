#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include "scene/scene.hpp"

namespace speculum {

// Bad input. what() is one line: `FILE:LINE: key: what is wrong (what would be right)`.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Reads the scene, its models and textures. Warnings (missing MTL, dropped triangles, opacity) go to the log.
// Throws InputError.
Scene loadScene(const std::filesystem::path& file);

// What `text` says as the content of `file`, without the models: each Object::mesh is -1. Throws InputError.
Scene parseScene(const std::filesystem::path& file, std::string text);

// The scene's `title` alone, without models; empty for a file that has none or cannot be read.
std::string sceneTitle(const std::filesystem::path& file);

// The OBJ file with its MTL; appends the textures it names to `textures`. Throws InputError.
Mesh loadObj(const std::filesystem::path& file, std::vector<Texture>& textures);

}  // namespace speculum
