#include "app/recorder.hpp"

#include <fmt/format.h>

#include "app/screenshot.hpp"
#include "image/image.hpp"
#include "image/picture_files.hpp"

namespace speculum {

void Recorder::start(const std::string& scene, bool bare) {
  folder_ = newRecordingFolder(scene);
  frames_ = 0;
  bare_ = bare;
}

void Recorder::add(const Image8& picture) {
  try {
    writePng(folder_ / fmt::format("{:05}.png", frames_), picture);
    ++frames_;
    message_ = fmt::format("recorded {} {} at {} a second in {}", frames_, frames_ == 1 ? "frame" : "frames",
                           framesPerSecond, folder_.string());
  } catch (const std::exception& error) {
    message_ = "recording ended after " + std::to_string(frames_) + " frames: " + error.what();
    stop();
  }
}

}  // namespace speculum
