#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

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

// Measures a view on a thread of its own, with a scene and a device of its own, while the window goes on. The times are
// those of a device that two users share.
class BackgroundSweep {
 public:
  ~BackgroundSweep();  // cancels and waits

  // Cancels one that runs.
  void start(SweepRequest request);
  // Without waiting: the thread ends by itself, and what it measured is dropped.
  void cancel();

  // Of the sweep that runs; nothing if none does.
  std::optional<SweepStatus> status();
  // The results, once, when a sweep has finished.
  std::optional<SweepResults> take();
  // Why a sweep has failed, once.
  std::optional<std::string> takeError();

 private:
  struct Job {
    ~Job();
    void run();

    SweepRequest request;
    std::atomic<bool> cancelled = false;
    std::atomic<bool> ended = false;
    std::mutex mutex;  // guards the next three
    SweepStatus status{"starting", 0.0};
    std::optional<SweepResults> results;
    std::optional<std::string> error;
    std::thread thread;
  };

  std::unique_ptr<Job> job_;
  std::vector<std::unique_ptr<Job>> cancelled_;  // whose threads may not have ended yet
};

}  // namespace speculum
