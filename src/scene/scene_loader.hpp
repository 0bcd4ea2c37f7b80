#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>

#include "scene/scene.hpp"

namespace speculum {

// Bad input. what() is one line: `FILE:LINE: key: what is wrong (what would be right)`.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Told the file that is read and the share, 0 .. 1, of all that has been, now and then. What it throws ends the
// loading.
using LoadProgress = std::function<void(const std::filesystem::path& file, double done)>;

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

// The OBJ file with its MTL; appends the textures it names to `textures`. Throws InputError.
Mesh loadObj(const std::filesystem::path& file, std::vector<Texture>& textures, const LoadProgress& progress = {});

// A scene that shows a model by itself, whatever its size: over a round mirror, with a key light, a sky, and a camera
// that circles it. Throws InputError, also for one whose bounding sphere is not within 1e-9 .. 1e12 m.
Scene modelScene(const std::filesystem::path& file, const LoadProgress& progress = {});

}  // namespace speculum
