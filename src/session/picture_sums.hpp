#pragma once

#include <span>
#include <vector>

#include "core/gpu_timer.hpp"
#include "systems/pass_log.hpp"

namespace speculum {

// A recorded pass with the GPU's figures.
struct TimedPass : RecordedPass {
  PassTiming timing;
};

// Sums the draws and the GPU's figures of each pass over frames that draw the parts of a picture or the pictures of a
// mean.
class PictureSums {
 public:
  // Call before the first frame of a picture. Pictures may differ in passes at the edge of the view.
  void beginPicture() { place_ = 0; }
  // Adds the figures of a frame's passes to those of the same id. A new pass is inserted behind the pass before it.
  void add(std::span<const RecordedPass> passes, const FrameTimings& timings);

  const std::vector<TimedPass>& passes() const { return passes_; }

 private:
  std::vector<TimedPass> passes_;
  size_t place_ = 0;  // index behind the pass that was added last
};

}  // namespace speculum
