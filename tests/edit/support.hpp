#pragma once

#include "edit/scene_document.hpp"
#include "scene/support.hpp"
#include "test_headers.hpp"

namespace speculum {

std::vector<std::filesystem::path> shippedScenes();

// Expects every field that can be edited to be equal, except the names of models.
void expectSameContent(const Scene& actual, const Scene& expected, const std::string& about);

// A scene read from a text, in a folder of its own with "triangle.obj".
struct TextScene {
  explicit TextScene(const std::string& text)
      : model(folder.write("triangle.obj", triangleObj)),
        file(folder.write("scene.toml", text)),
        scene(loadScene(file)),
        document(scene) {}

  // Returns the scene's text as it would be saved.
  std::string saved(const std::vector<SettingChange>& settings = {}) const { return document.text(file, settings); }

  TemporaryFolder folder;
  std::filesystem::path model;
  std::filesystem::path file;
  Scene scene;
  SceneDocument document;
};

}  // namespace speculum
