#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>

#include "settings/settings.hpp"

namespace speculum {

// Thrown when a scene cannot be saved. what() is one line with the remedy; the file is as it was.
class SaveError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Thrown when the file is not to be overwritten unasked.
class OverwriteError : public SaveError {
 public:
  using SaveError::SaveError;
};

// Whether the text of a scene must read back as the scene. Only copies that Recovery keeps may be untested, because
// otherwise the changes would be lost in a failure.
enum class ReadBack { required, untested };

// Returns the scene file's text with edited content and changed settings; an empty value takes a setting's key out.
// `loaded` has the original text and file, `meshes` and `textures` those of Object::mesh and Mirror::map. Unchanged
// values keep their text, comments and order; paths of models are relative to the folder of `file`. Throws SaveError if
// the text is required to read back as exactly this content but would not.
std::string editedText(const Scene& loaded, const SceneContent& content, std::span<const Mesh> meshes,
                       std::span<const Texture> textures, std::span<const SettingChange> settings,
                       const std::filesystem::path& file, ReadBack readBack = ReadBack::required);

// Return the indices of the meshes that objects use, and of the textures that are maps of mirrors, whose files lie
// neither in `folder` nor below.
std::vector<size_t> modelsOutside(const Scene& scene, const std::filesystem::path& folder);
std::vector<size_t> mapsOutside(const Scene& scene, const std::filesystem::path& folder);

// Files of a scene's meshes and textures.
struct SourceFiles {
  std::vector<std::filesystem::path> meshes;
  std::vector<std::filesystem::path> textures;
};

// Copies the models and maps that modelsOutside() and mapsOutside() find, models with their Mesh::namedFiles, to
// `models` in the folder, those of other source folders to `models-2` and so on. Adds nothing to a folder that is
// there, because models look for their files in it; uses one that holds the same copies. Returns the files of all
// meshes and textures. Throws SaveError.
SourceFiles copyModels(const Scene& scene, const std::filesystem::path& folder);

// Throws OverwriteError if there is a file that does not hold `expected`; with no expected text, if there is any file.
// Throws SaveError if it cannot be read.
void requireOwnFile(const std::filesystem::path& file, const std::optional<std::string>& expected);

// Replaces the file by `text`, whole or not at all. Throws SaveError if that fails.
void writeSceneFile(const std::filesystem::path& file, const std::string& text);

// Returns the scene file for a name that the user typed: ".toml" is added unless it is there. Names of models stay as
// they are, and SceneDocument::save refuses them. Throws SaveError if there is no name.
std::filesystem::path sceneFileNamed(const std::filesystem::path& file);

// Throws a SaveError if the file's folder is missing; the message names the outermost missing folder.
void requireFolder(const std::filesystem::path& file);

}  // namespace speculum
