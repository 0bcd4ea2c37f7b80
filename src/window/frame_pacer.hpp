#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <string>

#include "settings/settings.hpp"

namespace speculum {

// Says when a frame has to be drawn: after each change until everything shown is up to date, and never while the window
// is idle.
class FramePacer {
 public:
  // Call when something changed or is changing. `halves`: settings of the pictures that are drawn in turn.
  void change(std::span<const Settings> halves);
  void requestFrames(int frames) { due_ = std::max(due_, frames); }
  bool due() const { return due_ > 0; }
  void idle() { idled_ = true; }  // call when the window sleeps

  // Begins a frame, `seconds` after the last step. Returns the milliseconds since the last frame, NaN if the window was
  // idle.
  double beginFrame(double seconds);
  void frameDrawn() { due_ = std::max(0, due_ - 1); }

 private:
  int due_ = 0;        // frames to draw, although nothing changes any more
  bool idled_ = true;  // the window slept before the frame that is drawn next
};

// How a scene is shown at first. An animated scene moves at once, but if that proves too slow it is paused until the
// user plays it. On a CPU device the scene's thumbnail covers the first pictures.
class FirstPictures {
 public:
  // Call when another scene is shown. `moves`: the scene moves by itself, and its frames have a time budget. `covered`:
  // the thumbnail covers the picture until there is a good one, or for some seconds.
  void begin(bool moves, bool covered) {
    triesLeft_ = moves ? mostTries : 0;
    covered_ = covered;
    holds_ = false;
  }
  // Call after each frame: with Pace::playCost(), whether the scene moves by itself, whether the frame was a complete
  // picture in full quality, and the seconds since begin(). Returns true if the scene is to go back to its start
  // and to be paused.
  bool drawn(const std::optional<std::string>& playCost, bool moves, bool complete, double seconds) {
    const bool tried = triesLeft_ > 0;
    triesLeft_ = moves && !playCost ? triesLeft_ - tried : 0;
    const bool stands = tried && moves && !playCost.value_or("").empty();
    holds_ = stands || (holds_ && !moves);
    covered_ = covered_ && seconds < longestCover && (tried ? triesLeft_ > 0 || stands || !moves : !complete);
    return stands;
  }
  void uncover() { covered_ = false; }  // the user acts

  bool covered() const { return covered_; }  // the thumbnail covers the picture
  bool holds() const { return holds_; }      // the scene was paused for being slow, and nobody has played it yet

 private:
  static constexpr int mostTries = 60;
  static constexpr double longestCover = 30.0;  // seconds, after which a draft is shown

  int triesLeft_ = 0;  // frames in which the cost of playing may become known
  bool covered_ = false;
  bool holds_ = false;
};

}  // namespace speculum
