#include "window/capture.hpp"

#include <spdlog/fmt/chrono.h>

#include <ctime>
#include <utility>

#include "image/picture_files.hpp"
#include "platform/files.hpp"

namespace speculum {

namespace {

// Returns an unused path in Speculum's folder of the user's pictures, which it creates, named after the scene and the
// local time.
std::filesystem::path newPath(const std::string& scene, const std::string& ending) {
  const std::filesystem::path folder = picturesDir() / "Speculum";
  std::error_code error;  // ignored: writing into the folder will fail and say why
  std::filesystem::create_directories(folder, error);
  const std::string time = fmt::format("_{:%Y-%m-%d_%H-%M-%S}", fmt::localtime(std::time(nullptr)));
  std::filesystem::path path = folder / fileNameOf(scene, time + ending);
  for (int number = 2; std::filesystem::exists(path, error); ++number) {
    path = folder / fileNameOf(scene, time + "_" + std::to_string(number) + ending);
  }
  return path;
}

}  // namespace

std::optional<std::string> Capture::toggleRecording(const std::string& scene, bool withPanel) {
  if (recording()) {
    folder_.reset();
    return recorded_;
  }
  const std::filesystem::path folder = newPath(scene, "");
  std::error_code error;
  if (!std::filesystem::create_directory(folder, error)) {
    return "Not recorded: " + folder.string() + " cannot be made: " + error.message();
  }
  folder_ = folder;
  frames_ = 0;
  bare_ = !withPanel;
  return std::nullopt;
}

std::string Capture::record(const Image8& picture) {
  try {
    writePng(*folder_ / fmt::format("{:05}.png", frames_), picture);
    ++frames_;
    const std::string frames = fmt::format("{} {} at {} a second in {}", frames_, frames_ == 1 ? "frame" : "frames",
                                           framesPerSecond, folder_->string());
    recorded_ = "Recorded " + frames;
    return "Recording: " + frames + ". F10 stops.";
  } catch (const std::exception& error) {
    recorded_ = "Recording ended after " + std::to_string(frames_) + " frames: " + error.what();
    std::error_code none;
    std::filesystem::remove(*folder_, none);  // if it is empty
    folder_.reset();
  }
  return recorded_;
}

Capture::Saved Capture::save(const std::string& scene, const Image8& picture, const std::string& progress, bool waits) {
  Saved saved;
  if (recording()) {
    saved.message = record(picture);
    saved.message += recording() && waits ? " Space plays the animation." : "";
  }
  if (std::exchange(screenshot_, Screenshot::none) == Screenshot::none) {
    return saved;
  }
  try {
    const std::filesystem::path file = newPath(scene, ".png");
    writePng(file, picture);
    return {"Saved " + file.string() + (progress.empty() ? "" : ", " + progress), true};
  } catch (const std::exception& error) {
    return {"Not saved: " + std::string(error.what()), true};
  }
}

}  // namespace speculum
