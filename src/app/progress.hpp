#pragma once

#include <chrono>
#include <filesystem>
#include <string>

namespace speculum {

// Progress of long work on stderr: a bar that redraws itself on a terminal, a plain line every few seconds elsewhere.
// Prints nothing for work that is done within a second.
class Progress {
 public:
  Progress(std::string what, double total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void advance() { set(done_ + 1.0); }
  void set(double done);

 private:
  using Clock = std::chrono::steady_clock;
  void print(double secondsLeft);

  std::string what_;
  double total_;
  double done_ = 0.0;
  double before_ = 0.0;  // `done_` when measuring the pace began
  bool terminal_;
  bool shown_ = false;
  Clock::time_point created_;
  Clock::time_point start_;  // of the pace
  Clock::time_point last_;
};

// Names the file of each picture of a sequence. The pattern has one %d or %0Nd, or none for a single picture. Throws
// UsageError for endings other than .png and .exr, and for a sequence without a number.
class PictureFiles {
 public:
  PictureFiles(const std::filesystem::path& pattern, int count);
  std::filesystem::path at(int index) const;

 private:
  std::string before_;
  std::string after_;
  int digits_ = 0;
  bool numbered_ = false;
};

}  // namespace speculum
