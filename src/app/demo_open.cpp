// The part of the window that brings in another scene.
#include <algorithm>
#include <utility>

#include "app/demo.hpp"

namespace speculum {

namespace fs = std::filesystem;

namespace {

bool canOpen(const fs::path& file) {
  return isModelFile(file) || file.extension() == ".toml";
}

}  // namespace

// Its place among the scenes to choose from; one from elsewhere becomes the last of them.
size_t Demo::noteSceneFile(const fs::path& file) {
  std::error_code error;
  const fs::path wanted = fs::weakly_canonical(file, error);
  const auto found = std::find_if(sceneFiles_.begin(), sceneFiles_.end(),
                                  [&](const fs::path& other) { return fs::weakly_canonical(other, error) == wanted; });
  if (found != sceneFiles_.end()) {
    return static_cast<size_t>(found - sceneFiles_.begin());
  }
  sceneFiles_.push_back(file);
  model_.scenes.push_back((isModelFile(file) ? file.filename() : file.stem()).string());
  model_.scenePaths.push_back(fs::absolute(file, error).lexically_normal().string());
  model_.sceneTitles.push_back(isModelFile(file) ? std::string() : sceneTitle(file));
  return sceneFiles_.size() - 1;
}

void Demo::openDropped(const std::vector<fs::path>& files) {
  const auto file = std::find_if(files.begin(), files.end(), canOpen);
  if (file != files.end()) {
    openFile(*file);
  } else if (!files.empty()) {
    sceneError_ = files.front().string() + ": not a scene (a .toml scene or an .obj model is needed)";
  }
}

void Demo::chooseScene(int index) {
  openFile(sceneFiles_[index]);
}

// The question about unsaved changes comes first; its answer goes on here.
void Demo::openFile(const fs::path& file) {
  if (!mayLeave()) {
    nextFile_ = file;
    return;
  }
  Options options = options_;
  options.sweepResults.clear();  // of the scene that the window began with
  sceneError_.clear();
  load_.start({file, 0.0}, [file, options](const auto& report) {
    const auto progress = [&](const fs::path& now, double done) {
      if (!report({now, done})) {
        throw std::runtime_error("cancelled");
      }
    };
    return std::make_unique<LoadedScene>(loadSceneWithSettings(file, options, progress));
  });
}

// Tells the panel how far it is, and takes what has come.
void Demo::followLoading() {
  if (model_.cancelLoading) {
    load_.cancel();
    discarded_.reset();
  }
  // What was changed while it was read is not lost either.
  if (load_.hasResult() && !mayLeave()) {
    return;
  }
  if (std::optional<std::unique_ptr<LoadedScene>> scene = load_.takeResult()) {
    showScene(std::move(*scene));
  } else if (std::optional<std::string> error = load_.takeError()) {
    sceneError_ = std::move(*error);
    discarded_.reset();
  }
  const std::optional<LoadedShare> status = load_.progress();
  model_.loading = status ? status->file.filename().string() : "";
  model_.loadingDone = status ? status->done : 0.0;
}

void Demo::showScene(std::unique_ptr<LoadedScene> scene) {
  accuracy_.forgetScene(model_);
  renderer_.waitIdle();
  nonFinite_ = nonFinite();
  discarded_.reset();
  sceneRenderer_.reset();
  std::swap(loaded_, scene);
  try {
    sceneRenderer_ = std::make_unique<SceneRenderer>(renderer_, loaded_->scene);
  } catch (const std::exception& error) {
    sceneError_ = loaded_->scene.file.string() + ": " + error.what();
    loaded_ = std::move(scene);
    sceneRenderer_ = std::make_unique<SceneRenderer>(renderer_, loaded_->scene);
    return;
  }
  texturesRefused_.reset();
  startEditing();
  model_.settings = loaded_->settings;
  model_.sceneSettings = loaded_->settings;
  model_.debugPass = -1;
  model_.passes.clear();
  model_.skipped.clear();
  model_.history.clear();
  camera_.reset(loaded_->scene.camera);
  lookedFrom_ = -1;
  time_ = 0.0;
  const size_t known = sceneFiles_.size();
  shownScene_ = static_cast<int>(noteSceneFile(loaded_->scene.file));
  model_.scene = shownScene_;
  if (sceneFiles_.size() > known) {
    findScenes();
  }
}

}  // namespace speculum
