#pragma once

#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace speculum {

// Runs work on a thread of its own while the window continues. Call everything from one thread; only the work itself
// runs on the other.
template <typename Result, typename Progress = double>
class BackgroundJob {
 public:
  // Reports progress. Returns false once the job is cancelled: the work then ends early, by an exception or with any
  // result, and either is dropped.
  using Report = std::function<bool(const Progress&)>;
  using Work = std::function<Result(const Report&)>;

  // Cancels a job that runs. `first` is the progress until the work reports any.
  void start(Progress first, Work work) {
    cancel();
    task_ = std::make_unique<Task>();
    task_->progress = std::move(first);
    task_->thread = std::jthread(
        [task = task_.get(), work = std::move(work)](const std::stop_token& stop) { task->run(stop, work); });
  }
  // Cancels without waiting; the thread ends by itself.
  void cancel() {
    if (task_) {
      task_->thread.request_stop();
      cancelled_.push_back(std::move(task_));
    }
    std::erase_if(cancelled_, [](const std::unique_ptr<Task>& task) { return task->ended.load(); });
  }
  // Cancels and waits for every thread, as destruction does.
  void stop() {
    cancel();
    cancelled_.clear();
  }

  bool running() const { return task_ && !task_->ended; }
  bool finished() const { return task_ && task_->ended; }  // with a result or an error that nobody has taken
  bool busy() const { return task_ != nullptr; }           // running or finished
  std::optional<Progress> progress() const {
    if (!running()) {
      return std::nullopt;
    }
    const std::lock_guard lock(task_->mutex);
    return task_->progress;
  }
  bool hasResult() const { return finished() && task_->result; }
  std::optional<Result> takeResult() {
    return hasResult() ? std::move(std::exchange(task_, nullptr)->result) : std::nullopt;
  }
  // Returns why the work failed.
  std::optional<std::string> takeError() {
    return finished() && !task_->result ? std::optional(std::exchange(task_, nullptr)->error) : std::nullopt;
  }

 private:
  struct Task {
    void run(const std::stop_token& stop, const Work& work) {
      try {
        result = work([&](const Progress& now) {
          const std::lock_guard lock(mutex);
          progress = now;
          return !stop.stop_requested();
        });
      } catch (const std::exception& failure) {
        error = failure.what();
      }
      if (stop.stop_requested()) {
        result.reset();
      }
      ended = true;
    }

    std::mutex mutex;  // guards `progress`
    Progress progress;
    std::optional<Result> result;  // only the thread uses it until `ended`
    std::string error;
    std::atomic<bool> ended = false;
    std::jthread thread;  // the last member, so that it ends before the others are destroyed
  };

  std::unique_ptr<Task> task_;
  std::vector<std::unique_ptr<Task>> cancelled_;  // their threads may not have ended yet
};

// Runs `work` with half of the processor's threads; the others remain for the window.
inline void inBackground(const std::function<void()>& work) {
  tbb::task_arena(std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / 2)).execute(work);
}

}  // namespace speculum
