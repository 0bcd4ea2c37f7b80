#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>

#include "edit/scene_content.hpp"

namespace speculum {

// A key of [settings] with its value as settingValue() gives it; empty: not set.
struct SavedSetting {
  std::string key;
  std::string value;
};

// A scene cannot be saved. what() is one line that says how to go on; the file is as it was.
class SaveError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The text of the scene file with the edited content: `loaded` says what text and file were, `meshes` what Object::mesh
// means. Whatever did not change keeps its text, comments and order. Paths of models are relative to the folder of
// `file`. Throws SaveError if the text would not read back as exactly this content.
std::string editedText(const Scene& loaded, const SceneContent& content, std::span<const Mesh> meshes,
                       std::span<const SavedSetting> settings, const std::filesystem::path& file);

// Writes `text` in the place of the file, whole or not at all. Throws SaveError if that fails, or if the file holds
// anything but `expected` by now (nothing: if there is a file); `overwrite` takes that for granted.
void writeSceneFile(const std::filesystem::path& file, const std::string& text,
                    const std::optional<std::string>& expected, bool overwrite);

}  // namespace speculum
