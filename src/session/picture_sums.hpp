#pragma once

#include <span>
#include <vector>

#include "core/gpu_timer.hpp"
#include "systems/pass_log.hpp"

namespace speculum {

// A pass with its figures of the GPU.
struct TimedPass : RecordedPass {
  PassTiming timing;
};

// Passes with the sums of their draws and figures over frames, which draw parts of a picture or pictures of a mean.
class PictureSums {
 public:
  // Call before the first frame of a picture. Pictures may differ in passes at the edge of the view.
  void beginPicture() { place_ = 0; }
  // Adds the passes of a frame by their ids. A pass that is new stands behind the one before it.
  void add(std::span<const RecordedPass> passes, const FrameTimings& timings);

  const std::vector<TimedPass>& passes() const { return passes_; }

 private:
  std::vector<TimedPass> passes_;
  size_t place_ = 0;  // behind the last pass that was added
};

}  // namespace speculum
