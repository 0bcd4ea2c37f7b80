#pragma once

#include <optional>

#include "scene/scene_state.hpp"

namespace speculum {

// Says whether the picture moves, by its camera or otherwise. A movement lasts until nothing has moved for a moment, so
// that the picture does not change its quality between two steps of the pointer.
class Movement {
 public:
  // Call once a frame, `seconds` after the last. `otherwise` says that something besides the camera moves.
  void update(const CameraPose& camera, bool otherwise, double seconds) {
    const bool moves = otherwise || (camera_ && *camera_ != camera);
    camera_ = camera;
    stillSeconds_ = moves ? 0.0 : stillSeconds_ + seconds;
    moving_ = moves || (moving_ && stillSeconds_ < longestRest);
  }
  bool moving() const { return moving_; }
  bool ending() const { return moving_ && stillSeconds_ > 0.0; }  // nothing moves in this frame

 private:
  static constexpr double longestRest = 0.15;  // seconds

  std::optional<CameraPose> camera_;  // of the last frame
  double stillSeconds_ = 0.0;
  bool moving_ = false;
};

}  // namespace speculum
