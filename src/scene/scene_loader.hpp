#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "scene/input_error.hpp"
#include "scene/model_files.hpp"
#include "scene/obj_loader.hpp"
#include "scene/scene.hpp"

namespace speculum {

// Reads a scene with its models and textures; returns modelScene() for the file of a model. Logs the defects of models
// as warnings. Throws InputError.
Scene loadScene(const std::filesystem::path& file, const LoadProgress& progress = {});

// Reads `text` as the content of `file`, without the models: each Object::mesh is -1. Throws InputError.
Scene parseScene(const std::filesystem::path& file, std::string text);

// Returns the file of a model or map that a scene file names: relative to its folder; if there is no such file, one
// whose path differs in case or is Latin-1 instead of UTF-8.
std::filesystem::path fileNamedBy(const std::filesystem::path& scene, const std::string& name);

// Returns why loadScene() would refuse a mirror with this polygon (world), as `polygon: what is wrong (what would be
// right)`; nothing if the polygon is valid.
std::optional<std::string> mirrorPolygonProblem(std::span<const glm::dvec3> polygon);

// The same for a camera that gives no view. Does not look at the ranges of its numbers.
std::optional<std::string> cameraProblem(const CameraSpec& camera);

// Adds the mesh of a model to the scene unless it is there under any name, and returns its index into Scene::meshes.
// Throws InputError and leaves the scene as it was.
int addModel(Scene& scene, const std::filesystem::path& file, const LoadProgress& progress = {});

// Reads the `title` of a scene file without its models; empty for a file that has none or cannot be read.
std::string sceneTitle(const std::filesystem::path& file);
// Lists the file of a scene or model with the models, materials and textures that it names, also those that no face
// uses. Takes what it can from files that cannot be drawn, and reads no number.
std::set<std::filesystem::path> filesNamedBy(const std::filesystem::path& file);
// Says whether the file looks like a scene file, valid or not. Model files do not.
bool isSceneFile(const std::filesystem::path& file);

// Finds a scene or model that comes with the program: by its name, such as "gallery", or by its path within the
// program's data. Returns nothing if there is no such file.
std::optional<std::filesystem::path> shippedScene(const std::filesystem::path& wanted);

// Returns the names of the shipped scenes as --scene takes them, such as hard/corner, sorted.
std::vector<std::string> shippedSceneNames();

// Makes a scene that shows a model of any size by itself: the model stands still over a round mirror, below a sky, and
// two lights leave no side of it dark. Throws InputError, also for a bounding sphere whose radius is not within 1e-9 ..
// 1e12 m.
Scene modelScene(const std::filesystem::path& file, const LoadProgress& progress = {});

// Says whether a text that chooses a camera is for parseCamera(): it begins like a number. Any other text is the name
// of a bookmark.
bool meansPoints(const std::string& text);

// Parses position:target[:up[:FOV]], such as "0,1,4:0,1,0", into a bookmark without a name. Throws
// std::invalid_argument for any other text.
Bookmark parseCamera(const std::string& text);

}  // namespace speculum
