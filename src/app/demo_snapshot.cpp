// What leaves the window as the picture shows it: the command line of the view, and what is measured of it.
#include <algorithm>
#include <functional>
#include <stdexcept>

#include "accuracy/fingerprint.hpp"
#include "app/demo.hpp"
#include "app/view_command.hpp"
#include "platform/files.hpp"
#include "platform/folders.hpp"

namespace speculum {

namespace fs = std::filesystem;

namespace {

// Other content gets another name, so that commands that were copied before stay right.
std::string contentName(std::string_view text) {
  Fingerprint fingerprint;
  fingerprint.add(text);
  return fingerprint.hex();
}

// All that is older than the copies that somebody may still want goes.
void keepNewest(const fs::path& folder) {
  constexpr size_t kept = 100;
  std::error_code none;
  std::vector<std::pair<fs::file_time_type, fs::path>> files;
  for (const auto& entry : fs::directory_iterator(folder, none)) {
    if (entry.path().extension() == ".toml") {
      files.emplace_back(entry.last_write_time(none), entry.path());
    }
  }
  std::sort(files.begin(), files.end(), std::greater<>());
  for (size_t i = kept; i < files.size(); ++i) {
    fs::remove(files[i].second, none);
  }
}

}  // namespace

// A file with the scene as it is edited: its own, or with unsaved changes a copy among the user's cached files. Empty,
// with a line in `problem`, if that cannot be written.
fs::path Demo::fileOfView(std::string& problem) {
  const SceneDocument& document = editor_->document();
  const fs::path own = loaded_->scene.file;
  if (!document.modified()) {
    return own;
  }
  const fs::path folder = userCacheDir() / "views";
  std::error_code none;
  fs::create_directories(folder, none);
  try {
    const std::string text = document.text(folder / "view.toml", settingChanges(settingsAtLoad_, loaded_->settings));
    fs::path file = folder / (own.stem().string() + "-" + contentName(text) + ".toml");
    keepNewest(folder);
    replaceFile(file, text);
    return file;
  } catch (const std::runtime_error& error) {
    problem = error.what();
    return {};
  }
}

// Of the frame that was drawn last.
void Demo::copyCommand() {
  std::string problem;
  const fs::path file = fileOfView(problem);
  if (file.empty()) {
    return tell("not copied: " + problem);
  }
  Options options = options_;
  const VkExtent2D extent = renderer_.displayExtent();
  options.size = {static_cast<int>(extent.width), static_cast<int>(extent.height)};
  options.time = time_;
  if (const auto place = camera_.place()) {
    options.camera = CameraPlace{place->eye, place->target, std::nullopt};
  }
  const std::string command = viewCommand(options, file, loaded_->scene, model_.settings);
  window_.setClipboard(command);
  const bool copy = file != loaded_->scene.file;
  tell("copied: " + command + (copy ? "   (of a copy of the scene: it has unsaved changes)" : ""));
}

SweepRequest Demo::sweepRequest(const fs::path& file) {
  SweepRequest request{.options = options_, .base = model_.settings, .camera = camera(), .time = time_};
  request.options.scene = file.string();
  request.options.gpu = std::to_string(device_.info().index);
  const VkExtent2D extent = renderer_.displayExtent();
  request.options.size = {static_cast<int>(extent.width), static_cast<int>(extent.height)};
  return request;
}

}  // namespace speculum
