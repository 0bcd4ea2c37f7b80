// The part of the window that brings models into the scene.
#include <algorithm>

#include "app/demo.hpp"
#include "platform/folders.hpp"

namespace speculum {

namespace fs = std::filesystem;

// Those that come with the program, where its scenes look for them.
void Demo::findModels() {
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(dataDirectory("scenes").parent_path() / "models", none)) {
    if (isModelFile(entry.path())) {
      shippedModels_.push_back(entry.path());
    }
  }
  std::sort(shippedModels_.begin(), shippedModels_.end());
}

// Of the model that is chosen, which is read first if the scene does not have it. Without one the scene is as before.
void Demo::addObject() {
  if (!lookAtScene(time_)) {
    return;
  }
  Scene& scene = loaded_->scene;
  const size_t meshes = scene.meshes.size();
  const size_t textures = scene.textures.size();
  model_.edit.note.clear();
  try {
    const fs::path file = editor_->chosenModel(model_.edit);
    accuracy_.forgetScene(model_);
    const int mesh = addModel(scene, file);
    if (scene.meshes.size() > meshes) {
      useModels();
    }
    model_.edit.model = mesh;
    editor_->add(look(), EditAction::addObject, mesh);
  } catch (const std::exception& error) {
    model_.edit.note = error.what();
    tell(model_.edit.note);
    if (scene.meshes.size() > meshes) {
      scene.meshes.erase(scene.meshes.begin() + static_cast<std::ptrdiff_t>(meshes), scene.meshes.end());
      scene.textures.erase(scene.textures.begin() + static_cast<std::ptrdiff_t>(textures), scene.textures.end());
      useModels();
    }
  }
}

// Everything that was made of the scene's models is made anew.
void Demo::useModels() {
  renderer_.waitIdle();
  if (sceneRenderer_) {
    nonFinite_ = nonFinite();
    sceneRenderer_.reset();
  }
  texturesRefused_.reset();
  sceneRenderer_ = std::make_unique<SceneRenderer>(renderer_, loaded_->scene);
  editor_->modelsChanged();
}

}  // namespace speculum
