#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "app/session.hpp"

namespace speculum {

// How far a scene is loaded.
struct LoadStatus {
  std::filesystem::path file;  // that is read
  double done = 0.0;           // share, 0 .. 1
};

// Loads a scene or a model on a thread of its own while the window goes on.
class BackgroundLoad {
 public:
  ~BackgroundLoad();  // cancels and waits

  // Cancels one that runs.
  void start(const std::filesystem::path& file, const Options& options);
  // Without waiting: the thread ends by itself, and what it read is dropped.
  void cancel();
  bool running() const { return job_ && !job_->ended; }

  // Of what is loaded now; nothing if nothing is.
  std::optional<LoadStatus> status();
  bool arrived();  // take() has it
  // The scene, once, when it is there.
  std::unique_ptr<LoadedScene> take();
  // Why it could not be loaded, once: one line.
  std::optional<std::string> takeError();

 private:
  struct Job {
    ~Job();
    void run();

    std::filesystem::path file;
    Options options;
    std::atomic<bool> cancelled = false;
    std::atomic<bool> ended = false;
    std::mutex mutex;  // guards the next three
    LoadStatus status;
    std::unique_ptr<LoadedScene> scene;
    std::optional<std::string> error;
    std::thread thread;
  };

  std::unique_ptr<Job> job_;
  std::vector<std::unique_ptr<Job>> cancelled_;  // whose threads may not have ended yet
};

}  // namespace speculum
