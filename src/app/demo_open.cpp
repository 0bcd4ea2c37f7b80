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

// Its place among the scenes to choose from; one from elsewhere is put in front of them.
size_t Demo::noteSceneFile(const fs::path& file) {
  std::error_code error;
  const fs::path wanted = fs::weakly_canonical(file, error);
  const auto found = std::find_if(sceneFiles_.begin(), sceneFiles_.end(),
                                  [&](const fs::path& other) { return fs::weakly_canonical(other, error) == wanted; });
  if (found != sceneFiles_.end()) {
    return static_cast<size_t>(found - sceneFiles_.begin());
  }
  sceneFiles_.insert(sceneFiles_.begin(), file);
  model_.scenes.insert(model_.scenes.begin(), (isModelFile(file) ? file.filename() : file.stem()).string());
  ++shownScene_;
  return 0;
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

void Demo::openFile(const fs::path& file) {
  Options options = options_;
  options.sweepResults.clear();  // of the scene that the window began with
  sceneError_.clear();
  load_.start(file, options);
}

// Tells the panel how far it is, and takes what has come.
void Demo::followLoading() {
  if (model_.cancelLoading) {
    load_.cancel();
  }
  if (std::unique_ptr<LoadedScene> scene = load_.take()) {
    showScene(std::move(scene));
  } else if (std::optional<std::string> error = load_.takeError()) {
    sceneError_ = std::move(*error);
  }
  const std::optional<LoadStatus> status = load_.status();
  model_.loading = status ? status->file.filename().string() : "";
  model_.loadingDone = status ? status->done : 0.0;
}

void Demo::showScene(std::unique_ptr<LoadedScene> scene) {
  accuracy_.forgetScene(model_);
  renderer_.waitIdle();
  nonFinite_ = nonFinite();
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
  model_.settings = loaded_->settings;
  model_.debugPass = -1;
  model_.passes.clear();
  camera_.reset(loaded_->scene.camera);
  time_ = 0.0;
  shownScene_ = static_cast<int>(noteSceneFile(loaded_->scene.file));
  model_.scene = shownScene_;
}

}  // namespace speculum
