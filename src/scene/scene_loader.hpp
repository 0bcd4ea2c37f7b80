#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "scene/input_error.hpp"
#include "scene/load_progress.hpp"
#include "scene/scene.hpp"

namespace speculum {

// Whether the name is that of a Wavefront OBJ file.
bool isModelFile(const std::filesystem::path& file);

// Reads the scene, its models and textures; of a model, the scene of modelScene(). Warnings (missing MTL, dropped
// triangles, opacity) go to the log. Throws InputError.
Scene loadScene(const std::filesystem::path& file, const LoadProgress& progress = {});

// What `text` says as the content of `file`, without the models: each Object::mesh is -1. Throws InputError.
Scene parseScene(const std::filesystem::path& file, std::string text);

// What a scene file would be refused for with this polygon of a mirror, world: `polygon: what is wrong (what would be
// right)`, or nothing.
std::optional<std::string> mirrorPolygonProblem(std::span<const glm::dvec3> polygon);

// The place of the model among the scene's meshes; each file is loaded once, whatever it is called. Throws InputError,
// the scene is then as before.
int addModel(Scene& scene, const std::filesystem::path& file, const LoadProgress& progress = {});

// The scene's `title` alone, without models; empty for a file that has none or cannot be read.
std::string sceneTitle(const std::filesystem::path& file);
// Whether the file looks like a scene, which may still be a wrong one. Models do not.
bool isSceneFile(const std::filesystem::path& file);

}  // namespace speculum
