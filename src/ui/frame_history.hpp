#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace speculum {

// Milliseconds of the last frames, by frame number: what the CPU and the window know at once, and what the GPU tells
// some frames later. What is not known is NaN.
class FrameHistory {
 public:
  static constexpr size_t longest = 300;  // frames

  enum class Figure { frame, cpu, gpu };

  // Numbers ascend. `frameMs` is the time since the frame before, NaN if nothing was drawn for a while.
  void add(uint64_t number, double frameMs, double cpuMs);
  // The frame must have been added; one that has been dropped, or has its figures, is ignored. Times of
  // passes of one name add up.
  void addGpu(uint64_t number, double gpuMs, std::span<const std::pair<std::string, double>> passes);
  void clear();

  // Nothing is added while it is paused.
  void setPaused(bool paused) { paused_ = paused; }
  bool paused() const { return paused_; }

  size_t frames() const { return rows_.size(); }
  std::vector<float> series(Figure figure) const;  // oldest first
  // In the order of their first recording; those that no frame here has are left out.
  std::vector<std::string> passNames() const;
  std::vector<float> passSeries(const std::string& pass) const;

  // A line of names with units, then one for each frame, oldest first; unknown figures are empty. A pass's name is
  // quoted as RFC 4180 has it.
  std::string csv() const;

 private:
  struct Row {
    uint64_t number = 0;
    double frameMs = 0.0;
    double cpuMs = 0.0;
    double gpuMs = 0.0;
    std::vector<double> passes;  // by index in names_; those at the end may be missing
  };
  std::deque<Row> rows_;
  std::vector<std::string> names_;
  bool paused_ = false;
};

// The share of the known values that are not above it, nearest rank: 0.5 is the median. NaN if none is known.
double percentile(std::span<const float> values, double share);

}  // namespace speculum
