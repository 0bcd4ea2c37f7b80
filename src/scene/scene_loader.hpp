#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "scene/input_error.hpp"
#include "scene/obj_loader.hpp"
#include "scene/scene.hpp"

namespace speculum {

// Whether the name is one of a Wavefront OBJ file.
bool isModelFile(const std::filesystem::path& file);

// Reads a scene with its models and textures; for a model gives modelScene(). Logs warnings (missing MTL, dropped
// triangles, opacity). Throws InputError.
Scene loadScene(const std::filesystem::path& file, const LoadProgress& progress = {});

// Reads `text` as the content of `file`, without the models: each Object::mesh is -1. Throws InputError.
Scene parseScene(const std::filesystem::path& file, std::string text);

// Why a scene file with this polygon of a mirror (world) would be refused, as `polygon: what is wrong (what would be
// right)`; empty if it would not.
std::optional<std::string> mirrorPolygonProblem(std::span<const glm::dvec3> polygon);

// Index of the model among the scene's meshes, to which it is added unless it is there under any name. Throws
// InputError; the scene is then as before.
int addModel(Scene& scene, const std::filesystem::path& file, const LoadProgress& progress = {});

// The scene's `title`, read without models; empty for a file that has none or cannot be read.
std::string sceneTitle(const std::filesystem::path& file);
// Whether the file looks like a scene, valid or not. Models do not.
bool isSceneFile(const std::filesystem::path& file);

}  // namespace speculum
