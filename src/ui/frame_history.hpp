#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace speculum {

// Milliseconds of the last frames, by frame number. The figures of the CPU and the window are there at once; those of
// the GPU arrive some frames later. Missing figures are NaN. Frames whose quality was lowered for the pace are kept
// apart from the others: the functions return figures of frames with the quality of the last frame.
class FrameHistory {
 public:
  static constexpr size_t longest = 300;  // frames of each quality

  enum class Figure { frame, cpu, gpu };

  // Adds a frame; numbers must ascend. `frameMs` is the time since the frame before, NaN if nothing was drawn for a
  // while.
  void add(uint64_t number, double frameMs, double cpuMs, bool lowered = false);
  // Adds the GPU's figures to a frame from add(). Ignores frames that were dropped or have such figures already. Times
  // of passes with the same name add up.
  void addGpu(uint64_t number, double gpuMs, std::span<const std::pair<std::string, double>> passes);
  void clear();
  // Clears the history, at once or when it is no longer paused. Call when later frames must not be compared with
  // earlier ones.
  void restart();

  // Nothing is added while the history is paused.
  void setPaused(bool paused);
  bool paused() const { return paused_; }

  bool lowered() const { return lowered_; }  // the last frame had lowered quality
  size_t frames() const { return rows().size(); }
  std::vector<float> series(Figure figure) const;  // oldest first
  static constexpr size_t recent = 16;  // number of frames in which a pass that runs by turns runs at least once
  // Names of passes in the order of their first recording. Leaves out a pass that ran in none of the last `recent`
  // frames with times of passes.
  std::vector<std::string> passNames() const;
  // Milliseconds of a pass by frame, oldest first.
  std::vector<float> passSeries(const std::string& pass) const;
  // As passSeries(), but repeats each value until the next one, because few frames have their passes timed.
  std::vector<float> filledSeries(const std::string& pass) const;

  // Returns CSV by RFC 4180: a line of names with units, then one for each frame, oldest first. Missing figures are
  // empty.
  std::string csv() const;

 private:
  struct Row {
    uint64_t number = 0;
    std::array<double, 3> ms{};  // by Figure
    std::vector<double> passes;  // by index in names_; those at the end may be missing
  };
  const std::deque<Row>& rows() const { return rows_[static_cast<size_t>(lowered_)]; }

  std::array<std::deque<Row>, 2> rows_;  // of full and of lowered quality
  bool lowered_ = false;                 // quality of the last frame
  std::vector<std::string> names_;
  bool paused_ = false;
  bool restarts_ = false;  // clears the history when it is no longer paused
};

// Returns the smallest value that at least `share` of the values do not exceed (nearest rank): 0.5 gives the median.
// Ignores NaN; returns NaN if there is no other value.
double percentile(std::span<const float> values, double share);

}  // namespace speculum
