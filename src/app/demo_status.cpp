// What the window tells a person: what was done last, and the scenes there are.
#include <spdlog/spdlog.h>

#include <algorithm>

#include "app/demo.hpp"
#include "platform/folders.hpp"

namespace speculum {

namespace fs = std::filesystem;

namespace {

constexpr size_t mostListed = 64;  // scenes of one folder

std::vector<fs::path> scenesIn(const fs::path& folder) {
  std::error_code none;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder.empty() ? fs::path(".") : folder, none)) {
    if (entry.path().extension() == ".toml") {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  files.resize(std::min(files.size(), mostListed));
  return files;
}

}  // namespace

void Demo::tell(const std::string& text) {
  spdlog::info("{}", text);
  show(text);
}

void Demo::show(const std::string& text) {
  model_.status = {.text = text};
  statusSince_ = Clock::now();
}

void Demo::followStatus() {
  model_.status.withPanelOnly = shot_ != Shot::none || recorder_.running();
  model_.status.age = std::chrono::duration<double>(Clock::now() - statusSince_).count();
  if (statusAlpha(model_.status.age) <= 0.0f) {
    model_.status.text.clear();
  }
}

bool Demo::statusFades() const {
  const double age = std::chrono::duration<double>(Clock::now() - statusSince_).count();
  return !model_.status.text.empty() && statusAlpha(age) < 1.0f;
}

// Of the folder of the scene that is shown first, then those that come with the program, then others that were opened.
void Demo::findScenes() {
  const std::vector<fs::path> before = std::exchange(sceneFiles_, {});
  model_.scenes.clear();
  model_.sceneTitles.clear();
  model_.scenePaths.clear();
  const fs::path folder = loaded_->scene.file.parent_path();
  for (const fs::path& file : scenesIn(folder)) {
    if (isSceneFile(file)) {
      noteSceneFile(file);
    }
  }
  noteSceneFile(loaded_->scene.file);
  for (const fs::path& file : scenesIn(dataDirectory("scenes"))) {
    noteSceneFile(file);
  }
  for (const fs::path& file : before) {
    noteSceneFile(file);
  }
  shownScene_ = static_cast<int>(noteSceneFile(loaded_->scene.file));
  model_.scene = shownScene_;
  showGallery();
}

}  // namespace speculum
