#pragma once

#include <string>
#include <vector>

#include "core/device.hpp"

namespace speculum {

struct PassTiming {
  std::string name;
  double gpuMs = 0.0;  // 0 where the queue has no timestamps, and of passes that are not measured
  bool hasStatistics = false;
  uint64_t triangles = 0;  // triangles after clipping
  uint64_t fragments = 0;  // fragment shader invocations
  bool hasSamples = false;
  uint64_t samples = 0;  // samples that passed the depth test since beginSamples()

  // Adds the figures and takes over the name.
  PassTiming& operator+=(const PassTiming& other);
};

struct FrameTimings {
  uint64_t frame = 0;              // number of the frame; 0: none has finished yet
  double gpuMs = 0.0;              // from the first measured pass's start to the last one's end, without pauses
  std::vector<PassTiming> passes;  // in the order of recording; none if only the frame was measured
};

// What is measured. frame: the frame's time; passes: also time and statistics of each pass; samples: also the samples
// that pass the depth test. To count samples, lavapipe compiles each shader once more.
enum class TimerDetail { frame, passes, samples };

// Timestamps and pipeline statistics of one frame in flight. Both stamps of a pass are taken at the bottom of the pipe,
// so that passes do not overlap in the figures and their times add up to the frame's. On lavapipe, which ends all its
// work before it takes a stamp, passes then do not overlap at all. TimerDetail::frame takes two stamps, or two for each
// of the frame's parts (see Renderer::submitPart). The first 512 passes of each part are measured.
class GpuTimer {
 public:
  explicit GpuTimer(Device& device, const std::string& name);

  void reset(uint64_t frame, TimerDetail detail);  // at the start of the frame
  // Begins the next part of the frame, between two passes. The GPU has finished the part before.
  void resume();
  void finish(VkCommandBuffer commands);  // after the last pass of the frame or of its part
  // Begins a pass. Returns its slot for the functions below, negative if the pass is not measured.
  int begin(VkCommandBuffer commands, const std::string& pass, bool statistics);
  // Ends the pass's statistics, if they have not ended yet. Call it outside rendering.
  void endStatistics(VkCommandBuffer commands, int slot);
  void end(VkCommandBuffer commands, int slot);
  // Count the samples that pass the depth test, with TimerDetail::samples only. Both are called within one render pass;
  // a second endSamples() does nothing.
  void beginSamples(VkCommandBuffer commands, int slot);
  void endSamples(VkCommandBuffer commands, int slot);
  FrameTimings read() const;  // call it after the frame's fence

 private:
  static constexpr uint32_t maxPasses = 512;

  void forgetPasses();
  void resetQueries(VkCommandBuffer commands, uint32_t slot);
  void stamp(VkCommandBuffer commands, uint32_t query);

  Device& device_;
  QueryPoolHandle stamps_;      // null where the queue has none
  QueryPoolHandle statistics_;  // null where the device has none
  QueryPoolHandle samples_;     // null where the device cannot count them
  uint64_t frame_ = 0;
  TimerDetail detail_ = TimerDetail::samples;
  uint32_t stamped_ = 0;  // stamps written in this part of the frame
  FrameTimings earlier_;  // of the frame's parts before this one
  std::vector<PassTiming> passes_;
  bool countsStatistics_ = false;  // the last pass's statistics have begun and not ended
  bool countsSamples_ = false;     // the last pass's count of samples has begun and not ended
};

}  // namespace speculum
