#pragma once

#include <vector>

#include "frame/frame_plan.hpp"

namespace speculum {

// A still picture that takes longer than a window may wait: several frames draw it, a few tiles each. Learns the time
// of each tile, for the next pictures of the same view. Tiles that are faces of maps come first, in frames of their
// own: they take another time, and most pictures have none.
class SlowPicture {
 public:
  // Begins a picture of `faces` and `count` other tiles. These are expected to take `ms` if it is the first picture;
  // others are expected to take as long as the last.
  void begin(size_t faces, size_t count, double ms);
  // Returns the next tiles, at least one, that are expected to take `ms` together.
  TileRange next(double ms);
  // Call with the time that they took.
  void took(double ms);

  bool begun() const { return !tileMs_.empty(); }                          // at least one picture was
  bool finished() const { return tiles_.end == faces_ + tileMs_.size(); }  // all tiles are planned
  double share() const { return static_cast<double>(tiles_.end) / static_cast<double>(faces_ + tileMs_.size()); }
  double totalMs() const { return totalMs_; }

 private:
  size_t faces_ = 0;
  double faceMs_ = 0.0;         // of each of the last faces
  std::vector<double> tileMs_;  // of each other tile, expected or measured
  TileRange tiles_;             // of the last next()
  size_t measured_ = 0;         // the first tiles of tileMs_ whose times were measured
  double dearestMs_ = 0.0;      // longest measured time of a tile
  double totalMs_ = 0.0;        // of the picture's tiles so far
};

}  // namespace speculum
