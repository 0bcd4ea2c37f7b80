#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "image/image.hpp"

namespace speculum {

// Screenshots and recordings of the window, in Speculum's folder of the user's pictures. While frames are recorded the
// animation advances by the same step for each frame, however long drawing and saving take, so that the sequence plays
// evenly.
class Capture {
 public:
  static constexpr double framesPerSecond = 30.0;

  void takeScreenshot(bool withPanel) { screenshot_ = withPanel ? Screenshot::window : Screenshot::bare; }
  // Starts recording numbered pictures into a new folder named after the scene and the local time, or stops. Returns a
  // line for the user, if there is anything to say.
  std::optional<std::string> toggleRecording(const std::string& scene, bool withPanel);

  bool recording() const { return folder_.has_value(); }
  bool wanted() const { return recording() || screenshot_ != Screenshot::none; }  // the present frame is to be saved
  bool hidesPanels() const { return recording() && bare_; }
  bool bare() const { return screenshot_ == Screenshot::bare || hidesPanels(); }  // the present frame is without panels

  struct Saved {
    std::string message;
    bool logged = false;  // the message goes to the log too
  };
  // Saves the frame; call it if wanted(). A recorded picture that cannot be written ends the recording. `progress`:
  // whether the picture is finished; may be empty. `waits`: the scene moves, but is paused.
  Saved save(const std::string& scene, const Image8& picture, const std::string& progress, bool waits);

 private:
  enum class Screenshot { none, window, bare };

  std::string record(const Image8& picture);

  Screenshot screenshot_ = Screenshot::none;     // of the next frame
  std::optional<std::filesystem::path> folder_;  // of the recording; none: nothing is recorded
  bool bare_ = false;                            // the recording is without panels
  int frames_ = 0;                               // recorded so far
  std::string recorded_;                         // says what was recorded, for the end of the recording
};

}  // namespace speculum
