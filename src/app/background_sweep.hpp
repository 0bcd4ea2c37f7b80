#pragma once

#include <atomic>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "accuracy/sweep.hpp"
#include "app/options.hpp"

namespace speculum {

// A view of the window to be measured.
struct SweepRequest {
  Options options;  // scene, size, device
  Settings base;
  CameraPose camera;
  double time = 0.0;  // seconds of animation
};

// Measures a view on a thread of its own, with a device of its own, while the window goes on. The times are those of a
// device that two programs share.
class BackgroundSweep {
 public:
  ~BackgroundSweep() { cancel(); }

  // Cancels one that runs.
  void start(SweepRequest request);
  // Returns when the thread has ended.
  void cancel();

  // Of the sweep that runs; nothing if none does.
  std::optional<SweepStatus> status();
  // The results, once, when a sweep has finished.
  std::optional<SweepResults> take();
  // Why the last sweep failed, empty if it did not.
  std::string error();

 private:
  void run(const SweepRequest& request);

  std::mutex mutex_;  // guards the next three
  std::optional<SweepStatus> status_;
  std::optional<SweepResults> results_;
  std::string error_;
  std::atomic<bool> cancelled_ = false;
  std::thread thread_;
};

}  // namespace speculum
