#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>

#include "edit/scene_content.hpp"

namespace speculum {

// A key of [settings] with its value as settingValue() gives it; an empty value takes the key out.
struct SavedSetting {
  std::string key;
  std::string value;
};

// Thrown when a scene cannot be saved. what() is one line with the remedy; the file is as it was.
class SaveError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Text of the scene file with the edited content. `loaded` has the original text and file, `meshes` the models of
// Object::mesh. Unchanged values keep their text, comments and order; paths of models are relative to the folder of
// `file`. Throws SaveError if the text would not read back as exactly this content.
std::string editedText(const Scene& loaded, const SceneContent& content, std::span<const Mesh> meshes,
                       std::span<const SavedSetting> settings, const std::filesystem::path& file);

// Replaces the file by `text`, whole or not at all. Throws SaveError if that fails or, without `overwrite`, if the file
// does not hold `expected`; with no expected text, if there is a file.
void writeSceneFile(const std::filesystem::path& file, const std::string& text,
                    const std::optional<std::string>& expected, bool overwrite);

}  // namespace speculum
