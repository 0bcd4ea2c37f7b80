#pragma once

#include <filesystem>
#include <string>

#include "image/image.hpp"

namespace speculum {

// Saves the frames of the window as numbered pictures. While it runs, the animation goes on by the same step from frame
// to frame, however long drawing and saving take, so that the sequence plays evenly.
class Recorder {
 public:
  static constexpr double framesPerSecond = 30.0;

  // Into a new folder beside the screenshots, named after the scene and the local time. With `bare` the pictures are
  // without the panel. Throws std::filesystem::filesystem_error.
  void start(const std::string& scene, bool bare);
  void stop() { folder_.clear(); }
  bool running() const { return !folder_.empty(); }
  bool bare() const { return running() && bare_; }
  // The next picture. One that cannot be written ends the recording.
  void add(const Image8& picture);
  // What is recorded, or was last and where, or why it ended.
  const std::string& message() const { return message_; }

 private:
  std::filesystem::path folder_;  // empty: not running
  std::string message_;
  int frames_ = 0;
  bool bare_ = false;
};

}  // namespace speculum
