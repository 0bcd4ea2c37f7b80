#include "app/capture.hpp"

#include <fmt/format.h>

#include <utility>

#include "app/screenshot.hpp"
#include "image/picture_files.hpp"

namespace speculum {

std::optional<std::string> Capture::toggleRecording(const std::string& scene, bool withPanel) {
  if (recording()) {
    folder_.reset();
    return recorded_;
  }
  try {
    folder_ = newRecordingFolder(scene);
    frames_ = 0;
    bare_ = !withPanel;
    return std::nullopt;
  } catch (const std::filesystem::filesystem_error& error) {
    return "not recorded: " + std::string(error.what());
  }
}

std::string Capture::record(const Image8& picture) {
  try {
    writePng(*folder_ / fmt::format("{:05}.png", frames_), picture);
    ++frames_;
    recorded_ = fmt::format("recorded {} {} at {} a second in {}", frames_, frames_ == 1 ? "frame" : "frames",
                            framesPerSecond, folder_->string());
  } catch (const std::exception& error) {
    recorded_ = "recording ended after " + std::to_string(frames_) + " frames: " + error.what();
    folder_.reset();
  }
  return recorded_;
}

Capture::Saved Capture::save(const std::string& scene, const Image8& picture) {
  Saved saved;
  if (recording()) {
    saved.message = record(picture);
  }
  if (std::exchange(screenshot_, Screenshot::none) == Screenshot::none) {
    return saved;
  }
  try {
    const std::filesystem::path file = newPictureFile(scene);
    writePng(file, picture);
    return {"saved " + file.string(), true};
  } catch (const std::exception& error) {
    return {"not saved: " + std::string(error.what()), true};
  }
}

}  // namespace speculum
