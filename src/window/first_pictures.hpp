#pragma once

#include <optional>
#include <string>

namespace speculum {

// How a scene is shown at first: it moves at once, but where that proves too slow it stands until the user plays it. A
// CPU device draws its first pictures below the scene's thumbnail.
class FirstPictures {
 public:
  // Begins with another scene. `moves`: by itself, at a pace. `covered`: until there is a good picture, or for some
  // seconds.
  void begin(bool moves, bool covered) {
    coveredSeconds_ = 0.0;
    triesLeft_ = moves ? mostTries : 0;
    covered_ = covered;
    holds_ = false;
  }
  // Call after each frame: with Pace::playCost(), whether the scene moves by itself, whether the frame was a complete
  // picture in full quality, and the seconds since the last frame. Returns true if the scene is to go back and stand.
  bool drawn(const std::optional<std::string>& playCost, bool moves, bool complete, double seconds) {
    coveredSeconds_ += seconds;
    const bool tried = triesLeft_ > 0;
    triesLeft_ = moves && !playCost ? triesLeft_ - tried : 0;
    const bool stands = tried && moves && !playCost.value_or("").empty();
    holds_ = stands || (holds_ && !moves);
    covered_ = covered_ && coveredSeconds_ < longestCover && (tried ? triesLeft_ > 0 || stands || !moves : !complete);
    return stands;
  }
  void uncover() { covered_ = false; }  // the user acts

  bool covered() const { return covered_; }
  bool holds() const { return holds_; }  // the scene stands, and nobody has played it yet

 private:
  static constexpr int mostTries = 60;
  static constexpr double longestCover = 5.0;  // seconds, after which a draft is shown

  int triesLeft_ = 0;  // frames in which the cost of playing may become known
  bool covered_ = false;
  double coveredSeconds_ = 0.0;
  bool holds_ = false;
};

}  // namespace speculum
